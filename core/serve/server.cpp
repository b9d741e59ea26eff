// Boost.Beast, as a server. All handlers run on one thread, which is also the rooms'.
#include "core/serve/server.h"

#include <utility>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/ssl.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/ssl.hpp>
#include <boost/beast/websocket.hpp>
#include <boost/beast/websocket/ssl.hpp>
#include <chrono>
#include <deque>
#include <optional>

#include <nlohmann/json.hpp>

#include "core/room/refusals.h"
#include "core/wire/operations.h"

namespace bl::serve {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using Tcp = asio::ip::tcp;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr std::uint32_t kMostHeader = 8192;
constexpr std::uint64_t kMostBody = 16 << 10;
constexpr std::size_t kMostHello = 4 << 10, kMostPageFrame = 64 << 10, kMostDesignerFrame = 1 << 20;
constexpr seconds kHandshake{5}, kIdle{20}, kRequest{5};
// A page says ten things a second, and thirty in a burst; who sends more waits, because nothing more is read.
constexpr double kPageRate = 10, kPageBurst = 30, kDesignerRate = 60;

// What every answer has (OWASP ASVS 5.0, V3.4): nothing from elsewhere, nothing inline, nobody's frame.
void add_security(http::fields& fields, const std::string& host) {
  const std::string socket = host.empty() ? "" : " ws://" + host + " wss://" + host;
  fields.set("Content-Security-Policy",
             "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; connect-src 'self'" + socket +
                 "; base-uri 'none'; form-action 'self'; frame-ancestors 'none'; require-trusted-types-for 'script'");
  fields.set("Referrer-Policy", "no-referrer");
  fields.set("X-Content-Type-Options", "nosniff");
  fields.set("Cross-Origin-Opener-Policy", "same-origin");
  fields.set("Permissions-Policy", "camera=(), microphone=(), geolocation=()");
}

std::string_view text_of(beast::string_view text) { return {text.data(), text.size()}; }

// The host goes into a header: what is no host name is left out.
std::string plain_host(std::string_view text) {
  const bool is_plain =
      text.size() < 256 &&
      text.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.-:[]") == std::string_view::npos;
  return is_plain ? std::string(text) : std::string();
}

// The page of another site may not talk to us in the name of somebody who has both open.
bool is_own_origin(std::string_view origin, std::string_view host) {
  const std::size_t scheme = origin.find("://");
  return scheme != std::string_view::npos && !host.empty() && origin.substr(scheme + 3) == host;
}

struct Shared {
  explicit Shared(asio::io_context& the_context) : context(the_context) {}
  asio::io_context& context;
  Rooms rooms;
  std::optional<Pages> pages;
  std::optional<asio::ssl::context> tls;
  bool is_stopping = false;
};

// One WebSocket. The stream is plain or encrypted.
template <class Stream>
class SocketGuest : public Guest, public std::enable_shared_from_this<SocketGuest<Stream>> {
 public:
  SocketGuest(Stream stream, Shared& shared, bool has_origin)
      : socket_(std::move(stream)), timer_(shared.context), shared_(shared), has_origin_(has_origin) {}

  void accept(const http::request<http::string_body>& request) {
    websocket::stream_base::timeout timeouts{};
    timeouts.handshake_timeout = kHandshake;
    timeouts.idle_timeout = kIdle;
    timeouts.keep_alive_pings = true;
    socket_.set_option(timeouts);
    // A protocol is named only to who has asked for it (RFC 6455, 4.2.2).
    const bool asks = text_of(request[http::field::sec_websocket_protocol]).find("bl1") != std::string_view::npos;
    socket_.set_option(websocket::stream_base::decorator([asks](websocket::response_type& response) {
      add_security(response, "");
      if (asks) response.set(http::field::sec_websocket_protocol, "bl1");
    }));
    socket_.read_message_max(kMostHello);
    socket_.text(true);
    socket_.async_accept(request, [self = this->shared_from_this()](beast::error_code error) {
      if (error) return;
      self->timer_.expires_after(kHandshake);
      self->timer_.async_wait([self](beast::error_code stopped) {
        if (!stopped && self->room_ == nullptr) self->close(CloseCode::no_hello, "no hello in five seconds");
      });
      self->read();
    });
  }

  void send(std::shared_ptr<const std::string> frame) override {
    if (is_closing_) return;
    unsent_ += frame->size();
    queue_.push_back(std::move(frame));
    if (queue_.size() == 1) write();
  }

