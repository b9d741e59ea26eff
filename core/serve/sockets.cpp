// Guests by WebSocket: what they send slowly, too fast or too much, and what they do not take.
#include <utility>

#include <boost/beast/websocket.hpp>
#include <deque>

#include <nlohmann/json.hpp>

#include "core/serve/beast.h"
#include "core/wire/operations.h"

namespace bl::serve {

namespace {

namespace websocket = beast::websocket;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr std::size_t kMostHello = 4 << 10, kMostPageFrame = 64 << 10, kMostDesignerFrame = 1 << 20, kKeptBuffer = 2 << 10;
constexpr seconds kIdle{20};
// What is sent slower than this is not waited for: five seconds, and one more for each four kilobytes that have come. Who says
// nothing at all, not even that it is there, is gone.
constexpr double kMessage = 5, kSlowest = 4096, kSilence = 25;  // [s], [bytes/s], [s]
constexpr double kGoodbye = 0.5, kLastWords = 5;                // for the other side to close; to take what is on its way [s]
constexpr double kFlood = 30;                                   // too fast for so long is a flood [s]
// A page says ten things a second, and thirty in a burst; who sends more waits, because nothing more is read.
constexpr double kPageRate = 10, kPageBurst = 30, kDesignerRate = 60, kFollowerRate = 1000;

// One WebSocket.
class SocketGuest : public Guest, public Watched, public std::enable_shared_from_this<SocketGuest> {
 public:
  SocketGuest(Stream stream, Shared& shared, Visit visit)
      : socket_(std::move(stream)), timer_(shared.context), shared_(shared), watched_(shared.watched), visit_(std::move(visit)) {
    watched_->insert(this);
  }
  ~SocketGuest() override { watched_->erase(this); }

  void accept(const http::request<http::string_body>& request) {
    websocket::stream_base::timeout timeouts{};
    timeouts.handshake_timeout = kHandshake;
    timeouts.idle_timeout = kIdle;
    timeouts.keep_alive_pings = true;
    socket_.set_option(timeouts);
    socket_.control_callback([this](websocket::frame_type, beast::string_view) { heard_ = now(); });
    // A protocol is named only to who has asked for it (RFC 6455, 4.2.2).
    const bool asks = text_of(request[http::field::sec_websocket_protocol]).find("bl1") != std::string_view::npos;
    socket_.set_option(websocket::stream_base::decorator([asks](websocket::response_type& response) {
      add_security(response, "");
      if (asks) response.set(http::field::sec_websocket_protocol, "bl1");
    }));
    socket_.read_message_max(kMostHello);
    socket_.text(true);
    socket_.async_accept(request, [self = shared_from_this()](beast::error_code error) {
      if (error) return;
      self->opened_ = self->heard_ = now();
      self->read();
    });
  }

  void watch(double time) override {
    if (closing_ > 0) {
      if (time - closing_ > (has_said_goodbye_ ? kGoodbye : kLastWords)) cut();
    } else if (opened_ == 0) {
      return;
    } else if (!is_greeted_ && time - opened_ > kMessage) {
      close(CloseCode::no_hello, "no hello in five seconds");
    } else if (begun_ > 0 && time - begun_ > kMessage + static_cast<double>(buffer_.size()) / kSlowest) {
      close(CloseCode::bad_frame, "a message has come too slowly");
    } else if (!is_throttled_ && time - heard_ > kSilence) {
      cut();
    }
  }

  void send(std::shared_ptr<const std::string> frame) override {
    if (closing_ > 0) return;
    unsent_ += frame->size();
    queue_.push_back(std::move(frame));
    if (queue_.size() == 1) write();
  }

  // What is not on its way yet is not said any more: who takes nothing would never hear the goodbye.
  void close(CloseCode code, const std::string& why) override {
    if (closing_ > 0) return;
    closing_ = now();
    reason_ = websocket::close_reason(static_cast<websocket::close_code>(code), why.substr(0, 120));
    if (queue_.empty()) return say_goodbye();
    queue_.resize(1);
    unsent_ = queue_.front()->size();
  }

  std::size_t unsent() const override { return unsent_; }

 private:
  void read() {
    socket_.async_read_some(buffer_, 0,
                            [self = shared_from_this()](beast::error_code error, std::size_t) { self->have_read(error); });
  }

  void have_read(beast::error_code error) {
    if (error) return gone();
    if (closing_ > 0) {
      buffer_.consume(buffer_.size());
      if (!has_said_goodbye_) read();  // the goodbye comes after what is on its way
      return;
    }
    if (!socket_.is_message_done()) {
      if (begun_ == 0) begun_ = now();
      return read();
    }
    heard_ = now();
    begun_ = 0;
    const std::string text = beast::buffers_to_string(buffer_.data());
    buffer_.consume(buffer_.size());
    if (text.size() > kKeptBuffer) buffer_.shrink_to_fit();
    if (!socket_.got_text()) close(CloseCode::bad_frame, "frames are text");
    else if (room_ == nullptr) begin(text);
    else room_->hear(*this, text);
    if (has_said_goodbye_) return;  // that reads by itself
    read_in_time();
  }

