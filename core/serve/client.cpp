// Boost.Beast, as a client. All handlers run on the thread of the client.
#include "core/serve/client.h"

#include <chrono>
#include <deque>
#include <future>
#include <mutex>
#include <optional>
#include <thread>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/ssl.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>

#include "core/serve/stream.h"

namespace bl::serve {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using std::chrono::milliseconds;
using std::chrono::seconds;

// A room that says nothing for four seconds is asked, and is gone after eight: a window has to say so before people wonder.
constexpr seconds kOpening{10}, kQuietServer{8}, kFarewell{1};
constexpr milliseconds kPatience{1500};                                  // of the destructor
constexpr std::size_t kLargestFrame = 64 << 20, kMostUnsent = 16 << 20;  // [bytes]

class Connection {
 public:
  virtual ~Connection() = default;
  virtual void begin() = 0;
  virtual void send(std::string frame) = 0;
  virtual void leave() = 0;
};

}  // namespace

// Belongs to the thread: so the client can go while a name is still being looked up, which nothing can stop.
struct Client::Core {
  RoomAddress address;
  std::string authorities;
  ConnectsAs as = ConnectsAs::window;
  asio::ssl::context tls{asio::ssl::context::tls_client};
  asio::io_context context{1};
  std::shared_ptr<Connection> connection;
  std::mutex mutex, wake_mutex;  // two, because who is woken may take at once
  std::vector<Happening> happenings;
  std::function<void()> wake;

  void tell(Happening happening) {
    {
      const std::lock_guard lock(mutex);
      happenings.push_back(std::move(happening));
    }
    const std::lock_guard lock(wake_mutex);
    if (wake) wake();
  }
};

struct Client::Finish {
  std::thread thread;
  std::future<void> over;
};

namespace {

// `Core` is the client's, whose name is not ours to say.
template <class Core>
class SocketConnection : public Connection, public std::enable_shared_from_this<SocketConnection<Core>> {
 public:
  SocketConnection(Core& core, Stream stream)
      : core_(core), resolver_(core.context), deadline_(core.context), socket_(std::move(stream)) {}

  void begin() override {
    deadline_.expires_after(kOpening);
    deadline_.async_wait([self = this->shared_from_this()](beast::error_code stopped) {
      if (!stopped) self->end(0, self->core_.address.host_and_port() + " does not answer");
    });
    beast::error_code no_number;
    const auto number = asio::ip::make_address(core_.address.host, no_number);
    is_name_ = no_number.failed();
    if (!is_name_) return connect(std::vector<Tcp::endpoint>{{number, core_.address.port}});
    resolver_.async_resolve(core_.address.host, std::to_string(core_.address.port),
                            [self = this->shared_from_this()](beast::error_code error, const Tcp::resolver::results_type& found) {
                              if (error)
                                return self->end(0, "there is no host `" + self->core_.address.host + "`: " + error.message());
                              std::vector<Tcp::endpoint> all;
                              for (const auto& one : found) all.push_back(one.endpoint());
                              self->connect(std::move(all));
                            });
  }

  void send(std::string frame) override {
    if (is_over_ || is_leaving_) return;
    unsent_ += frame.size();
    if (unsent_ > kMostUnsent) return end(0, "the room takes nothing any more");
    queue_.push_back(std::move(frame));
    if (is_open_ && queue_.size() == 1) write();
  }

  void leave() override {
    if (is_over_ || std::exchange(is_leaving_, true)) return;
    if (!is_open_) return end(0, "");
    deadline_.expires_after(kFarewell);
    deadline_.async_wait([self = this->shared_from_this()](beast::error_code stopped) {
      if (!stopped) self->end(0, "");
    });
    if (queue_.empty()) say_goodbye();
  }

 private:
  void connect(std::vector<Tcp::endpoint> endpoints) {
    if (is_over_) return;
    endpoints_ = std::move(endpoints);
    lowest().async_connect(endpoints_, [self = this->shared_from_this()](beast::error_code error, const Tcp::endpoint&) {
      if (error) return self->end(0, "nobody answers at " + self->core_.address.host_and_port() + ": " + error.message());
      beast::error_code ignored;
      self->lowest().socket().set_option(Tcp::no_delay(true), ignored);
      self->secure();
    });
  }

  void secure() {
    Stream& stream = socket_.next_layer();
    if (Stream::Encrypted* const encrypted = stream.encrypted()) {
      const std::string& host = core_.address.host;
      encrypted->set_verify_callback(asio::ssl::host_name_verification(host));
      if (is_name_) (void)SSL_set_tlsext_host_name(encrypted->native_handle(), host.c_str());
    }
    stream.shake_hands(asio::ssl::stream_base::client, [self = this->shared_from_this()](beast::error_code error) {
      if (error) return self->end(0, self->core_.address.host + " does not prove who it is: " + error.message());
      self->shake_hands();
    });
  }

  void shake_hands() {
    websocket::stream_base::timeout timeouts{};
    timeouts.handshake_timeout = kOpening;
    timeouts.idle_timeout = kQuietServer;
    timeouts.keep_alive_pings = true;
    socket_.set_option(timeouts);
    const std::string origin =
        core_.as == ConnectsAs::page ? (core_.address.is_secure ? "https://" : "http://") + core_.address.host_and_port() : "";
    socket_.set_option(websocket::stream_base::decorator([origin](websocket::request_type& request) {
      request.set(beast::http::field::sec_websocket_protocol, "bl1");
      if (!origin.empty()) request.set(beast::http::field::origin, origin);
    }));
    socket_.read_message_max(kLargestFrame);
    socket_.text(true);
    socket_.async_handshake(response_, core_.address.host_and_port(), "/ws",
                            [self = this->shared_from_this()](beast::error_code error) { self->have_shaken(error); });
  }

