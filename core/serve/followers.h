// The laptops that follow a room: each gets the session file, and then each change of it.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/host/clock.h"
#include "core/journal/writer.h"
#include "core/serve/guest.h"

namespace bl::serve {

/// Belongs to the thread of the room. `on_own_thread` runs a task there, from any thread.
class Followers {
 public:
  using OnOwnThread = std::function<void(std::function<void()>)>;
  Followers(journal::Writer& writer, OnOwnThread on_own_thread, host::Clock& clock);
  ~Followers();
  Followers(const Followers&) = delete;
  Followers& operator=(const Followers&) = delete;

  /// `is_by_key`: it came by the key of the room, and not by the token of a seat.
  void add(const std::shared_ptr<Guest>& guest, bool is_by_key);
  /// Those that came by the key of the room, because it is no longer valid.
  void send_away_by_key(const std::string& why);
  /// False where this guest is no follower.
  bool hear(Guest& guest, std::string_view frame);
  bool leave(Guest& guest);
  void close();
  /// Sends the next parts, and waits for nobody any longer than it should. Called often.
  void turn();

  /// Tells once all that was stored until now is stored by each follower that is to be waited for; at once where there is none.
  /// In the order of the calls.
  void when_kept(std::function<void()> tell);
  std::size_t count() const { return followers_.size(); }
  /// Where those who have followed would serve the room. A page needs them when nobody can be asked any more, so they stay.
  const std::vector<std::string>& addresses() const { return addresses_; }
  /// Those that answers wait for.
  std::size_t safe_count() const;
  /// So long an answer waits for a follower that says nothing; afterwards the room goes on without it [s].
  static constexpr double kPatience = 5;

 private:
  struct Follower {
    std::shared_ptr<Guest> guest;
    bool is_by_key = false, is_safe = false, is_asked = false;
    std::string packed = {}, digest = {};  // the copy that is on its way
    std::int64_t size = 0, copied = 0;     // `copied`: the last change that is in it
    std::size_t sent = 0;                  // of `packed`
    bool has_all = false;
    std::int64_t kept = -1;
    std::deque<std::shared_ptr<const std::string>> waiting = {};
    std::size_t waiting_bytes = 0;
    bool is_waited_for() const { return is_safe && kept >= 0; }
  };
  struct Held {
    std::int64_t n;
    double since;
    std::function<void()> tell;
  };
  bool note_address(const std::string& address);
  void ask_for_copy(const std::shared_ptr<Guest>& guest);
  void take_copy(Guest& guest, const Result<journal::Packed>& packed);
  void changed(const Result<std::string>& changes);
  void send_copy(Follower& follower);
  void release();

  journal::Writer* writer_;
  OnOwnThread on_own_thread_;
  host::Clock* clock_;
  std::map<Guest*, Follower> followers_;
  std::deque<Held> held_;
  std::vector<std::string> addresses_;
  std::int64_t last_ = 0;  // number of the last change
  std::shared_ptr<bool> is_alive_ = std::make_shared<bool>(true);
};

}  // namespace bl::serve