  void close(CloseCode code, const std::string& why) override {
    if (is_closing_) return;
    is_closing_ = true;
    reason_ = websocket::close_reason(static_cast<websocket::close_code>(code), why.substr(0, 120));
    if (queue_.empty()) say_goodbye();
  }

  std::size_t unsent() const override { return unsent_; }

 private:
  void read() {
    socket_.async_read(buffer_,
                       [self = this->shared_from_this()](beast::error_code error, std::size_t) { self->have_read(error); });
  }

  void have_read(beast::error_code error) {
    if (error) {
      if (error == websocket::error::message_too_big && !is_closing_) is_closing_ = true;
      return gone();
    }
    if (is_closing_) return gone();
    const std::string text = beast::buffers_to_string(buffer_.data());
    buffer_.consume(buffer_.size());
    if (!socket_.got_text()) return close(CloseCode::bad_frame, "frames are text");
    if (room_ == nullptr) begin(text);
    else room_->hear(*this, text);
    if (is_closing_ && queue_.empty()) return;
    read_in_time();
  }

  void begin(const std::string& text) {
    const auto frame = wire::read_frame(text);
    if (!frame) return close(CloseCode::bad_frame, frame.error().text());
    if ((*frame)["t"] != "hello") return close(CloseCode::no_hello, "the first frame is no hello");
    const auto hello = wire::read_message<wire::Hello>(*frame);
    if (!hello) return close(CloseCode::bad_frame, hello.error().text());
    if (!has_origin_ && hello->kind != "desktop") return close(CloseCode::no_seat, "pages come from this server");
    if (!has_origin_ && hello->token.empty() && hello->invite.empty())
      return close(CloseCode::no_seat, "a window comes in by an invitation: copy the whole address, with what follows #");
    const auto room = shared_.rooms.find(hello->room);
    if (room == shared_.rooms.end()) return close(CloseCode::no_seat, "there is no room with this code");
    room_ = room->second.get();
    timer_.cancel();
    const bool is_desktop = hello->kind == "desktop";
    socket_.read_message_max(is_desktop ? kMostDesignerFrame : kMostPageFrame);
    rate_ = is_desktop ? kDesignerRate : kPageRate;
    (void)room_->greet(this->shared_from_this(), *hello);
  }

  // What comes too fast is left in the network: whoever sends it waits, and nobody else does.
  void read_in_time() {
    const auto now = std::chrono::steady_clock::now();
    const double passed = std::chrono::duration<double>(now - filled_).count();
    filled_ = now;
    tokens_ = std::min(kPageBurst * rate_ / kPageRate, tokens_ + passed * rate_) - 1;
    if (tokens_ >= 0) return read();
    timer_.expires_after(milliseconds(static_cast<int>(-tokens_ / rate_ * 1000) + 1));
    timer_.async_wait([self = this->shared_from_this()](beast::error_code error) {
      if (!error) self->read();
    });
  }

  void write() {
    socket_.async_write(asio::buffer(*queue_.front()), [self = this->shared_from_this()](beast::error_code error, std::size_t) {
      if (error) return self->gone();
      self->unsent_ -= self->queue_.front()->size();
      self->queue_.pop_front();
      if (!self->queue_.empty()) self->write();
      else if (self->is_closing_) self->say_goodbye();
    });
  }

  void say_goodbye() {
    if (std::exchange(has_said_goodbye_, true)) return;
    timer_.cancel();
    socket_.async_close(reason_, [self = this->shared_from_this()](beast::error_code) { self->gone(); });
  }

  void gone() {
    is_closing_ = true;
    timer_.cancel();
    if (RoomHost* room = std::exchange(room_, nullptr); room != nullptr && !shared_.is_stopping) room->leave(*this);
  }

  websocket::stream<Stream> socket_;
  asio::steady_timer timer_;
  Shared& shared_;
  beast::flat_buffer buffer_;
  std::deque<std::shared_ptr<const std::string>> queue_;
  std::size_t unsent_ = 0;
  RoomHost* room_ = nullptr;
  websocket::close_reason reason_;
  bool has_origin_ = false, is_closing_ = false, has_said_goodbye_ = false;
  double tokens_ = kPageBurst, rate_ = kPageRate;
  std::chrono::steady_clock::time_point filled_ = std::chrono::steady_clock::now();
};

// The requests of one connection, one after the other.
template <class Stream>
class Caller : public std::enable_shared_from_this<Caller<Stream>> {
 public:
  Caller(Stream stream, Shared& shared) : stream_(std::move(stream)), shared_(shared) {}