  void have_shaken(beast::error_code error) {
    if (is_over_) return;
    const std::string where = core_.address.host_and_port();
    if (error == websocket::error::upgrade_declined)
      return end(0, where + " refuses the connection: " + std::to_string(response_.result_int()) + " " + response_.body());
    if (error) return end(0, where + " does not speak as a room does: " + error.message());
    if (response_[beast::http::field::sec_websocket_protocol] != "bl1")
      return end(0, where + " speaks another protocol; its version of the program may be another one");
    is_open_ = true;
    deadline_.cancel();
    core_.tell(Opened{});
    read();
    if (!queue_.empty()) write();
  }

  void read() {
    socket_.async_read(buffer_, [self = this->shared_from_this()](beast::error_code error, std::size_t) {
      if (error) return self->have_lost(error);
      std::string frame = beast::buffers_to_string(self->buffer_.data());
      self->buffer_.consume(self->buffer_.size());
      self->core_.tell(Arrived{std::move(frame)});
      self->read();
    });
  }

  void have_lost(beast::error_code error) {
    const auto& reason = socket_.reason();
    if (error == websocket::error::closed) return end(reason.code, {reason.reason.data(), reason.reason.size()});
    if (error == beast::error::timeout) return end(0, "the room has said nothing for eight seconds");
    end(0, "the connection is broken: " + error.message());
  }

  void write() {
    socket_.async_write(asio::buffer(queue_.front()), [self = this->shared_from_this()](beast::error_code error, std::size_t) {
      if (error || self->is_over_) return;  // reading ends, too, and tells why
      self->unsent_ -= self->queue_.front().size();
      self->queue_.pop_front();
      if (!self->queue_.empty()) self->write();
      else if (self->is_leaving_) self->say_goodbye();
    });
  }

  void say_goodbye() {
    socket_.async_close(websocket::close_code::normal,
                        [self = this->shared_from_this()](beast::error_code) { self->end(1000, ""); });
  }

  void end(int code, std::string why) {
    if (std::exchange(is_over_, true)) return;
    deadline_.cancel();
    resolver_.cancel();
    lowest().close();
    core_.tell(Closed{code, std::move(why)});
    core_.context.stop();  // timers of the stream would keep the thread for some seconds more
  }

  beast::tcp_stream& lowest() { return beast::get_lowest_layer(socket_); }

  Core& core_;
  Tcp::resolver resolver_;
  asio::steady_timer deadline_;
  websocket::stream<Stream> socket_;
  websocket::response_type response_;
  std::vector<Tcp::endpoint> endpoints_;
  beast::flat_buffer buffer_;
  std::deque<std::string> queue_;
  std::size_t unsent_ = 0;
  bool is_name_ = false, is_open_ = false, is_leaving_ = false, is_over_ = false;
};

template <class Core>
std::shared_ptr<Connection> connection_of(Core& core) {
  Stream::Lowest plain(core.context);
  if (!core.address.is_secure) return std::make_shared<SocketConnection<Core>>(core, Stream(std::move(plain)));
  beast::error_code error;
  core.tls.set_options(asio::ssl::context::no_sslv2 | asio::ssl::context::no_sslv3 | asio::ssl::context::no_tlsv1 |
                       asio::ssl::context::no_tlsv1_1);
  core.tls.set_verify_mode(asio::ssl::verify_peer, error);
  if (!error && core.authorities.empty()) core.tls.set_default_verify_paths(error);
  else if (!error) core.tls.load_verify_file(core.authorities, error);
  if (error) {
    core.tell(Closed{
        0, (core.authorities.empty() ? "the system's certificates" : core.authorities) + " cannot be read: " + error.message()});
    return nullptr;
  }
  return std::make_shared<SocketConnection<Core>>(core, Stream(Stream::Encrypted(std::move(plain), core.tls)));
}

}  // namespace

Client::Client(const RoomAddress& address, std::function<void()> wake, std::string authorities, ConnectsAs as)
    : core_(std::make_shared<Core>()), finish_(std::make_unique<Finish>()) {
  core_->address = address;
  core_->authorities = std::move(authorities);
  core_->as = as;
  core_->wake = std::move(wake);
  std::promise<void> promise;
  finish_->over = promise.get_future();
  finish_->thread = std::thread([core = core_, over = std::move(promise)]() mutable {
    core->connection = connection_of(*core);
    if (core->connection) core->connection->begin();
    core->context.run();
    core->connection.reset();
    core.reset();
    over.set_value();
  });
}

Client::~Client() {
  {
    const std::lock_guard lock(core_->wake_mutex);
    core_->wake = nullptr;
  }
  // The thread holds the core for as long as anything runs there.
  asio::post(core_->context, [core = core_.get()] {
    if (core->connection) core->connection->leave();
  });
  core_.reset();
  const bool is_over = finish_->over.wait_for(kPatience) == std::future_status::ready;
  if (is_over) finish_->thread.join();
  else finish_->thread.detach();
}

void Client::send(std::string frame) {
  asio::post(core_->context, [core = core_.get(), frame = std::move(frame)]() mutable {
    if (core->connection) core->connection->send(std::move(frame));
  });
}

std::vector<Happening> Client::take() {
  const std::lock_guard lock(core_->mutex);
  return std::exchange(core_->happenings, {});
}

}  // namespace bl::serve
