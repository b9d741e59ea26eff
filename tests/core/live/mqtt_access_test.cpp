// Brokers that want a name and a password, or TLS: who is let in, and what is said to those who are not.
#include <cstdlib>

#include "core/address/password_source.h"
#include "tests/core/live/live_support.h"

namespace bl::live {
namespace {

using test::Broker;
using test::Folder;
using test::LiveWorld;
using test::Program;
using test::sensor;

std::string broker_node(const Broker& broker, const std::string& more) {
  return R"({"id": "hub", "types": {"mqtt_broker": {"host": "127.0.0.1", "port": )" + std::to_string(broker.port()) + ", " +
         more + "}}}";
}

LiveOptions options_in(const Folder& folder) { return {folder.path(), true, {0.02, 0.1}}; }

// A broker that knows `ada` with the password `swordfish`.
void start_guarded(Broker& broker, const Folder& folder) {
  ASSERT_EQ(Program({"mosquitto_passwd", "-b", "-c", folder.path("users"), "ada", "swordfish"}).wait(), 0);
  broker.start("allow_anonymous false\npassword_file " + folder.path("users"), {"-u", "ada", "-P", "swordfish"});
}

TEST(MqttAccess, APasswordFromAVariableOrAFileLetsIn) {
  const Folder folder;
  Broker broker;
  start_guarded(broker, folder);
  folder.write("hub.password", "swordfish\n");
  setenv("BL_TEST_HUB", "swordfish", 1);
  for (const char* from : {"env:BL_TEST_HUB", "file:hub.password"}) {
    LiveWorld live(sensor("s", broker.address("t")) + "," +
                       broker_node(broker, R"("user": "ada", "password_from": ")" + std::string(from) + R"(")"),
                   "", options_in(folder));
    ASSERT_TRUE(live.hears(broker, "t", "7", [&] { return live.quality("s") == "good"; })) << from << ": " << live.message("s");
    EXPECT_EQ(live.number("s"), 7);
    EXPECT_EQ(live.text("hub", "mqtt_broker.message"), "");
    EXPECT_EQ(live.replayed(2), live.hash());
  }
}

TEST(MqttAccess, WhoIsRefusedIsToldWhereToLook) {
  const Folder folder;
  Broker broker;
  start_guarded(broker, folder);
  LiveWorld unnamed(sensor("s", broker.address("t")));
  EXPECT_TRUE(unnamed.steps_until([&] { return unnamed.says("s", "It wants a user and a password: a node typified as"); }))
      << unnamed.message("s");
  folder.write("hub.password", "sailfish");
  const std::string settings = R"("user": "ada", "password_from": "file:hub.password")";
  LiveWorld live(sensor("s", broker.address("t")) + "," + broker_node(broker, settings), "", options_in(folder));
  ASSERT_TRUE(live.steps_until([&] {
    return live.says("s", "The user `ada` or the password of node `hub` is not the right one.");
  })) << live.message("s");
  EXPECT_FALSE(live.says("s", "sailfish")) << "the password is told to nobody";
  folder.write("hub.password", "swordfish");
  EXPECT_TRUE(live.hears(broker, "t", "8", [&] { return live.number("s") == 8; })) << "the file is read at each attempt";
  ASSERT_EQ(live.world().submit(command<SetPort>({"hub", {"mqtt_broker.password_from"}, {R"("env:BL_NOBODY_SET_THIS")"}})), "");
  EXPECT_TRUE(live.steps_until([&] {
    return live.says("s", "the variable `BL_NOBODY_SET_THIS` is not set in the environment of this program (node `hub`");
  })) << live.message("s");
  ASSERT_EQ(live.world().submit(command<SetPort>({"hub", {"mqtt_broker.password_from"}, {R"("file:gone.password")"}})), "");
  EXPECT_TRUE(live.steps_until([&] { return live.says("s", "the file `gone.password` cannot be read (node `hub`"); }));
  ASSERT_EQ(live.world().submit(command<SetPort>({"hub", {"mqtt_broker.password_from"}, {R"("swordfish")"}})), "");
  EXPECT_TRUE(live.steps_until([&] { return live.says("s", "the password itself does not belong into a scene"); }));
  EXPECT_EQ(live.replayed(1), live.hash());
}

void openssl(const std::vector<std::string>& arguments) {
  std::vector<std::string> all{"openssl"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  ASSERT_EQ(Program(all).wait(), 0) << "is the package openssl installed?";
}

// A certificate for 127.0.0.1 that vouches for itself.
void make_certificate(const Folder& folder, const std::string& name) {
  openssl({"req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "2", "-subj", "/CN=127.0.0.1", "-addext",
           "subjectAltName=IP:127.0.0.1", "-keyout", folder.path(name + ".key"), "-out", folder.path(name + ".crt")});
}

TEST(MqttAccess, EncryptedConnectionsCheckTheCertificate) {
  const Folder folder;
  make_certificate(folder, "hub");
  make_certificate(folder, "other");
  Broker broker;
  broker.start("allow_anonymous true\ncertfile " + folder.path("hub.crt") + "\nkeyfile " + folder.path("hub.key"),
               {"--cafile", folder.path("hub.crt"), "-h", "127.0.0.1"});
  const auto world = [&](const std::string& settings) {
    return LiveWorld(sensor("s", broker.address("t")) + "," + broker_node(broker, settings), "", options_in(folder));
  };
  LiveWorld trusted = world(R"("is_encrypted": true, "ca_file": "hub.crt")");
  ASSERT_TRUE(trusted.hears(broker, "t", "3", [&] { return trusted.number("s") == 3; })) << trusted.message("s");
  LiveWorld wrong = world(R"("is_encrypted": true, "ca_file": "other.crt")");
  EXPECT_TRUE(wrong.steps_until([&] { return wrong.says("s", "vouched for by nobody whom node `hub` trusts"); }))
      << wrong.message("s");
  LiveWorld systems = world(R"("is_encrypted": true)");
  EXPECT_TRUE(systems.steps_until([&] { return systems.says("s", "vouched for by nobody whom node `hub` trusts"); }))
      << systems.message("s");
  LiveWorld plain = world(R"("user": "")");
  EXPECT_TRUE(plain.steps_until([&] { return plain.says("s", "it may want an encrypted one: see node `hub`"); }))
      << plain.message("s");
  folder.write("noise.crt", "no certificate");
  LiveWorld noise = world(R"("is_encrypted": true, "ca_file": "noise.crt")");
  EXPECT_TRUE(noise.steps_until([&] { return noise.says("s", "`noise.crt` holds no certificate in PEM form (node `hub`"); }));
}

TEST(MqttAccess, ABrokerWithoutTlsIsNotEnteredByIt) {
  const Folder folder;
  make_certificate(folder, "hub");
  Broker broker;
  broker.start();
  LiveWorld live(sensor("s", broker.address("t")) + "," + broker_node(broker, R"("is_encrypted": true, "ca_file": "hub.crt")"),
                 "", options_in(folder));
  EXPECT_TRUE(live.steps_until([&] { return live.says("s", "cannot be connected to by TLS: it speaks without"); }))
      << live.message("s");
}

TEST(PasswordSource, OnlyNamesThatMeanAPasswordForThisProgram) {
  EXPECT_EQ(address::parse_password_source("env:BL_BROKER")->name, "BL_BROKER");
  EXPECT_TRUE(address::parse_password_source("file:keys/hub.password")->is_file);
  for (const char* text : {"swordfish", "", "env:", "env:BL_", "env:HOME", "env:BL_a", "env:BL_X Y", "file:/etc/passwd",
                           "file:", "file:.password", "file:a.password\n"})
    EXPECT_FALSE(address::parse_password_source(text).ok()) << text;
}

}  // namespace
}  // namespace bl::live
