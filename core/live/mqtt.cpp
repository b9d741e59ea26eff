// A connection to an MQTT broker: subscribes to the topics of sensors, publishes what actuators say.
#include <mosquitto.h>
#include <mqtt_protocol.h>

#include <map>
#include <memory>
#include <set>

#include "core/live/endpoint.h"
#include "core/live/message.h"
#include "core/live/socket.h"

namespace bl::live {

namespace {

constexpr int kKeepAlive = 20;   // [s] of silence after which the broker is asked whether it is there
constexpr int kMqttSlice = 20;   // [ms] that one look at the socket may wait
constexpr int kDelivery = 1;     // quality of service: the broker confirms what it got
constexpr int kGreetings = 500;  // looks at the socket until the broker has to have answered: ten seconds

struct MqttLibrary {
  MqttLibrary() { mosquitto_lib_init(); }
  ~MqttLibrary() { mosquitto_lib_cleanup(); }
};

// What mosquitto's callbacks reach; all of them run on the thread of the endpoint.
class Broker {
 public:
  explicit Broker(Endpoint& endpoint) : endpoint_(endpoint), client_(mosquitto_new(nullptr, true, this), mosquitto_destroy) {}

  // Until the connection ends; the sentence why it did.
  std::string run() {
    if (!client_) return "there is no memory for a connection";
    mosquitto_connect_callback_set(client_.get(), [](mosquitto*, void* self, int code) { of(self).on_connected(code); });
    mosquitto_message_callback_set(client_.get(),
                                   [](mosquitto*, void* self, const mosquitto_message* m) { of(self).arrived(*m); });
    mosquitto_publish_callback_set(client_.get(), [](mosquitto*, void* self, int id) { of(self).confirmed(id); });
    // Asked first by ourselves: the library waits for silent hosts for minutes, and does not say what is wrong.
    if (const auto answer = knock(endpoint_); !answer) return answer.error().message;
    if (const auto secured = enter(); !secured) return secured.error().message;
    if (const int code = mosquitto_connect(client_.get(), endpoint_.host().c_str(), endpoint_.port(), kKeepAlive);
        code != MOSQ_ERR_SUCCESS)
      return unconnected(code);
    for (int looks = 0; !endpoint_.is_ending(); ++looks) {
      if (const int code = mosquitto_loop(client_.get(), kMqttSlice, 1); code != MOSQ_ERR_SUCCESS)
        return !refusal_.empty() ? refusal_ : unconnected(code);
      if (!is_greeted_ && looks > kGreetings) return endpoint_.place() + " answers, but not as an MQTT broker does";
      if (!is_greeted_) continue;
      follow_topics();
      publish();
    }
    mosquitto_disconnect(client_.get());
    return "";
  }

 private:
  static Broker& of(void* self) { return *static_cast<Broker*>(self); }

  // Says who we are, and secures the connection, before it is made.
  Result<void> enter() {
    const Access& access = endpoint_.access();
    const auto at_node = [&](const Error& error) {
      return Error{error.code, "", error.message + " (node `" + access.node + "`, for " + endpoint_.place() + ")"};
    };
    const auto password = access.password();
    if (!password) return at_node(password.error());
    if (!access.user.empty())
      mosquitto_username_pw_set(client_.get(), access.user.c_str(), access.password_from.empty() ? nullptr : password->c_str());
    if (!access.is_encrypted) return {};
    const auto certificates = access.certificates();
    if (!certificates) return at_node(certificates.error());
    const int code = certificates->empty()
                         ? mosquitto_int_option(client_.get(), MOSQ_OPT_TLS_USE_OS_CERTS, 1)
                         : mosquitto_tls_set(client_.get(), certificates->c_str(), nullptr, nullptr, nullptr, nullptr);
    if (code != MOSQ_ERR_SUCCESS)
      return at_node({ErrorCode::io, "", std::string("the connection cannot be encrypted: ") + mosquitto_strerror(code)});
    return {};
  }

