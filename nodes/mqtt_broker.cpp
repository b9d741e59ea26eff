// An MQTT broker: our user name there, and how the connection to it is secured.
#include "core/address/password_source.h"
#include "core/define/registry.h"
#include "core/define/typification_builder.h"

namespace bl {

namespace {

struct MqttBroker {
  struct In {
    std::string host = "localhost";
    int port = 1883;
    std::string user, password_from;
    bool is_encrypted = false;
    std::string ca_file;
  };
  struct Out {
    std::string message;
  };

  static void declare(TypificationBuilder<MqttBroker>& t) {
    t.id("mqtt_broker").label("MQTT broker");
    t.doc(
        "The connection of sensors and actuators to one broker. It applies to all addresses with this host and port. Without "
        "such a node they connect without a user name and unencrypted. Of several nodes for one broker the first id counts.");
    t.in(&In::host, "host").reaches_out().doc("The host as written in addresses, such as `localhost` or `broker.example.org`.");
    t.in(&In::port, "port").range(1, 65535).reaches_out().doc("Its port: usually 1883, or 8883 for encrypted connections.");
    t.in(&In::user, "user").doc("The user name at the broker; empty for none.");
    t.in(&In::password_from, "password_from")
        .reaches_out()
        .doc(
            "Where the password is: `env:BL_NAME` for a variable of the environment, or `file:NAME.password` for the first line "
            "of a "
            "file beside the scene; empty for none. The password itself never stands in a scene.");
    t.in(&In::is_encrypted, "is_encrypted")
        .doc("Connects by TLS and checks the certificate of the broker. When off, the password is sent unencrypted, too.");
    t.in(&In::ca_file, "ca_file")
        .reaches_out()
        .doc(
            "PEM file beside the scene with the certificates that the broker's certificate is checked against; empty for those "
            "that this computer trusts.");
    t.out(&Out::message, "message").doc("What is wrong with these settings, as a sentence; empty where nothing is.");
  }

  static Result<Out> evaluate(const In& in, const Tick&) {
    Out out;
    const auto add = [&out](const std::string& sentence) { out.message += (out.message.empty() ? "" : "; ") + sentence; };
    if (!in.password_from.empty())
      if (const auto source = address::parse_password_source(in.password_from); !source)
        add("password_from: " + source.error().message);
    if (in.user.empty() && !in.password_from.empty()) add("there is a password and no user");
    if (!in.ca_file.empty() && !in.is_encrypted) add("there is a `ca_file`, but the connection is not encrypted");
    return out;
  }
};

}  // namespace

}  // namespace bl

BL_TYPIFICATION(mqtt_broker, MqttBroker)