  void begin(const std::string& text) {
    const auto frame = wire::read_frame(text);
    if (!frame) return close(CloseCode::bad_frame, frame.error().text());
    if ((*frame)["t"] != "hello") return close(CloseCode::no_hello, "the first frame is no hello");
    const auto hello = wire::read_message<wire::Hello>(*frame);
    if (!hello) return close(CloseCode::bad_frame, hello.error().text());
    const bool is_program = hello->kind == "desktop" || hello->kind == "follower";
    if (!visit_.has_origin && !is_program) return close(CloseCode::no_seat, "pages come from this server");
    if (!visit_.has_origin && hello->token.empty() && hello->invite.empty())
      return close(CloseCode::no_seat, "a window comes in by an invitation: copy the whole address, with what follows #");
    // Codes are short enough to be guessed. Tokens are not: whoever has one is never held up by what others tried, and learns
    // nothing about a code.
    const bool is_first = hello->token.empty();
    if (is_first && !shared_.gate.may_try(visit_.address, now()))
      return close(CloseCode::flood, "too many wrong codes came from this address; wait a minute");
    const auto room = shared_.rooms.find(hello->room);
    if (room == shared_.rooms.end()) {
      shared_.gate.note_failure(visit_.address, now());
      return close(CloseCode::no_seat, is_first ? "there is no room with this code" : "this token opens no seat");
    }
    room_ = room->second.get();
    is_greeted_ = true;
    socket_.read_message_max(is_program ? kMostDesignerFrame : kMostPageFrame);
    rate_ = hello->kind == "follower" ? kFollowerRate : is_program ? kDesignerRate : kPageRate;
    if (!room_->greet(shared_from_this(), *hello)) return;
    visit_.pass->open();
  }

  // What comes too fast is left in the network: whoever sends it waits, and nobody else does.
  void read_in_time() {
    const double time = now();
    tokens_ = std::min(kPageBurst * rate_ / kPageRate, tokens_ + (time - filled_) * rate_) - 1;
    filled_ = time;
    if (tokens_ >= 1) fast_since_ = time;
    if (tokens_ >= 0) return read();
    if (time - fast_since_ > kFlood) return close(CloseCode::flood, "too much was sent for half a minute");
    is_throttled_ = true;
    timer_.expires_after(milliseconds(static_cast<int>(-tokens_ / rate_ * 1000) + 1));
    timer_.async_wait([self = shared_from_this()](beast::error_code error) {
      self->is_throttled_ = false;
      self->heard_ = now();  // nobody has listened meanwhile
      if (!error) self->read();
    });
  }

  void write() {
    socket_.async_write(asio::buffer(*queue_.front()), [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (error) return self->gone();
      self->unsent_ -= self->queue_.front()->size();
      self->queue_.pop_front();
      if (!self->queue_.empty()) self->write();
      else if (self->closing_ > 0) self->say_goodbye();
    });
  }

  void say_goodbye() {
    if (std::exchange(has_said_goodbye_, true)) return;
    closing_ = now();
    timer_.cancel();
    socket_.async_close(reason_, [self = shared_from_this()](beast::error_code) { self->gone(); });
  }

  void cut() {
    timer_.cancel();
    beast::get_lowest_layer(socket_).close();
  }

  void gone() {
    if (closing_ == 0) closing_ = now();
    cut();
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
  std::shared_ptr<std::set<Watched*>> watched_;
  Visit visit_;
  bool is_greeted_ = false, is_throttled_ = false, has_said_goodbye_ = false;
  double tokens_ = kPageBurst, rate_ = kPageRate;
  // When that was [s], by now(); 0: not yet. `begun_`: of a message that has come in part.
  double filled_ = now(), fast_since_ = now(), opened_ = 0, heard_ = 0, begun_ = 0, closing_ = 0;
};

}  // namespace

void add_security(http::fields& fields, const std::string& host, const std::string& inline_sources) {
  const std::string socket = host.empty() ? "" : " ws://" + host + " wss://" + host;
  fields.set("Content-Security-Policy",
             "default-src 'none'; script-src 'self'" + inline_sources + "; style-src 'self'" + inline_sources +
                 "; img-src 'self' data: blob:; connect-src 'self'" + socket +
                 "; base-uri 'none'; form-action 'self'; frame-ancestors 'none'; require-trusted-types-for 'script'");
  fields.set("Referrer-Policy", "no-referrer");
  fields.set("X-Content-Type-Options", "nosniff");
  fields.set("Cross-Origin-Opener-Policy", "same-origin");
  fields.set("Permissions-Policy", "camera=(), microphone=(), geolocation=()");
}

void begin_visit(Stream stream, Shared& shared, Visit visit, const http::request<http::string_body>& request) {
  std::make_shared<SocketGuest>(std::move(stream), shared, std::move(visit))->accept(request);
}

}  // namespace bl::serve
