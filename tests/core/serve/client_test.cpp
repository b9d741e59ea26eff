// The client against the server, over the loopback, plain and encrypted.
#include "core/serve/client.h"

#include <fstream>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/x509v3.h>
#include <sys/socket.h>

#include "tests/core/serve/talk.h"
#include "tests/support/deadline.h"

namespace bl::serve {
namespace {

TEST(Client, TalksWithARoomAndLeaves) {
  const Deadline deadline(200, "a client that talks and leaves");
  RunningServer server;
  {
    Talk talk(address_of(server));
    talk.client.send(hello(server.invite("designer")));  // before the connection is open
    ASSERT_TRUE(talk.wait_for("welcome")) << (talk.closed ? talk.closed->why : "");
    EXPECT_TRUE(talk.is_open);
    EXPECT_EQ((*talk.last("welcome"))["you"]["role"], "designer");
    ASSERT_TRUE(talk.wait_for("scene")) << "windows are sent the scene";
    talk.client.send(
        R"({"t": "op", "id": 1, "c": {"command": "set_setting", "arguments": {"setting": "title", "value": "Ours"}}})");
    ASSERT_TRUE(talk.wait([&] { return talk.last("ack") != nullptr || talk.last("nack") != nullptr; }));
    talk.client.send(R"({"t": "ping", "n": 7})");
    ASSERT_TRUE(talk.wait_for("pong"));
    EXPECT_EQ((*talk.last("pong"))["n"], 7);
  }
  Talk again(address_of(server));
  ASSERT_TRUE(again.wait([&] { return again.is_open; }));
}

TEST(Client, ComesAsAPageByTheCodeAlone) {
  const Deadline deadline(200, "a client that is a page");
  RunningServer server;
  const std::string by_code = R"({"t": "hello", "room": "BKRT", "run": "a run of a page", "kind": "page"})";
  Talk page(address_of(server), "", ConnectsAs::page), window(address_of(server));
  page.client.send(by_code);
  window.client.send(by_code);
  ASSERT_TRUE(page.wait_for("welcome")) << (page.closed ? page.closed->why : "");
  EXPECT_EQ((*page.last("welcome"))["you"]["role"], "participant");
  ASSERT_TRUE(window.wait_for_end());
  EXPECT_EQ(window.closed->code, 4401);
}

TEST(Client, IsToldWhyItIsClosed) {
  const Deadline deadline(200, "clients that are sent away");
  RunningServer server;
  const auto code_of = [&](const std::string& frame) {
    Talk talk(address_of(server));
    talk.client.send(frame);
    EXPECT_TRUE(talk.wait_for_end());
    EXPECT_FALSE(!talk.closed || talk.closed->why.empty());
    return talk.closed ? talk.closed->code : -1;
  };
  EXPECT_EQ(code_of("{"), 4400);
  EXPECT_EQ(code_of(hello("")), 4401) << "by the code alone come pages only, and these have an origin";
  EXPECT_EQ(code_of(hello("0123456789abcdef")), 4401);
  EXPECT_EQ(code_of(hello(server.invite("designer"), "a page", "page")), 4401);
  Talk talk(address_of(server));
  talk.client.send(hello(server.invite("designer")));
  ASSERT_TRUE(talk.wait_for("welcome"));
  server.stop();
  ASSERT_TRUE(talk.wait_for_end());
  EXPECT_EQ(talk.closed->code, 4503);
  talk.client.send("nobody hears this");
}

TEST(Client, SaysThatNobodyAnswers) {
  const Deadline deadline(200, "clients without a server");
  Talk nobody({.host = "127.0.0.1", .port = 1, .code = "BKRT", .invite = "", .is_secure = false});
  ASSERT_TRUE(nobody.wait_for_end());
  EXPECT_EQ(nobody.closed->code, 0);
  EXPECT_NE(nobody.closed->why.find("nobody answers at 127.0.0.1:1"), std::string::npos) << nobody.closed->why;
  Talk nowhere({.host = "no-such-host.invalid", .port = 1, .code = "BKRT", .invite = "", .is_secure = false});
  ASSERT_TRUE(nowhere.wait_for_end());
  EXPECT_NE(nowhere.closed->why.find("no-such-host.invalid"), std::string::npos) << nowhere.closed->why;
}

// A listener that takes connections and says nothing, as a program that hangs.
class Mute {
 public:
  Mute() : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    EXPECT_EQ(::listen(socket_, 8), 0);
    socklen_t length = sizeof address;
    ::getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &length);
    port_ = ntohs(address.sin_port);
  }
  ~Mute() { ::close(socket_); }
  Mute(const Mute&) = delete;
  Mute& operator=(const Mute&) = delete;
  std::uint16_t port() const { return port_; }

