// The bytes of one connection, plain or encrypted, as one type: Boost.Beast's templates over it are compiled once, not twice.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <variant>

#include <boost/asio/buffer.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl.hpp>
#include <boost/beast/core/role.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/ssl/ssl_stream.hpp>

namespace bl::serve {

using Tcp = boost::asio::ip::tcp;

/// What is called once, when something that was begun on a stream is over. Copies of handlers are never made: they may hold what
/// cannot be copied.
template <class... Arguments>
class Completion {
 public:
  template <class Handler>
  requires(!std::is_same_v<std::decay_t<Handler>, Completion>) explicit Completion(Handler&& handler)
      : held_(std::make_unique<Held<std::decay_t<Handler>>>(std::forward<Handler>(handler))) {}
  // Nothing of this is held while the handler runs: it may begin the next operation, and end what holds this one.
  void operator()(Arguments... arguments) { std::exchange(held_, nullptr)->call(arguments...); }

 private:
  struct Base {
    virtual ~Base() = default;
    virtual void call(Arguments... arguments) = 0;
  };
  template <class Handler>
  struct Held : Base {
    explicit Held(Handler the_handler) : handler(std::move(the_handler)) {}
    void call(Arguments... arguments) override { handler(arguments...); }
    Handler handler;
  };
  std::unique_ptr<Base> held_;
};

class Stream {
 public:
  using Error = boost::beast::error_code;
  using Lowest = boost::beast::tcp_stream;
  using Encrypted = boost::beast::ssl_stream<Lowest>;
  using executor_type = Lowest::executor_type;
  using Moved = Completion<Error, std::size_t>;  // bytes
  using Done = Completion<Error>;

  explicit Stream(Lowest plain) : stream_(std::move(plain)) {}
  explicit Stream(Encrypted encrypted) : stream_(std::move(encrypted)) {}

  /// Null: plain.
  Encrypted* encrypted() { return std::get_if<Encrypted>(&stream_); }
  /// Both ends say who they are and choose their keys; of a plain stream it is over at once, within the call.
  void shake_hands(boost::asio::ssl::stream_base::handshake_type type, std::function<void(Error)> done);

  // What Boost.Beast asks of a stream, by its names.
  Lowest& next_layer();
  const Lowest& next_layer() const;
  executor_type get_executor() { return next_layer().get_executor(); }
  template <class Buffers, class Handler>
  void async_read_some(const Buffers& buffers, Handler&& handler) {
    read_some(gather<boost::asio::mutable_buffer>(buffers), Moved(std::forward<Handler>(handler)));
  }
  template <class Buffers, class Handler>
  void async_write_some(const Buffers& buffers, Handler&& handler) {
    write_some(gather<boost::asio::const_buffer>(buffers), Moved(std::forward<Handler>(handler)));
  }
  template <class Handler>
  friend void async_teardown(boost::beast::role_type role, Stream& stream, Handler&& handler) {
    stream.tear_down(role, Done(std::forward<Handler>(handler)));
  }

 private:
  // Some of the pieces of memory that somebody has; who moves *some* bytes may leave the others for the next time.
  template <class Buffer>
  struct Some {
    using value_type = Buffer;
    using const_iterator = const Buffer*;
    const_iterator begin() const { return buffers.data(); }
    const_iterator end() const { return buffers.data() + count; }
    std::array<Buffer, 8> buffers;
    std::size_t count = 0;
  };
  template <class Buffer, class Buffers>
  static Some<Buffer> gather(const Buffers& buffers) {
    Some<Buffer> some;
    const auto end = boost::asio::buffer_sequence_end(buffers);
    for (auto at = boost::asio::buffer_sequence_begin(buffers); at != end && some.count < some.buffers.size(); ++at)
      if (const Buffer buffer = *at; buffer.size() > 0) some.buffers[some.count++] = buffer;
    return some;
  }
  void read_some(const Some<boost::asio::mutable_buffer>& buffers, Moved moved);
  void write_some(const Some<boost::asio::const_buffer>& buffers, Moved moved);
  void tear_down(boost::beast::role_type role, Done done);

  std::variant<Lowest, Encrypted> stream_;
};

}  // namespace bl::serve
