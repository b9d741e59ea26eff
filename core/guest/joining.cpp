// A link by WebSocket, and what a guest needs besides it.
#include "core/guest/joining.h"

#include <atomic>
#include <cctype>

#include "core/room/secrets.h"
#include "core/serve/client.h"
#include "core/serve/room_address.h"

namespace bl::guest {

namespace {

class SocketLink final : public Link {
 public:
  SocketLink(const serve::RoomAddress& address, std::function<void()> wake)
      : client_(address, [this, wake = std::move(wake)] {
          has_news_ = true;
          wake();
        }) {}
  void send(std::string frame) override { client_.send(std::move(frame)); }
  bool has_news() const override { return has_news_; }
  std::vector<Heard> take() override {
    has_news_ = false;
    std::vector<Heard> heard;
    for (serve::Happening& happening : client_.take()) {
      if (auto* arrived = std::get_if<serve::Arrived>(&happening))
        heard.push_back({Heard::What::frame, std::move(arrived->frame), 0});
      else if (auto* closed = std::get_if<serve::Closed>(&happening))
        heard.push_back({Heard::What::closed, std::move(closed->why), closed->code});
      else heard.push_back({Heard::What::opened, {}, 0});
    }
    return heard;
  }

 private:
  std::atomic<bool> has_news_{false};
  serve::Client client_;  // last: its thread uses the above
};

}  // namespace

bool is_room_address(std::string_view text) {
  return text.starts_with("room://") || text.starts_with("http://") || text.starts_with("https://");
}

Result<std::string> room_named(std::string_view address) {
  const auto read = serve::room_address(address);
  if (!read) return read.error();
  return read->host_and_port() + "/" + read->code;
}

Result<std::unique_ptr<RoomGuest>> join_room(const Registry& registry, std::string_view address, JoinOptions options) {
  const auto read = serve::room_address(address);
  if (!read) return read.error();
  RoomGuestOptions how;
  how.code = read->code;
  how.invite = read->invite;
  how.token = std::move(options.token);
  how.name = std::move(options.name);
  how.page = (read->is_secure ? "https://" : "http://") + read->host_and_port() + "/" + read->code;
  how.new_run = [] { return room::hex_of(room::system_random_bytes(16)); };
  if (!options.outbox.empty()) {
    std::string name = read->host_and_port() + "_" + read->code;
    for (char& letter : name)
      if (std::isalnum(static_cast<unsigned char>(letter)) == 0) letter = '_';
    how.outbox = options.outbox + "/" + name;
  }
  how.self = host::self_test();
  how.threads = options.threads;
  how.keep_token = std::move(options.keep_token);
  // When the next attempt comes decides nothing but who is first.
  how.random = [] { return static_cast<unsigned char>(room::system_random_bytes(1)[0]) / 255.0; };
  how.connect = [where = *read](std::function<void()> wake) -> std::unique_ptr<Link> {
    return std::make_unique<SocketLink>(where, std::move(wake));
  };
  return std::make_unique<RoomGuest>(registry, std::move(how));
}

}  // namespace bl::guest
