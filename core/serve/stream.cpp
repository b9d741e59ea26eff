// What a connection does where plain and encrypted ones differ.
#include "core/serve/stream.h"

#include <boost/beast/core.hpp>
#include <boost/beast/ssl.hpp>
#include <boost/beast/websocket/ssl.hpp>
#include <boost/beast/websocket/teardown.hpp>

namespace bl::serve {

Stream::Lowest& Stream::next_layer() {
  if (Encrypted* const one = encrypted()) return one->next_layer();
  return std::get<Lowest>(stream_);
}

const Stream::Lowest& Stream::next_layer() const {
  if (const auto* one = std::get_if<Encrypted>(&stream_)) return one->next_layer();
  return std::get<Lowest>(stream_);
}

void Stream::shake_hands(boost::asio::ssl::stream_base::handshake_type type, std::function<void(Error)> done) {
  if (Encrypted* const one = encrypted()) one->async_handshake(type, std::move(done));
  else done({});
}

void Stream::read_some(const Some<boost::asio::mutable_buffer>& buffers, Moved moved) {
  std::visit([&](auto& one) { one.async_read_some(buffers, std::move(moved)); }, stream_);
}

void Stream::write_some(const Some<boost::asio::const_buffer>& buffers, Moved moved) {
  std::visit([&](auto& one) { one.async_write_some(buffers, std::move(moved)); }, stream_);
}

void Stream::tear_down(boost::beast::role_type role, Done done) {
  std::visit(
      [&](auto& one) {
        using boost::beast::websocket::async_teardown;
        async_teardown(role, one, std::move(done));
      },
      stream_);
}

}  // namespace bl::serve
