// A scene that runs in a room of a server: shown at once, decided there, with the same ticks here where both programs are alike.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/guest/draft_work.h"
#include "core/guest/fold.h"
#include "core/guest/follower.h"
#include "core/guest/link.h"
#include "core/guest/outbox.h"
#include "core/guest/people.h"
#include "core/host/running.h"
#include "core/host/self_test.h"
#include "core/wire/messages.h"

namespace bl::guest {

struct RoomGuestOptions {
  std::string code = {};                      ///< of the room
  std::string invite = {};                    ///< key of an invitation, for the first visit
  std::string token = {};                     ///< of the seat, from an earlier visit
  std::function<std::string()> new_run = {};  ///< a random name for the operations of this window
  std::string outbox = {};   ///< stem of the files (Outbox) by which what has no answer outlives a crash; empty: none
  std::string name = {};     ///< of the person, where they want to give it
  std::string page = {};     ///< the address that phones open to join this room
  host::SelfTest self = {};  ///< what this program is
  int threads = 1;           ///< of the ticks
  host::Clock* clock = &host::real_clock();
  std::function<double()> random = {};  ///< 0 to 1, for the times of new attempts
  /// Begins an attempt; `wake` may be called on any thread when there is something to take.
  std::function<std::unique_ptr<Link>(std::function<void()> wake)> connect = {};
  std::function<void(const std::string& token)> keep_token = {};
};

/// An operation that the room has refused, in words for people.
struct Refused {
  std::string what;   ///< the step, such as "Set port · Library"
  std::string why;    ///< the reason, of the closed list
  std::string place;  ///< such as `nodes/library`; empty where it has none
  std::string text;
};

struct Standing {
  bool is_connected = false;  ///< the room has said welcome on the present connection
  bool has_scene = false;
  double lost_since = 0;    ///< on the clock of the options [s]; where it is not connected
  std::size_t waiting = 0;  ///< operations without an answer
  std::string end = {};     ///< why there will be no further attempt; empty where there will
  bool can_store = true;    ///< the room has not said that its disk takes nothing
  bool takes_ticks = true;  ///< this program computes the same as the server; else the server's values are shown
};

class RoomGuest final : public host::Running {
 public:
  static constexpr double kFirstRetry = 0.2, kRetryGrowth = 1.7, kLastRetry = 5, kRetryJitter = 0.4;  // [s], [s], part of it
  static constexpr double kBetweenPings = 5, kPongWithin = 4;                                         // [s]
  static constexpr double kBetweenPresences = 0.25, kBetweenPaces = 0.2, kBetweenValues = 1;          // [s]
  static constexpr double kBetweenResyncs = 1, kBetweenGaps = 0.5;                                    // [s]
  /// Of what waits for an answer so much is under way at once; a server takes 180 at once from a window, and sixty in a second.
  static constexpr std::size_t kMostUnanswered = 16;
  static constexpr double kMostAtOnce = 100, kSentInASecond = 50;  // operations, operations/s
  static inline const std::vector<std::string> kViews = {"room",      "votes",  "comments",
                                                         "proposals", "drafts", "draft_steps"};  // that are followed
  static constexpr double kWelcomeWithin = 10, kAnswerWithin = 4;                                // [s]

  RoomGuest(const Registry& registry, RoomGuestOptions options);
  ~RoomGuest() override;

  // As Running has them.
  const Scene& scene() const override { return own().shown(); }
  const std::vector<LogEntry>& log() const override { return log_; }
  const std::vector<host::HistoryStep>& history() const override { return history_.steps(); }
  std::int64_t last_step() const override { return 0; }
  std::int64_t new_gesture() override { return ++last_gesture_; }
  Result<void> submit(const std::vector<Command>& commands, std::int64_t gesture = 0, const std::string& label = "") override;
  Result<void> show(const std::vector<Command>& commands, std::int64_t gesture) override;
  Result<void> end_gesture(std::int64_t gesture) override;
  void abandon(std::int64_t gesture) override;
  Result<TakenBack> undo() override;
  Result<TakenBack> redo() override;
  Result<void> keep_up() override;
  bool has_waiting_values() const override { return !work_ && !fold_.waiting().empty(); }
  std::shared_ptr<const host::Moment> moment() const override;
  std::size_t subscribe_moments(Follower::Listener listener) override { return follower_.subscribe(std::move(listener)); }
  void unsubscribe_moments(std::size_t number) override { follower_.unsubscribe(number); }
  bool has_news() const override { return (link_ && link_->has_news()) || follower_.has_difference(); }
  std::string why_no_clock() const override;
  void play(bool is_playing) override;
  void set_rate(double ticks_per_second) override;
  void step(int ticks) override;
  bool can_rewind() const override { return why_no_clock().empty() && !entry_ticks_.empty(); }
  /// Takes back what everybody has done in the last ticks; the running state goes on.
  void rewind(std::int64_t ticks) override;
  void let_rest(bool) override {}
  void watch_times(bool is_watched) override { follower_.watch_times(is_watched); }
  std::shared_ptr<const State> coming_state() override;