  void begin() {
    if constexpr (std::is_same_v<Stream, beast::tcp_stream>) return read();
    else {
      beast::get_lowest_layer(stream_).expires_after(kHandshake);
      stream_.async_handshake(asio::ssl::stream_base::server, [self = this->shared_from_this()](beast::error_code error) {
        if (!error) self->read();
      });
    }
  }

 private:
  void read() {
    parser_.emplace();
    parser_->header_limit(kMostHeader);
    parser_->body_limit(kMostBody);
    beast::get_lowest_layer(stream_).expires_after(kRequest);
    http::async_read(stream_, buffer_, *parser_,
                     [self = this->shared_from_this()](beast::error_code error, std::size_t) { self->have_read(error); });
  }

  void have_read(beast::error_code error) {
    if (error == http::error::end_of_stream) return end();
    if (error == http::error::header_limit)
      return refuse(http::status::request_header_fields_too_large, "The header is too long.");
    if (error == http::error::body_limit) return refuse(http::status::payload_too_large, "The form is too long.");
    // What the parser does not take may mean something else to whoever stands between: such a connection is ended.
    if (error)
      return error.category() == http::make_error_code(http::error::bad_method).category()
                 ? refuse(http::status::bad_request, "This is no request that this server understands.")
                 : end();
    auto request = parser_->release();
    const bool is_ambiguous = request.count(http::field::transfer_encoding) > 0 && request.count(http::field::content_length) > 0;
    if (is_ambiguous || request.count(http::field::host) > 1)
      return refuse(http::status::bad_request, "The request says its length or its host twice.");
    if (shared_.is_stopping) return refuse(http::status::service_unavailable, "The room is being closed.");
    if (websocket::is_upgrade(request)) return upgrade(std::move(request));
    keeps_alive_ = request.keep_alive();
    is_head_ = request.method() == http::verb::head;
    version_ = request.version();
    host_ = plain_host(text_of(request[http::field::host]));
    const Request plain{std::string(request.method_string()), std::string(request.target()), request.body(), host_,
                        text_of(request[http::field::accept_encoding]).find("gzip") != std::string_view::npos};
    shared_.pages->answer(plain, [self = this->shared_from_this()](Response response) { self->write(std::move(response)); });
  }

  void upgrade(http::request<http::string_body> request) {
    const std::string_view origin = text_of(request[http::field::origin]), host = text_of(request[http::field::host]);
    if (request.target() != "/ws") return refuse(http::status::not_found, "Connections go to /ws.");
    if (!origin.empty() && !is_own_origin(origin, host))
      return refuse(http::status::forbidden, "This page is not one of this server.");
    beast::get_lowest_layer(stream_).expires_never();
    std::make_shared<SocketGuest<Stream>>(std::move(stream_), shared_, !origin.empty())->accept(request);
  }

  void refuse(http::status status, const std::string& text) {
    keeps_alive_ = false;
    write({.status = static_cast<int>(status), .type = "text/plain; charset=utf-8", .body = text + "\n"});
  }

  void write(Response response) {
    response_.emplace();
    response_->version(version_);
    response_->result(static_cast<unsigned>(response.status));
    add_security(*response_, host_);
    for (const auto& [name, value] : response.fields) response_->set(name, value);
    response_->set(http::field::content_type, response.type);
    response_->keep_alive(keeps_alive_);
    const std::size_t length = response.body.size();
    if (!is_head_) response_->body() = std::move(response.body);
    response_->content_length(length);
    beast::get_lowest_layer(stream_).expires_after(kRequest);
    const auto done = [self = this->shared_from_this()](beast::error_code error, std::size_t) {
      if (error || !self->keeps_alive_) return self->end();
      self->read();
    };
    if (!is_head_) return http::async_write(stream_, *response_, done);
    serializer_.emplace(*response_);
    http::async_write_header(stream_, *serializer_, done);
  }

  void end() {
    beast::error_code ignored;
    beast::get_lowest_layer(stream_).socket().shutdown(Tcp::socket::shutdown_send, ignored);
  }

