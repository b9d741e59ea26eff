// A room that runs: its session ticks, what people say is stored, and they are told once it is.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/host/device_door.h"
#include "core/host/live_session.h"
#include "core/journal/writer.h"
#include "core/room/room.h"
#include "core/serve/errands.h"
#include "core/serve/followers.h"
#include "core/serve/guest.h"
#include "core/serve/machine.h"
#include "core/serve/room_windows.h"
#include "core/serve/trial_runner.h"
#include "core/session/session.h"
#include "core/wire/messages.h"
#include "core/wire/past_view.h"
#include "core/wire/views.h"

namespace bl::serve {

class RoomHost;

struct RoomHostOptions {
  room::Allowances allowances = {};
  room::RandomBytes random = room::system_random_bytes;
  host::Clock* clock = &host::real_clock();
  std::optional<live::LiveOptions> live = {};                ///< how sensors and actuators are connected; none: they are not
  std::function<std::int64_t()> wall_time;                   ///< [ms since 1970]
  std::function<void(std::function<void()>)> on_own_thread;  ///< runs a task on the thread that uses the host; from any thread
  std::vector<std::string> addresses = {};                   ///< where pages find this server, such as `http://192.168.1.5:8080`
  /// The keys of invitations, and that of a second laptop, were made anew, and this is stored.
  std::function<void(const RoomHost&)> keys_renewed = {};
  std::function<Surroundings()> surroundings = {};  ///< on the thread of the host; none: nothing is known of them
  bool takes_over = false;  ///< another laptop had the room, and may have had more of it: its windows begin anew
};

/// A file in the format of another program.
struct ExportWish {
  std::string format;
  std::vector<std::string> options;  ///< each `name=value`
  std::string page_folder;           ///< where the built page is that some formats are made of; empty where there is none
};

/// All of it belongs to one thread, but for the ticks and the disk, which have threads of their own.
class RoomHost {
 public:
  /// Opens the session file: a new one with this scene, or one that is there, which is continued where it was.
  static Result<std::unique_ptr<RoomHost>> open(const std::string& journal_path, const std::string& code,
                                                const std::string& scene_path, RoomHostOptions options);
  ~RoomHost();
  RoomHost(const RoomHost&) = delete;
  RoomHost& operator=(const RoomHost&) = delete;

  const std::string& code() const { return code_; }
  const std::string& title() const { return title_; }
  /// By role: keys that give a seat of that role. They stay until the facilitator renews them, also in a server that is started
  /// again.
  const std::map<std::string, std::string>& invites() const { return invites_; }
  /// The key by which a second laptop follows the room. A facilitator's token does so, too.
  const std::string& follow_key() const { return follow_key_; }

  // Connections.
  /// The first message of a guest. False where the guest is sent away.
  bool greet(const std::shared_ptr<Guest>& guest, const wire::Hello& hello);
  /// Any later frame.
  void hear(Guest& guest, std::string_view frame);
  void leave(Guest& guest);
  /// To be called some ten times a second: sends what has changed, and lets time pass.
  void turn();
  /// Says goodbye, stores what there is, and stops.
  void close();

  // For pages without scripts, which have no connection.
  /// A seat by the code of the room; its token, or why there is none.
  std::variant<room::Admission, room::Refusal> admit_by_code();
  std::int64_t seat_of_token(std::string_view token) const { return room_->seat_of_token(token); }
  /// Says something for a seat, and calls back once it is stored.
  void say_for(std::int64_t seat, room::OperationKind kind, const JsonValue& content,
               std::function<void(const room::Answer&)> done);
  /// Calls back once all that was said until now is stored.
  void when_stored(std::function<void()> done);
  wire::View view(std::string_view name, std::int64_t seat);

  bool leads(std::int64_t seat) const;
  // One file at a time: whoever asks meanwhile is told so at once.
  /// One file of the minutes of all that is stored by now, such as `minutes.html`; for those who may. `zone`: of its times, so
  /// far ahead of UTC [min]. `is_shared`: for one who only took part, without who gave which ballot; it waits for its turn.
  void make_minutes(const std::string& file, int zone, bool is_shared, Errands::Done done);
  /// Who leads gets all files; the page is for all seats of a room that was closed so, but for those that were sent out, or never
  /// let in.
  bool may_read_minutes(std::int64_t seat, const std::string& file) const;
  /// The plan as it is now, once it is stored; for those who may.
  void make_export(const ExportWish& wish, Errands::Done done);
  bool may_export(std::int64_t seat) const;