  // Of the room.
  const std::string& code() const { return options_.code; }
  const std::string& page() const { return options_.page; }
  const People& people() const { return people_; }
  /// What the room shows of a view (`room`, `votes`, `comments`, `proposals`), by key; nothing until it has come.
  const std::map<std::string, JsonValue>& view(const std::string& name) const;
  /// How the room and its computer are; only facilitators are told, every two seconds.
  const std::optional<wire::HealthOut>& health() const { return health_; }
  /// Grows with each change of a view.
  std::uint64_t views_revision() const { return views_revision_; }
  std::int64_t seat() const { return seat_; }
  const std::string& role() const { return role_; }
  /// The author of what this guest says, in the log and in ballots.
  std::string author() const;
  Standing standing() const;
  /// An event of the room, such as asking for a pen; `arguments`: an object.
  void say_event(const std::string& event, const JsonValue& arguments);
  /// For facilitators: takes back the last gesture of that seat, or the named one of the log.
  void undo_of(std::int64_t seat, std::int64_t gesture = 0);
  /// The drafts that somebody looks at here: the server tries them, as many as it can, and tells their figures. The draft that
  /// the holder works in is one of them.
  void look_at(std::vector<std::string> drafts);
  /// The plan as this window has it, as the view `plan` of pages.
  std::map<std::string, JsonValue> plan() const;

  // Drafts. In a draft, scene() and moment() are those of the draft, what is submitted becomes a step of it, and undo() takes its
  // last step back. A gesture is one step, which is said at its end.
  /// Begins a draft, and works in it.
  Result<void> begin_draft(const std::string& title);
  /// Works in an open draft of this seat.
  Result<void> enter_draft(const std::string& id);
  /// Back to the scene of the room; the draft stays.
  void leave_draft();
  /// Shows the draft to whoever leads, and leaves it.
  void propose_draft(const std::string& id, const std::string& title, const std::string& why);
  void drop_draft(const std::string& id);
  /// The draft that the holder works in; none: they change the scene of the room.
  const DraftWork* draft() const { return work_.get(); }
  /// Where this person is; sent when it changes, four times a second at most.
  void set_whereabouts(Whereabouts where);
  /// Refusals and notices since the last call.
  std::vector<Refused> take_refusals() { return std::exchange(refusals_, {}); }
  std::vector<std::string> take_notices() { return std::exchange(notices_, {}); }
  /// When keep_up() has something to do though nobody has said anything [s].
  double next_turn() const;
  const Fold& fold() const { return fold_; }
  /// How many hashes of the room were the same here.
  std::int64_t agreed() const { return follower_.agreed(); }
  /// How often the window had another result or scene than the room, and has begun anew.
  std::int64_t differed() const { return differed_; }
  Follower& follower() { return follower_; }