 private:
  int socket_;
  std::uint16_t port_ = 0;
};

TEST(Client, LeavesAServerThatHangsAtOnce) {
  const Deadline deadline(200, "leaving a server that hangs");
  const Mute mute;
  for (const bool is_secure : {false, true}) {
    auto talk = std::make_unique<Talk>(
        RoomAddress{.host = "127.0.0.1", .port = mute.port(), .code = "BKRT", .invite = "", .is_secure = is_secure});
    EXPECT_FALSE(talk->wait([&] { return talk->is_open; }, 1s));
    const auto begin = std::chrono::steady_clock::now();
    talk.reset();
    EXPECT_LT(std::chrono::steady_clock::now() - begin, 8s) << "it has waited for the opening, which may take ten seconds";
  }
}

// A certificate of our own for 127.0.0.1, in two files.
void write_certificate(const std::filesystem::path& folder) {
  EVP_PKEY* key = EVP_EC_gen("P-256");
  X509* certificate = X509_new();
  X509_set_version(certificate, 2);
  ASN1_INTEGER_set(X509_get_serialNumber(certificate), 1);
  X509_gmtime_adj(X509_getm_notBefore(certificate), -3600);
  X509_gmtime_adj(X509_getm_notAfter(certificate), 3600);
  X509_set_pubkey(certificate, key);
  X509_NAME* name = X509_get_subject_name(certificate);
  X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_ASC, reinterpret_cast<const unsigned char*>("room"), -1, -1, 0);
  X509_set_issuer_name(certificate, name);
  X509_EXTENSION* place = X509V3_EXT_conf_nid(nullptr, nullptr, NID_subject_alt_name, "IP:127.0.0.1");
  X509_add_ext(certificate, place, -1);
  X509_sign(certificate, key, EVP_sha256());
  const auto write = [&](const char* file, const auto& content) {
    BIO* out = BIO_new_file((folder / file).c_str(), "w");
    content(out);
    BIO_free(out);
  };
  write("certificate.pem", [&](BIO* out) { PEM_write_bio_X509(out, certificate); });
  write("key.pem", [&](BIO* out) { PEM_write_bio_PrivateKey(out, key, nullptr, nullptr, 0, nullptr, nullptr); });
  X509_EXTENSION_free(place);
  X509_free(certificate);
  EVP_PKEY_free(key);
}

