// Somebody who takes part in a rehearsal: hears what a page hears, and says what people say. Knows no network.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/define/json_text.h"

namespace bl::cli {

/// What was said of one kind by all bots, and what became of it.
struct RehearsalTally {
  std::int64_t said = 0;
  std::vector<double> answers;                  ///< how long each took [s]
  std::map<std::string, std::int64_t> refused;  ///< of these, by the reason
};
using RehearsalTallies = std::map<std::string, RehearsalTally>;

/// Something that everybody is shown, such as a comment.
struct RehearsalTold {
  double said = 0;  ///< when [s]
  bool is_stored = false;
};

class RehearsalBot {
 public:
  /// Between two things that a bot does [s]; a slider sends while it is dragged.
  static constexpr double kShortestPause = 1, kLongestPause = 5, kBetweenValues = 0.2;
  /// Without an answer for so long, everything is said again [s].
  static constexpr double kAnswerWithin = 4;
  /// A bot that hears nothing asks, as pages do [s].
  static constexpr double kBetweenPings = 5;

  /// `run` is random, and of this bot alone. What the bot says follows from `random`.
  RehearsalBot(std::string code, std::string invite, std::string run, Random random, RehearsalTallies& tallies);
  ~RehearsalBot();

  // Of the connection.
  /// The first frame of each connection.
  std::string hello() const;
  /// The connection has ended: until the next welcome nothing is said.
  void lose() { is_welcome_ = false; }
  void hear(const std::string& frame, double now);
  /// What goes out now. `is_over`: nothing new is begun.
  std::vector<std::string> say(double now, bool is_over);

  /// A facilitator's bot: begins a phase, gives these seats the role cards of the scene in turn, and opens the votes.
  void lead(std::set<std::int64_t> seats) { led_ = std::move(seats); }
  /// The facilitator's bot closes what it has opened.
  void close_votes(double now);

  bool is_welcome() const { return is_welcome_; }
  std::int64_t seat() const { return seat_; }
  const std::string& role() const { return role_; }
  std::size_t waiting() const { return waiting_.size(); }
  std::size_t bytes() const { return bytes_; }
  bool has_card() const;
  /// By its name: what this bot has said to everybody.
  const std::map<std::string, RehearsalTold>& told() const { return told_; }
  /// By its name: when it was first on this bot's screen [s]. What has left the screen since has no time.
  const std::map<std::string, double>& seen() const { return seen_; }
  /// How many of its operations were answered as two entries.
  std::int64_t doubled() const { return doubled_; }
  /// The longest time between two frames of the server, from the first welcome on [s].
  double longest_silence(double now) const;

 private:
  struct Said {
    std::string kind, frame, name;
    double at = 0;
  };
  struct Drag {
    std::int64_t gesture = 0;
    int values_left = 0;
    double due = 0;
  };
  void hear_answer(const Json& frame, bool is_refused, double now);
  void hear_view(const Json& frame, double now);
  void say_event(const std::string& kind, const std::string& event, Json arguments, double now, const std::string& name = "");
  /// `name`: of what everybody will be shown.
  void say_operation(const std::string& kind, Json message, double now, const std::string& name = "");
  void act(double now);
  void act_as_lead(double now);
  bool vote(double now);
  void begin_drag(double now);
  void go_on_with_drag(double now);
  void propose(double now);
  void comment(double now);
  void rate(double now);
  bool may(const std::string& activity) const;
  double value_of(const Json& control);
  const Json& view(const std::string& name) const;
  Json command_for(const Json& control);
  Json ballot_for(const Json& vote);

  std::string code_, invite_, run_, token_, role_;
  Random random_;
  RehearsalTallies* tallies_;
  std::set<std::int64_t> led_, given_;
  std::set<std::string> voted_, opened_;
  struct Shown;
  std::unique_ptr<Shown> shown_;                  // what a page would show, and what is being dragged
  std::map<std::int64_t, Said> waiting_;          // by number: what has no answer
  std::map<std::int64_t, std::int64_t> entries_;  // by number: the entry of what is stored
  std::map<std::string, RehearsalTold> told_;
  std::map<std::string, double> seen_;
  std::vector<std::string> out_;
  Drag drag_;
  bool is_welcome_ = false, has_begun_phase_ = false;
  std::int64_t seat_ = 0, last_id_ = 0, last_answered_ = 0, last_gesture_ = 0, names_ = 0, acts_ = 0, doubled_ = 0;
  std::size_t bytes_ = 0;
  double act_at_ = 0, again_at_ = 0, ping_at_ = 0, heard_at_ = -1, longest_silence_ = 0;
};

}  // namespace bl::cli