  struct Health {
    std::size_t seats = 0, guests = 0, followers = 0;
    std::int64_t tick = 0, seq = 0;
    std::string hash, problem;
    double disk_seconds = 0, tick_seconds = 0;
    std::int64_t waiting = 0;  ///< writes that the disk has not done yet
  };
  Health health() const;

 private:
  struct Visitor {
    std::shared_ptr<Guest> guest;
    std::int64_t seat = 0;
    std::string run, kind;
    std::set<std::string> wanted, looks_at = {};                          // views and drafts
    std::map<std::string, std::shared_ptr<const wire::View>> shown = {};  // by view: what was sent last
    bool is_window = false, is_ticking = false;  // a window of this program; its self-test gives what ours does
    bool is_following = false;                   // it has a scene, and gets what comes
    bool wants_snapshot = false;
    std::int64_t has = 0;           // the last entry that it has said it has, or was sent
    double snapshot_at = -1;        // when it got the last one [s]
    bool is_welcome = false;        // nothing is shown before: pages take the first of each view after it for the whole
    std::size_t welcomed_with = 0;  // the scene or the entries that it missed may be more than what else may wait [bytes]
  };
  /// Something to be told once the record that it stands in is stored.
  using Telling = std::function<void()>;
  struct Published {
    std::int64_t seq = 0, tick = 0;
    std::int64_t commit = 0;  ///< the last one that was begun when the views were made
    std::map<std::string, std::shared_ptr<const wire::View>> shared;
    std::map<std::int64_t, std::map<std::string, std::shared_ptr<const wire::View>>> by_seat;
  };
  /// What leads from one view to the next, for all who were shown the same one before; no frame where nothing differs.
  struct Step {
    std::shared_ptr<const wire::View> before, now;  ///< held, so that no other view gets their addresses
    std::shared_ptr<const std::string> frame;
  };

  RoomHost(std::string code, RoomHostOptions options) : code_(std::move(code)), options_(std::move(options)) {}
  Result<void> begin(const journal::Loaded& loaded);
  Result<SavedState> state_after(const journal::Loaded& loaded, const Scene& beginning);
  Result<void> follow_return(Session& session, const LogEntry& entry);
  void make_invites(const std::vector<room::TokenRecord>& tokens);
  std::map<std::string, std::string> invites_after(std::int64_t renewals) const;
  bool was_invite(std::string_view invite) const;
  void follow_renewals();
  void hear_follower(Guest& guest, std::string_view frame);
  std::vector<std::string> addresses() const;
  bool greet_follower(const std::shared_ptr<Guest>& guest, const wire::Hello& hello);
  void submit(Visitor& visitor, const room::Operation& operation);
  void say(const std::function<void(room::Now now)>& words);
  room::Answer ask(std::int64_t seat, const room::Operation& operation);
  static Result<std::shared_ptr<const State>> state_of(const journal::Snapshot& snapshot);
  std::optional<room::KeptState> kept_state(const std::string& scenario);
  void store_scenarios();
  /// Hands to the disk what has been said, and what is to be told after it.
  void flush();
  void stored(std::int64_t commit, std::int64_t seq, std::vector<Telling> tellings,
              std::vector<std::shared_ptr<const std::string>> entries, const Result<void>& result);
  void tell(std::int64_t seq, const std::vector<Telling>& tellings,
            const std::vector<std::shared_ptr<const std::string>>& entries);
  void recover();
  void follow_pace();
  void try_drafts();
  void follow_devices();
  void serve_devices();
  void bring_readings();
  /// Tells windows of a new tick, and shows it to everybody else where the last views are old enough.
  void show_tick();
  void publish_after(double seconds);
  void publish();
  void hold_shapes(Published& made);
  /// Keeps the plan that was shown when something was decided, as far as all of them are small enough for a phone. Without one
  /// nothing is kept: what was decided is older than this run.
  void keep_past(const State* shown);
  void show();
  void show(Visitor& visitor);
  bool has_events_since(std::int64_t seq) const;
  /// The view that is shown at present; none where nobody has wanted it.
  std::shared_ptr<const wire::View> shown_to(std::int64_t seat, const std::string& name) const;
  std::shared_ptr<const std::string> step(const std::string& name, const std::shared_ptr<const wire::View>& before,
                                          const std::shared_ptr<const wire::View>& now);
  void store_hash();
  void take_last_tick();
  void keep_records();
  void welcome(Visitor& visitor, const std::string& token, std::int64_t have, std::int64_t tick);
  // Windows.
  static bool ticks_alike(const wire::Hello& hello);
  /// For whoever reads entries and computes no ticks: the scene before the first entry, or those that are missing.
  void begin_reader(Visitor& visitor, std::int64_t have);
  /// Are the entries behind `seq` known, and few enough to be sent?
  bool can_send_behind(std::int64_t seq) const;
  void send_entries(Visitor& visitor, std::int64_t after);
  void begin_window(Visitor& visitor, std::int64_t have, std::int64_t tick);
  void follow_from(Visitor& visitor, std::int64_t seq);
  void send_snapshots();
  void hand_out_snapshot();
  void begin_windows_anew();
  void watch_ticks();
  void tell_ticks();
  void note_tick();
  /// Those that somebody has asked for in the entries after this one.
  void take_steps(std::int64_t since);
  // Health (room_health.cpp).
  wire::HealthOut health_message() const;
  std::map<std::string, std::size_t> reached_addresses(const Surroundings& around) const;
  void tell_health();
  /// False where the message has a wrong form.
  bool hear_window(Visitor& visitor, const std::string& t, const Json& frame, std::size_t size);
  void forget_presence(std::int64_t seat);
  void tell_presences();
  wire::ViewSources sources(const State& state) const {
    return {state, *room_, code_, title_, &trials_.shown(), &invites_, &past_};
  }