TEST(Client, BelievesWhomItWasToldToBelieve) {
  const Deadline deadline(200, "clients by TLS");
  const auto folder = std::filesystem::temp_directory_path() / ("behaviourlinks_tls_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  write_certificate(folder);
  const std::string certificate = folder / "certificate.pem";
  {
    ServerOptions options;
    options.certificate = certificate;
    options.key = folder / "key.pem";
    RunningServer server(options);
    RoomAddress address = address_of(server);
    address.is_secure = true;
    Talk talk(address, certificate);
    talk.client.send(hello(server.invite("designer")));
    EXPECT_TRUE(talk.wait_for("welcome")) << (talk.closed ? talk.closed->why : "");
    Talk doubts(address);  // by the system's authorities, who have signed nothing of this
    EXPECT_TRUE(doubts.wait_for_end());
    EXPECT_FALSE(doubts.is_open);
    EXPECT_NE(doubts.closed->why.find("does not prove who it is"), std::string::npos) << doubts.closed->why;
    Talk another(
        [&] {
          RoomAddress named = address;
          named.host = "localhost";  // the certificate is another host's
          return named;
        }(),
        certificate);
    EXPECT_TRUE(another.wait_for_end());
    EXPECT_FALSE(another.is_open);
    Talk lost(address, folder / "nothing.pem");
    EXPECT_TRUE(lost.wait_for_end());
    EXPECT_NE(lost.closed->why.find("cannot be read"), std::string::npos) << lost.closed->why;
  }
  std::filesystem::remove_all(folder);
}

TEST(RoomAddresses, AreReadAsTheyStandInQrCodes) {
  const auto read = [](std::string_view text) {
    const auto address = room_address(text);
    EXPECT_TRUE(address.ok()) << text << ": " << (address.ok() ? "" : address.error().text());
    return address.ok() ? *address : RoomAddress{};
  };
  EXPECT_EQ(read("room://10.0.0.7/BKRT"), (RoomAddress{"10.0.0.7", 8080, "BKRT", "", false}));
  EXPECT_EQ(read("room://Laptop.local:81/bkrt/#k=0a1b"), (RoomAddress{"Laptop.local", 81, "BKRT", "0a1b", false}));
  EXPECT_EQ(read("http://10.0.0.7:8080/BKRT#k=0a1b"), (RoomAddress{"10.0.0.7", 8080, "BKRT", "0a1b", false}));
  EXPECT_EQ(read("https://rooms.example.org/BKRT"), (RoomAddress{"rooms.example.org", 443, "BKRT", "", true}));
  EXPECT_EQ(read("http://rooms.example.org/BKRT").port, 80);
  EXPECT_EQ(read("room://[fe80::1%eth0]:9/BKRT"), (RoomAddress{"fe80::1%eth0", 9, "BKRT", "", false}));
  EXPECT_EQ(read("room://[::1]/BKRT").host_and_port(), "[::1]:8080");
  EXPECT_EQ(read("room://here/BKRT").host_and_port(), "here:8080");
}

TEST(RoomAddresses, SayWhatIsWrongWithThem) {
  const std::pair<const char*, const char*> wrong[] = {
      {"", "begins with"},
      {"ftp://here/BKRT", "begins with"},
      {"room://here", "code of the room is missing"},
      {"room://here/", "code of the room is missing"},
      {"room:///BKRT", "host is missing"},
      {"room://:80/BKRT", "host is missing"},
      {"room://he re/BKRT", "is no host"},
      {"room://name@here/BKRT", "is no host"},
      {"room://here:/BKRT", "port is missing"},
      {"room://[::1]:/BKRT", "port is missing"},
      {"room://here:0/BKRT", "is no port"},
      {"room://here:70000/BKRT", "is no port"},
      {"room://here:8o/BKRT", "is no port"},
      {"room://fe80::1/BKRT", "needs brackets"},
      {"room://[::1/BKRT", "not closed"},
      {"room://[::1]8/BKRT", "after the bracket"},
      {"room://[here]/BKRT", "no IPv6 address"},
      {"room://here/BK RT", "no code"},
      {"room://here/BKRT/plain", "no code"},
      {"room://here/BKRT?k=1", "no code"},
      {"room://here/BKRT#1", "after `#`"},
      {"room://here/BKRT#k=", "not whole"},
      {"room://here/BKRT#k=a b", "not whole"},
  };
  for (const auto& [text, why] : wrong) {
    const auto address = room_address(text);
    ASSERT_FALSE(address.ok()) << text;
    EXPECT_NE(address.error().text().find(why), std::string::npos) << text << ": " << address.error().text();
  }
}

}  // namespace
}  // namespace bl::serve
