// HTTP by Boost.Beast, and the connections themselves. All handlers run on one thread, which is also the rooms'.
#include "core/serve/server.h"

#include <utility>

#include <boost/asio/post.hpp>
#include <boost/beast/websocket/rfc6455.hpp>

#include "core/file/file_io.h"
#include "core/serve/beast.h"

namespace bl::serve {

namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr std::uint32_t kMostHeader = 8192;
constexpr std::uint64_t kMostBody = 16 << 10;
constexpr seconds kRequest{5};
constexpr std::size_t kSlowestTaker = 16 << 10;  // whoever takes an answer slower than that is sent away [bytes/s]

// An address as limits count it: a whole network of IPv6 is one, because whoever has it has all of its addresses.
std::string network_of(const asio::ip::address& address) {
  if (!address.is_v6()) return address.to_string();
  if (address.to_v6().is_v4_mapped()) return asio::ip::make_address_v4(asio::ip::v4_mapped, address.to_v6()).to_string();
  auto bytes = address.to_v6().to_bytes();
  std::fill(bytes.begin() + 8, bytes.end(), std::uint8_t{0});
  return asio::ip::make_address_v6(bytes).to_string();
}

// As people write it: an IPv4 address also where it came by a socket of IPv6.
std::string plain_address(const asio::ip::address& address) {
  if (address.is_v6() && address.to_v6().is_v4_mapped())
    return asio::ip::make_address_v4(asio::ip::v4_mapped, address.to_v6()).to_string();
  return address.to_string();
}

// The requests of one connection, one after the other.
class Caller : public std::enable_shared_from_this<Caller> {
 public:
  Caller(Stream stream, Shared& shared, std::unique_ptr<Gate::Pass> pass, const std::string& peer)
      : stream_(std::move(stream)), shared_(shared), pass_(std::move(pass)), peer_(peer) {}

  void wait_for_turn() {
    pass_->begin([self = shared_from_this()] { self->begin(); }, now());
  }

 private:
  void begin() {
    beast::get_lowest_layer(stream_).expires_after(kHandshake);
    stream_.shake_hands(asio::ssl::stream_base::server, [self = shared_from_this()](beast::error_code error) {
      if (!error) self->read();
    });
  }

  void read() {
    parser_.emplace();
    parser_->header_limit(kMostHeader);
    parser_->body_limit(kMostBody);
    beast::get_lowest_layer(stream_).expires_after(kRequest);
    http::async_read(stream_, buffer_, *parser_,
                     [self = shared_from_this()](beast::error_code error, std::size_t) { self->have_read(error); });
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
    const Asking asking = asking_of(request);
    host_ = asking.host;
    if (pass_->address().empty() && !pass_->move_to(asking.address))
      return refuse(http::status::too_many_requests, "There are too many connections of this address.");
    if (beast::websocket::is_upgrade(request)) return upgrade(std::move(request), asking);
    pass_->open();
    keeps_alive_ = request.keep_alive();
    is_head_ = request.method() == http::verb::head;
    version_ = request.version();
    const bool is_try = tries_a_code(text_of(request.target()));
    if (is_try && !shared_.gate.may_try(asking.address, now()))
      return refuse(http::status::too_many_requests, "Too many wrong codes came from this address; wait a minute.");
    const Request plain{std::string(request.method_string()),
                        std::string(request.target()),
                        request.body(),
                        host_,
                        asking.scheme,
                        text_of(request[http::field::accept_encoding]).find("gzip") != std::string_view::npos,
                        shared_.proxy.empty() && is_own_address(peer_)};
    shared_.pages->answer(plain, [self = shared_from_this(), is_try, address = asking.address](Response response) {
      if (is_try && response.status == 404) self->shared_.gate.note_failure(address, now());
      self->write(std::move(response));
    });
  }

  // What a proxy says counts where it is the one that was named.
  Asking asking_of(const http::request<http::string_body>& request) const {
    const Asking direct{peer_, plain_host(text_of(request[http::field::host])), shared_.tls ? "https" : "http"};
    if (shared_.proxy.empty() || peer_ != shared_.proxy) return direct;
    return asked_by(direct, {text_of(request["X-Forwarded-For"]), text_of(request["X-Forwarded-Host"]),
                             text_of(request["X-Forwarded-Proto"])});
  }

  void upgrade(http::request<http::string_body> request, const Asking& asking) {
    const std::string_view origin = text_of(request[http::field::origin]);
    if (request.target() != "/ws") return refuse(http::status::not_found, "Connections go to /ws.");
    // By which protocol a page has come is known where this server encrypts by itself, or the proxy says so. Else somebody may
    // have put a proxy before it that encrypts, and has not named it.
    const bool is_known = shared_.tls.has_value() || !shared_.proxy.empty();
    if (!origin.empty() && !is_own_origin(origin, asking.host, is_known ? asking.scheme : ""))
      return refuse(http::status::forbidden, "This page is not one of this server.");
    beast::get_lowest_layer(stream_).expires_never();
    begin_visit(std::move(stream_), shared_, {std::move(pass_), asking.address, !origin.empty()}, request);
  }

  void refuse(http::status status, const std::string& text) {
    keeps_alive_ = false;
    write({.status = static_cast<int>(status), .type = "text/plain; charset=utf-8", .body = text + "\n"});
  }