  std::string code_, title_;
  RoomHostOptions options_;
  std::unique_ptr<host::LiveSession> session_;
  std::unique_ptr<room::Room> room_;
  std::unique_ptr<journal::Writer> writer_;
  std::unique_ptr<Followers> followers_;
  std::unique_ptr<Errands> errands_;
  std::string beginning_;  // the scene file before the first entry
  /// Grows where the room begins anew on another laptop, and with each return to a scenario: never the same one twice.
  std::int64_t epoch() const { return (epoch_ - 1) * kMostReturns + room_->state().epoch; }
  static constexpr std::int64_t kMostReturns = 1000000;

  std::int64_t base_ = 0, epoch_ = 1;
  std::string invite_secret_;                   // what all keys are made from
  std::int64_t renewals_ = 0;                   // those that `invites_` knows
  std::map<std::string, std::string> invites_;  // by role
  std::string follow_key_;
  std::map<Guest*, Visitor> visitors_;
  std::vector<Telling> tellings_;  // of what has been said since the last flush
  std::int64_t stored_seq_ = 0;
  int commits_under_way_ = 0;
  std::int64_t commits_begun_ = 0, commits_told_ = 0;  // numbers; not all that is stored is an entry with a number
  std::string problem_;                                // why nothing can be stored
  double problem_since_ = 0, last_views_ = 0, last_snapshot_ = 0, last_health_ = -1e9;
  std::optional<double> snapshot_stored_;  // when, of this run of the program [s]
  std::string journal_path_;
  std::int64_t snapshot_seq_ = 0, last_hash_tick_ = -1;
  bool is_changed_ = true;                    // since the last views
  std::shared_ptr<const host::Moment> seen_;  // the moment of the last views
  std::optional<Published> next_, now_;       // views that wait for the disk, and those that are shown
  std::map<std::pair<const wire::View*, const wire::View*>, Step> steps_;  // to the views that are shown
  wire::PastPlans past_;
  std::shared_ptr<const wire::View> past_view_ = std::make_shared<const wire::View>();  // made once for all
  std::int64_t past_seq_ = 0;     // decisions up to this entry have been looked at
  double shapes_after_ = -1e9;    // before then no newer shapes are sent: whoever got the largest frame is still taking it [s]
  bool are_shapes_held_ = false;  // those of the last views may be older than their state
  std::map<std::int64_t, std::int64_t> plain_operations_;  // by seat
  TrialRunner trials_;
  std::unique_ptr<host::DeviceDoor> devices_;
  std::int64_t brought_ = -1;   // the tick for which readings were brought last
  std::string device_trouble_;  // the last reading that was refused
  struct Unstored {
    std::int64_t seq = 0;
    Scene scene;
    std::shared_ptr<const State> state;
  };
  std::map<std::string, std::shared_ptr<const State>> kept_;  // by scenario: its running state
  std::map<std::string, Unstored> unstored_;                  // by scenario: those that the file does not have yet
  std::map<std::string, journal::Snapshot> stored_;           // by scenario: those of the file, when it was opened
  Windows windows_;
  bool is_packing_ = false;  // a snapshot is being made
  std::shared_ptr<bool> is_alive_ = std::make_shared<bool>(true);
};

}  // namespace bl::serve
