// What a bot does follows from what it is shown: controls of its card, open votes, comments of others.
#include "ui/cli/rehearsal_bot.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "core/wire/operations.h"

namespace bl::cli {

namespace {

constexpr int kValuesOfDrag = 6;
constexpr std::int64_t kKinds = 4;  // comments, ratings, proposals, moves
constexpr double kPartOfComments = 0.15, kPartOfRatings = 0.15,
                 kPartOfProposals = 0.1;  // of what is no ballot; the rest are moves
// What people say in a rehearsal; the longest is as long as people write on a phone.
constexpr const char* kComments[] = {
    "Rehearsal: more trees, please.", "Rehearsal: too high for this street.", "Rehearsal: this is good as it is.",
    "Rehearsal: the way to the school is long. Could the crossing be nearer, and could the café move to the corner?"};

std::string text_of(const Json& json, const char* key) {
  return json.is_object() && json.contains(key) && json[key].is_string() ? json[key].get<std::string>() : "";
}

bool flag_of(const Json& json, const char* key) {
  return json.is_object() && json.contains(key) && json[key].is_boolean() && json[key].get<bool>();
}

double number_of(const Json& json, const char* key, double otherwise) {
  return json.is_object() && json.contains(key) && json[key].is_number() ? json[key].get<double>() : otherwise;
}

}  // namespace

// By name; each as one object, as pages have them.
struct RehearsalBot::Shown {
  std::map<std::string, Json> views;
  Json dragged;
};

RehearsalBot::RehearsalBot(std::string code, std::string invite, std::string run, Random random, RehearsalTallies& tallies)
    : code_(std::move(code)),
      invite_(std::move(invite)),
      run_(std::move(run)),
      random_(random),
      tallies_(&tallies),
      shown_(std::make_unique<Shown>()) {}
RehearsalBot::~RehearsalBot() = default;

// --- The connection -------------------------------------------------------------------------------------------------

std::string RehearsalBot::hello() const {
  Json hello = {{"t", "hello"},
                {"room", code_},
                {"run", run_},
                {"kind", "page"},
                {"lang", "en"},
                {"unacked", last_answered_},
                {"views", {"room", "plan", "figures", "card", "votes", "comments", "proposals"}}};
  if (!token_.empty()) hello["token"] = token_;
  else if (!invite_.empty()) hello["invite"] = invite_;
  return write_json_line(hello);
}

void RehearsalBot::hear(const std::string& text, double now) {
  bytes_ += text.size();
  if (heard_at_ >= 0) longest_silence_ = std::max(longest_silence_, now - heard_at_);
  heard_at_ = now;
  const auto frame = wire::read_frame(text);
  if (!frame) return;
  const std::string t = text_of(*frame, "t");
  if (t == "ack" || t == "nack") return hear_answer(*frame, t == "nack", now);
  if (t == "state") return hear_view(*frame, now);
  if (t != "welcome") return;
  const Json& you = (*frame)["you"];
  seat_ = static_cast<std::int64_t>(number_of(you, "seat", 0));
  role_ = text_of(you, "role");
  if (const std::string token = text_of(*frame, "token"); !token.empty()) token_ = token;
  is_welcome_ = true;
  shown_->views.clear();
  // Not all at once: people come one after the other.
  act_at_ = now + random_.uniform(0, kShortestPause);
  again_at_ = now + kAnswerWithin;
  ping_at_ = now + kBetweenPings;
  for (const auto& [id, said] : waiting_) out_.push_back(said.frame);
}

// `gap`, `storage` and `draining` decide nothing: what was said waits, and is said again.
void RehearsalBot::hear_answer(const Json& frame, bool is_refused, double now) {
  const auto id = static_cast<std::int64_t>(number_of(frame, "id", 0));
  const auto entry = static_cast<std::int64_t>(number_of(frame, "s", 0));
  const auto said = waiting_.find(id);
  if (said == waiting_.end()) {
    // The same number again gets the same answer.
    const auto known = entries_.find(id);
    if (!is_refused && known != entries_.end() && known->second != entry) ++doubled_;
    return;
  }
  const std::string why = is_refused ? text_of(frame, "why") : "";
  if (why == "gap" || why == "storage" || why == "draining") {
    again_at_ = std::min(again_at_, now + 1);
    return;
  }
  RehearsalTally& tally = (*tallies_)[said->second.kind];
  tally.answers.push_back(now - said->second.at);
  if (is_refused) ++tally.refused[why];
  else entries_[id] = entry;
  if (const auto told = told_.find(said->second.name); told != told_.end()) told->second.is_stored = !is_refused;
  last_answered_ = std::max(last_answered_, id);
  waiting_.erase(said);
}

void RehearsalBot::hear_view(const Json& frame, double now) {
  const std::string name = text_of(frame, "view");
  const bool is_for_all = name == "comments" || name == "proposals";
  Json& view = shown_->views[name];
  if (!view.is_object()) view = Json::object();
  if (frame.contains("set") && frame["set"].is_object())
    for (const auto& [key, content] : frame["set"].items()) {
      view[key] = content;
      if (is_for_all) seen_.emplace(key, now);
    }
  if (frame.contains("drop") && frame["drop"].is_array())
    for (const Json& key : frame["drop"])
      if (key.is_string()) {
        view.erase(key.get<std::string>());
        if (is_for_all) seen_.erase(key.get<std::string>());
      }
}

double RehearsalBot::longest_silence(double now) const { return heard_at_ < 0 ? 0 : std::max(longest_silence_, now - heard_at_); }

// --- Saying ---------------------------------------------------------------------------------------------------------

void RehearsalBot::say_operation(const std::string& kind, Json message, double now, const std::string& name) {
  message["id"] = ++last_id_;
  if (waiting_.empty()) again_at_ = now + kAnswerWithin;
  std::string frame = write_json_line(message);
  ++(*tallies_)[kind].said;
  out_.push_back(frame);
  waiting_[last_id_] = {kind, std::move(frame), name, now};
  if (!name.empty()) told_[name] = {now, false};
}

void RehearsalBot::say_event(const std::string& kind, const std::string& event, Json arguments, double now,
                             const std::string& name) {
  say_operation(kind, {{"t", "room"}, {"e", {{"event", event}, {"arguments", std::move(arguments)}}}}, now, name);
}

std::vector<std::string> RehearsalBot::say(double now, bool is_over) {
  if (!is_welcome_) {
    out_.clear();
    return {};
  }
  if (now >= ping_at_) {
    ping_at_ = now + kBetweenPings;
    out_.push_back(R"({"t":"ping","n":1})");
  }
  if (!waiting_.empty() && now >= again_at_) {
    again_at_ = now + kAnswerWithin;
    for (const auto& [id, said] : waiting_) out_.push_back(said.frame);
  }
  if (!is_over && !led_.empty()) act_as_lead(now);
  else if (!is_over && role_ != "facilitator") {
    if (drag_.values_left > 0) go_on_with_drag(now);
    if (drag_.values_left == 0 && now >= act_at_) {
      act(now);
      act_at_ = now + random_.uniform(kShortestPause, kLongestPause);
    }
  }
  return std::exchange(out_, {});
}

// --- What a page shows ----------------------------------------------------------------------------------------------

const Json& RehearsalBot::view(const std::string& name) const {
  static const Json kNothing = Json::object();
  const auto found = shown_->views.find(name);
  return found == shown_->views.end() ? kNothing : found->second;
}

bool RehearsalBot::has_card() const { return !view("card").empty(); }

bool RehearsalBot::may(const std::string& activity) const {
  const Json& room = view("room");
  if (!room.contains("phase") || !room["phase"].contains("activities")) return false;
  const Json& activities = room["phase"]["activities"];
  return std::find(activities.begin(), activities.end(), activity) != activities.end();
}

// A step of the control's range, as a slider has it.
double RehearsalBot::value_of(const Json& control) {
  const double least = number_of(control, "minimum", 0), most = number_of(control, "maximum", 1);
  const double step = number_of(control, "step", 0), value = random_.uniform(least, most);
  return step > 0 ? std::min(most, least + std::floor((value - least) / step) * step) : value;
}

Json RehearsalBot::command_for(const Json& control) {
  return {{"command", "set_port"},
          {"arguments", {{"node", text_of(control, "node")}, {"port", text_of(control, "port")}, {"value", value_of(control)}}}};
}

Json RehearsalBot::ballot_for(const Json& vote) {
  const std::string kind = text_of(vote, "kind");
  std::vector<std::string> options;
  for (const Json& option : vote.value("options", Json::array())) options.push_back(text_of(option, "id"));
  if (kind == "slider") return random_.uniform(number_of(vote, "least", 0), number_of(vote, "most", 1));
  if (kind == "yes_no") return random_.uniform() < 0.6 ? "yes" : "no";
  if (options.empty()) return nullptr;
  const auto any = [&] { return options[random_.below(options.size())]; };
  const auto points = static_cast<int>(number_of(vote, "points", 1));
  if (kind == "coins") {
    Json coins = Json::object();
    for (int k = 0; k < points; ++k) {
      const std::string on = any();
      coins[on] = coins.value(on, 0) + 1;
    }
    return coins;
  }
  if (kind == "dots") return Json::array({{{"place", {random_.uniform(0, 100), random_.uniform(0, 100), 0}}, {"option", any()}}});
  for (std::size_t k = options.size(); k > 1; --k) std::swap(options[k - 1], options[random_.below(k)]);
  return options;
}

// --- Acting ---------------------------------------------------------------------------------------------------------

// The first things are one of each kind, so that a short rehearsal has all of them, too.
void RehearsalBot::act(double now) {
  if (vote(now)) return;
  const std::int64_t turn = acts_++;
  const double chance = random_.uniform();
  if (turn < kKinds ? (turn + seat_) % kKinds == 0 : chance < kPartOfComments) comment(now);
  else if (turn < kKinds ? (turn + seat_) % kKinds == 1 : chance < kPartOfComments + kPartOfRatings) rate(now);
  else if (turn < kKinds ? (turn + seat_) % kKinds == 2 : chance < kPartOfComments + kPartOfRatings + kPartOfProposals)
    propose(now);
  else begin_drag(now);
}

// A ballot for a vote that is open, once for each.
bool RehearsalBot::vote(double now) {
  if (!may("vote")) return false;
  for (const auto& [id, vote] : view("votes").items()) {
    if (!flag_of(vote, "open") || voted_.contains(id)) continue;
    voted_.insert(id);
    const Json ballot = ballot_for(vote);
    if (ballot.is_null()) continue;
    const Json arguments = {{"node", id}, {"voter", "seat " + std::to_string(seat_)}, {"ballot", ballot}};
    say_operation("vote", {{"t", "op"}, {"c", {{"command", "cast_vote"}, {"arguments", arguments}}}}, now);
    return true;
  }
  return false;
}

void RehearsalBot::begin_drag(double now) {
  const Json& card = view("card");
  if (!may("change") || !card.contains("controls") || card["controls"].empty()) return;
  shown_->dragged = card["controls"][random_.below(card["controls"].size())];
  drag_ = {.gesture = ++last_gesture_, .values_left = kValuesOfDrag, .due = now};
  go_on_with_drag(now);
}

void RehearsalBot::go_on_with_drag(double now) {
  if (now < drag_.due) return;
  drag_.due = now + kBetweenValues;
  --drag_.values_left;
  say_operation("move", {{"t", "op"}, {"gesture", drag_.gesture}, {"c", command_for(shown_->dragged)}}, now);
}

void RehearsalBot::propose(double now) {
  const Json& card = view("card");
  if (!may("draft") || !card.contains("controls") || card["controls"].empty()) return;
  const std::string name = "rehearsal_" + std::to_string(seat_) + "_" + std::to_string(++names_);
  const Json& control = card["controls"][random_.below(card["controls"].size())];
  say_operation("draft", {{"t", "draft"}, {"do", "begin"}, {"draft", name}, {"title", "Rehearsal"}}, now);
  say_operation("draft", {{"t", "op"}, {"draft", name}, {"c", command_for(control)}}, now);
  say_event("propose", "propose", {{"draft", name}, {"title", "Rehearsal"}, {"why", "Because this is a rehearsal."}}, now, name);
}

void RehearsalBot::comment(double now) {
  if (!may("comment")) return;
  const std::string id = "rehearsal_" + std::to_string(seat_) + "_" + std::to_string(++names_);
  say_event("comment", "comment", {{"id", id}, {"text", kComments[random_.below(std::size(kComments))]}}, now, id);
}

void RehearsalBot::rate(double now) {
  if (!may("comment")) return;
  std::vector<std::string> others;
  for (const auto& [id, comment] : view("comments").items())
    if (static_cast<std::int64_t>(number_of(comment, "seat", 0)) != seat_) others.push_back(id);
  if (others.empty()) return;
  say_event("rate", "rate_comment",
            {{"comment", others[random_.below(others.size())]}, {"rating", random_.uniform() < 0.7 ? 1 : -1}}, now);
}

// --- Leading --------------------------------------------------------------------------------------------------------

void RehearsalBot::act_as_lead(double now) {
  const Json& room = view("room");
  if (!room.contains("seats")) return;
  if (!std::exchange(has_begun_phase_, true))
    say_event("lead", "set_phase", {{"name", "Rehearsal"}, {"activities", {"change", "draft", "comment", "vote"}}}, now);
  std::vector<std::string> cards;
  for (const auto& [id, card] : room.value("cards", Json::object()).items()) cards.push_back(id);
  for (const std::int64_t seat : led_) {
    if (cards.empty() || given_.contains(seat)) continue;
    const std::string& card = cards[given_.size() % cards.size()];
    given_.insert(seat);
    say_event("lead", "set_role", {{"seat", seat}, {"role", "stakeholder"}, {"card", card}}, now);
  }
  for (const auto& [id, vote] : view("votes").items()) {
    if (flag_of(vote, "open") || !opened_.insert(id).second) continue;
    say_event("lead", "open_vote", {{"vote", id}}, now);
  }
}

void RehearsalBot::close_votes(double now) {
  for (const std::string& id : opened_) say_event("lead", "close_vote", {{"vote", id}}, now);
  opened_.clear();
}

}  // namespace bl::cli