 private:
  void connect();
  void lose(const std::string& why);
  void finish(const std::string& why) { end_ = why; }
  void hear(const Heard& heard);
  void hear_frame(const std::string& text);
  void hear_welcome(const wire::Welcome& welcome);
  void hear_snapshot(const wire::SnapshotOut& snapshot);
  void hear_entries(const wire::Ops& ops);
  void hear_tick(const wire::TickOut& mark);
  void hear_answer(std::int64_t id, bool is_stored = true);
  void hear_drafts(const wire::StateOut& view);
  static bool begins_draft(const Json& frame);
  bool waits_to_begin(const std::string& draft) const;
  void give_up_draft(const std::string& id);
  void hear_answer_of_draft(const Sent& sent, bool is_stored);
  void hear_refusal(const wire::Nack& nack);
  void hear_view(const wire::StateOut& view);
  void hear_say(const wire::Say& say);
  void find_page(const std::vector<std::string>& addresses);
  void say_hello();
  void say_wishes();
  void say_due(double now);
  /// A snapshot is asked for soon.
  void miss(const std::string& why, std::int64_t tick);
  void resync(const std::string& why, const Difference& difference);
  Result<void> say_values(std::int64_t gesture, std::vector<Command> commands);
  Result<void> end_gestures(std::int64_t but);
  void send_waiting();
  /// Nothing waits to be sent.
  bool has_sent_all() const;
  bool may_wish_pace() const;
  void say_pace(double now);
  template <class Message>
  Result<void> send_operation(Message message, const std::string& what, std::int64_t gesture = 0);
  /// The same where nobody waits for the result: an error is told.
  template <class Message>
  void say(Message message, const std::string& what);
  void open_outbox();
  /// What a window before this one has said is shown again.
  void show_kept();
  // The scene that the holder changes: that of the room, or of a draft.
  Fold& own() { return work_ ? work_->fold() : fold_; }
  const Fold& own() const { return work_ ? work_->fold() : fold_; }
  void work_in(std::string id, std::string title);
  Result<void> say_of_draft(wire::DraftOp::What what, const std::string& id, const std::string& words,
                            const std::string& title = "");
  /// The draft follows the room's scene and the steps that it tells.
  void follow_draft();
  void show_waiting_steps();
  /// Everything that is shown may be another.
  void tell_all_changed();
  void give_up_run();
  void send(std::string frame);
  void refresh();

  const Registry* registry_;
  RoomGuestOptions options_;
  Fold fold_;
  Follower follower_;
  host::History history_;
  People people_;
  std::vector<LogEntry> log_;
  std::deque<std::pair<std::int64_t, std::int64_t>> entry_ticks_;  // tick and number of the last entries of commands
  std::unique_ptr<Link> link_;
  // Of the present connection.
  bool is_open_ = false, is_welcome_ = false;
  double began_at_ = 0, ping_at_ = 0, answer_at_ = 0, keeps_up_at_ = 0, waits_for_pong_since_ = -1;
  std::int64_t sent_to_ = 0;           // the last operation that has gone out
  double may_send_ = 0, sent_at_ = 0;  // how many more may, and when that was known
  // Of the room.
  std::string role_, mode_, end_;
  std::int64_t seat_ = 0, epoch_ = 0;
  std::int64_t told_to_ = 0;  // the last entry that the log and the history have been told
  bool has_scene_ = false, is_stale_ = false, wants_resync_ = false, can_store_ = true;
  std::map<std::string, std::map<std::string, JsonValue>> views_;
  std::uint64_t views_revision_ = 0;
  std::optional<wire::HealthOut> health_;
  Difference asked_;
  std::string asked_why_;
  std::int64_t differed_ = 0;
  double resync_at_ = -1e9, values_at_ = -1e9;
  double lost_since_ = 0, retry_at_ = 0;
  int attempts_ = 0;
  // What this guest says.
  Outbox outbox_;
  std::int64_t last_gesture_ = 0, acked_seq_ = 0;  // the entry after which the last operation was answered
  std::int64_t gap_before_ = 0;                    // the operation that the room has missed last
  double gap_at_ = -1e9;
  std::vector<std::string> looked_at_;
  struct PaceWish {
    std::optional<bool> is_paused;
    std::optional<double> rate;
    bool is_nothing() const { return !is_paused && !rate; }
  };
  PaceWish wished_pace_;
  double pace_at_ = -1e9;
  Whereabouts where_;
  std::string where_text_;
  bool is_where_sent_ = true;
  std::int64_t where_number_ = 0;
  double where_at_ = -1e9;
  std::vector<Refused> refusals_;
  std::vector<std::string> notices_;
  double draft_turn_ = 0;
  std::map<std::string, std::unique_ptr<DraftWork>>
      parked_;                                    // drafts that were left: what was said in them may have no answer yet
  std::vector<std::unique_ptr<DraftWork>> left_;  // that are given up; their scenes can be read until keep_up()
  std::unique_ptr<DraftWork> work_;               // last: its ticks wake those of the room
};

}  // namespace bl::guest