  Stream stream_;
  Shared& shared_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::string_body>> parser_;
  std::optional<http::response<http::string_body>> response_;
  std::optional<http::response_serializer<http::string_body>> serializer_;
  std::string host_;
  unsigned version_ = 11;
  bool keeps_alive_ = false, is_head_ = false;
};

class BeastServer : public Server {
 public:
  Result<void> begin(const ServerOptions& options) {
    beast::error_code error;
    const auto address = asio::ip::make_address(options.address, error);
    if (error) return Error{ErrorCode::parse, "--bind", "`" + options.address + "` is no address"};
    if (!options.certificate.empty()) {
      shared_.tls.emplace(asio::ssl::context::tls_server);
      shared_.tls->set_options(asio::ssl::context::no_sslv2 | asio::ssl::context::no_sslv3 | asio::ssl::context::no_tlsv1 |
                               asio::ssl::context::no_tlsv1_1);
      shared_.tls->use_certificate_chain_file(options.certificate, error);
      if (error) return Error{ErrorCode::io, options.certificate, "is no certificate in PEM form: " + error.message()};
      shared_.tls->use_private_key_file(options.key, asio::ssl::context::pem, error);
      if (error) return Error{ErrorCode::io, options.key, "is no key of this certificate: " + error.message()};
    }
    const Tcp::endpoint endpoint(address, options.port);
    acceptor_.open(endpoint.protocol(), error);
    if (!error) acceptor_.set_option(asio::socket_base::reuse_address(true), error);
    if (!error) acceptor_.bind(endpoint, error);
    if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
    if (error)
      return Error{ErrorCode::io, "port " + std::to_string(options.port),
                   "cannot be opened: " + error.message() +
                       (error == asio::error::address_in_use ? "; another server may run there, choose another --port" : "")};
    shared_.pages.emplace(shared_.rooms, options.page_folder, options.certificate.empty() ? "http" : "https");
    return {};
  }

  std::uint16_t port() const override {
    beast::error_code ignored;
    return acceptor_.local_endpoint(ignored).port();
  }
  Rooms& rooms() override { return shared_.rooms; }
  void post(std::function<void()> task) override { asio::post(context_, std::move(task)); }

  void run() override {
    accept();
    turn();
    context_.run();
    // Rooms store what waits, and what is called back then still finds them.
    for (auto& [code, room] : shared_.rooms) room->close();
    context_.restart();
    context_.poll();
    shared_.rooms.clear();
  }

  void stop() override {
    asio::post(context_, [this] {
      shared_.is_stopping = true;
      beast::error_code ignored;
      acceptor_.close(ignored);
      timer_.cancel();
      for (auto& [code, room] : shared_.rooms) room->close();
      // Goodbyes are said before the thread ends.
      farewell_.expires_after(milliseconds(200));
      farewell_.async_wait([this](beast::error_code) { context_.stop(); });
    });
  }

 private:
  void accept() {
    acceptor_.async_accept([this](beast::error_code error, Tcp::socket socket) {
      if (!acceptor_.is_open()) return;
      if (!error) {
        beast::error_code ignored;
        socket.set_option(Tcp::no_delay(true), ignored);
        if (shared_.tls)
          std::make_shared<Caller<beast::ssl_stream<beast::tcp_stream>>>(
              beast::ssl_stream<beast::tcp_stream>(beast::tcp_stream(std::move(socket)), *shared_.tls), shared_)
              ->begin();
        else std::make_shared<Caller<beast::tcp_stream>>(beast::tcp_stream(std::move(socket)), shared_)->begin();
      }
      // Out of file handles, say: tried again a little later, so that the thread does not spin.
      if (!error) return accept();
      retry_.expires_after(milliseconds(100));
      retry_.async_wait([this](beast::error_code stopped) {
        if (!stopped) accept();
      });
    });
  }

  void turn() {
    timer_.expires_after(milliseconds(50));
    timer_.async_wait([this](beast::error_code error) {
      if (error || shared_.is_stopping) return;
      for (auto& [code, room] : shared_.rooms) room->turn();
      turn();
    });
  }

  asio::io_context context_{1};
  Shared shared_{context_};
  Tcp::acceptor acceptor_{context_};
  asio::steady_timer timer_{context_}, farewell_{context_}, retry_{context_};
};

}  // namespace

Result<std::unique_ptr<Server>> Server::open(const ServerOptions& options) {
  auto server = std::make_unique<BeastServer>();
  if (auto begun = server->begin(options); !begun) return begun.error();
  return std::unique_ptr<Server>(std::move(server));
}

}  // namespace bl::serve