  std::string unconnected(int code) const {
    const Access& access = endpoint_.access();
    if (access.is_encrypted && !is_greeted_)
      return endpoint_.place() +
             " cannot be connected to by TLS: it speaks without, or its certificate is made out to another name "
             "or vouched for by nobody whom node `" +
             access.node + "` trusts";
    if (code != MOSQ_ERR_CONN_LOST || is_greeted_) return endpoint_.place() + " has closed the connection";
    return endpoint_.place() + " has closed the connection; it may want an encrypted one: " + who_to_ask();
  }

  // Where people say who we are at this broker.
  std::string who_to_ask() const {
    const Access& access = endpoint_.access();
    return access.node.empty() ? "a node typified as `mqtt_broker` for this host and port says how it is entered"
                               : "see node `" + access.node + "`";
  }

  void on_connected(int code) {
    if (code != 0) {
      const bool is_name = code == CONNACK_REFUSED_BAD_USERNAME_PASSWORD || code == CONNACK_REFUSED_NOT_AUTHORIZED;
      const Access& access = endpoint_.access();
      refusal_ = "the broker " + endpoint_.place() + " refuses the connection: " + mosquitto_connack_string(code);
      if (is_name && !access.user.empty())
        refusal_ += " The user `" + access.user + "` or the password of node `" + access.node + "` is not the right one.";
      else if (is_name) refusal_ += " It wants a user and a password: " + who_to_ask() + ".";
      return;
    }
    is_greeted_ = true;
    follow_topics();
    endpoint_.succeed();
  }

  // A sensor that comes or goes leaves the topics of the others alone.
  void follow_topics() {
    std::set<std::string> wanted;
    for (const Subscriber& subscriber : endpoint_.subscribers()) wanted.insert(subscriber.path);
    for (const std::string& topic : wanted)
      if (!topics_.contains(topic)) mosquitto_subscribe(client_.get(), nullptr, topic.c_str(), kDelivery);
    for (const std::string& topic : topics_)
      if (!wanted.contains(topic)) mosquitto_unsubscribe(client_.get(), nullptr, topic.c_str());
    topics_ = std::move(wanted);
  }

  // A retained message may be of any age: it is no reading of now.
  void arrived(const mosquitto_message& message) {
    const std::string_view payload(static_cast<const char*>(message.payload),
                                   message.payload != nullptr ? static_cast<std::size_t>(message.payloadlen) : 0);
    for (const Subscriber& subscriber : endpoint_.subscribers()) {
      if (subscriber.path != message.topic) continue;
      if (message.retain) subscriber.station->count(&Traffic::skipped);
      else subscriber.station->message(payload);
    }
  }

  void publish() {
    for (const Outgoing& message : endpoint_.outgoing()) {
      int id = 0;
      const int done = mosquitto_publish(client_.get(), &id, message.path.c_str(), static_cast<int>(message.text.size()),
                                         message.text.data(), kDelivery, false);
      if (done != MOSQ_ERR_SUCCESS) {
        message.station->line(std::string("a message could not be sent: ") + mosquitto_strerror(done));
        continue;
      }
      message.station->line("");
      message.station->count(&Traffic::sent);
      unconfirmed_[id] = message.station;
    }
  }

  void confirmed(int id) {
    const auto found = unconfirmed_.find(id);
    if (found == unconfirmed_.end()) return;
    found->second->count(&Traffic::acknowledged);
    unconfirmed_.erase(found);
  }

  Endpoint& endpoint_;
  std::unique_ptr<mosquitto, decltype(&mosquitto_destroy)> client_;
  bool is_greeted_ = false;
  std::string refusal_;
  std::set<std::string> topics_;                         // that are subscribed to
  std::map<int, std::shared_ptr<Station>> unconfirmed_;  // by the library's number of the message
};

}  // namespace

void run_mqtt(Endpoint& endpoint) {
  static const MqttLibrary kLibrary;
  while (!endpoint.is_ending())
    if (const std::string problem = Broker(endpoint).run(); !problem.empty()) endpoint.fail(problem);
}

}  // namespace bl::live