  void write(Response response) {
    response_.emplace();
    response_->version(version_);
    response_->result(static_cast<unsigned>(response.status));
    add_security(*response_, host_, response.inline_sources);
    for (const auto& [name, value] : response.fields) response_->set(name, value);
    response_->set(http::field::content_type, response.type);
    response_->keep_alive(keeps_alive_);
    const std::size_t length = response.body.size();
    if (!is_head_) response_->body() = std::move(response.body);
    response_->content_length(length);
    beast::get_lowest_layer(stream_).expires_after(kRequest + seconds(length / kSlowestTaker));
    const auto done = [self = shared_from_this()](beast::error_code error, std::size_t) {
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
  std::unique_ptr<Gate::Pass> pass_;
  std::string peer_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::string_body>> parser_;
  std::optional<http::response<http::string_body>> response_;
  std::optional<http::response_serializer<http::string_body>> serializer_;
  std::string host_;
  unsigned version_ = 11;
  bool keeps_alive_ = false, is_head_ = false;
};

std::string what_to_do(const beast::error_code& error, const ServerOptions& options) {
  if (error == asio::error::address_in_use) return "; another server may run there, choose another --port";
  if (error == asio::error::access_denied) return "; ports below 1024 are kept for the system, choose another --port";
  if (error == std::errc::address_not_available)
    return "; " + options.address + " is no address of this computer, choose another --bind";
  return "";
}

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
      // OpenSSL says of a file that is not there only that it went wrong.
      for (const std::string& file : {options.certificate, options.key})
        if (const auto text = read_file(file); !text) return text.error();
      shared_.tls->use_certificate_chain_file(options.certificate, error);
      if (error) return Error{ErrorCode::io, options.certificate, "is no certificate in PEM form: " + error.message()};
      shared_.tls->use_private_key_file(options.key, asio::ssl::context::pem, error);
      if (error) return Error{ErrorCode::io, options.key, "is no key of this certificate: " + error.message()};
    }
    if (!options.proxy.empty()) {
      shared_.proxy = network_of(asio::ip::make_address(options.proxy, error));
      if (error) return Error{ErrorCode::parse, "--behind-proxy", "`" + options.proxy + "` is no address"};
    }
    const Tcp::endpoint endpoint(address, options.port);
    acceptor_.open(endpoint.protocol(), error);
    if (!error) acceptor_.set_option(asio::socket_base::reuse_address(true), error);
    if (!error) acceptor_.bind(endpoint, error);
    if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
    if (error)
      return Error{ErrorCode::io, "port " + std::to_string(options.port),
                   "cannot be opened: " + error.message() + what_to_do(error, options)};
    if (!options.watched_folder.empty()) shared_.machine.emplace(options.watched_folder);
    shared_.pages.emplace(shared_.rooms, options.page_folder, [this] { return surroundings(); });
    return {};
  }

  std::uint16_t port() const override {
    beast::error_code ignored;
    return acceptor_.local_endpoint(ignored).port();
  }
  Rooms& rooms() override { return shared_.rooms; }
  Surroundings surroundings() const override {
    Surroundings around;
    if (shared_.machine) around.machine = shared_.machine->latest();
    around.reached = shared_.reach.counts();
    return around;
  }
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
      if (!error) take(std::move(socket));
      // Out of file handles, say: tried again a little later, so that the thread does not spin.
      if (!error) return accept();
      retry_.expires_after(milliseconds(100));
      retry_.async_wait([this](beast::error_code stopped) {
        if (!stopped) accept();
      });
    });
  }

  void take(Tcp::socket socket) {
    beast::error_code ignored;
    socket.set_option(Tcp::no_delay(true), ignored);
    const auto end = socket.remote_endpoint(ignored);
    if (ignored) return;
    const std::string peer = network_of(end.address());
    note_reach(socket, end.address(), peer);
    auto pass = shared_.gate.enter(peer, !shared_.proxy.empty() && peer == shared_.proxy);
    if (!pass) return;  // closed
    Stream::Lowest plain(std::move(socket));
    Stream stream = shared_.tls ? Stream(Stream::Encrypted(std::move(plain), *shared_.tls)) : Stream(std::move(plain));
    std::make_shared<Caller>(std::move(stream), shared_, std::move(pass), peer)->wait_for_turn();
  }

  // Of connections within this computer and of a proxy's nobody learns whether phones reach it.
  void note_reach(const Tcp::socket& socket, const asio::ip::address& from, const std::string& peer) {
    beast::error_code error;
    const std::string own = plain_address(socket.local_endpoint(error).address());
    if (!error && peer != shared_.proxy) shared_.reach.note(own, plain_address(from));
  }

  void look_after(double time) {
    static constexpr double kBetween = 0.2;  // [s]
    shared_.gate.turn(time);
    if (time - looked_ < kBetween) return;
    looked_ = time;
    for (Watched* one : std::set(*shared_.watched)) one->watch(time);
  }

  void turn() {
    timer_.expires_after(milliseconds(50));
    timer_.async_wait([this](beast::error_code error) {
      if (error || shared_.is_stopping) return;
      for (auto& [code, room] : shared_.rooms) room->turn();
      look_after(now());
      turn();
    });
  }

  asio::io_context context_{1};
  Shared shared_{context_};
  Tcp::acceptor acceptor_{context_};
  asio::steady_timer timer_{context_}, farewell_{context_}, retry_{context_};
  double looked_ = 0;
};

}  // namespace

Result<std::unique_ptr<Server>> Server::open(const ServerOptions& options) {
  auto server = std::make_unique<BeastServer>();
  if (auto begun = server->begin(options); !begun) return begun.error();
  return std::unique_ptr<Server>(std::move(server));
}

}  // namespace bl::serve
