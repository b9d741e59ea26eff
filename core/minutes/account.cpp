// The room folds each entry; what it says before and after is all that the minutes know.
#include "core/minutes/account.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "core/base/moment.h"
#include "core/file/scene_file.h"
#include "core/graph/simulation.h"
#include "core/journal/export.h"
#include "core/minutes/vote_count.h"
#include "core/reading/views/people.h"
#include "core/room/room.h"

namespace bl::minutes {

namespace {

class Telling {
 public:
  Telling(Account& account, const Scene& beginning, std::int64_t base, const Registry& registry)
      : account_(&account), registry_(&registry), ledger_(registry, beginning, base), room_(ledger_, {}) {}

  Result<void> tell(const room::EntryRecord& record) {
    if (auto done = room_.replay(record); !done) return done.error().within("entry " + std::to_string(record.entry.seq));
    const Moment moment{record.entry.seq, record.entry.tick, record.at};
    if (moment.at != 0) {
      if (!account_->first) account_->first = moment;
      account_->last = moment;
    }
    if (record.entry.event) {
      const auto content = record.entry.event->read();
      if (!content) return content.error();
      note((**content).value("event", ""), (**content)["arguments"], record.entry, moment);
    }
    count_closed(false);
    return {};
  }

  void end() {
    for (auto& [vote, round] : open_) closing_.push_back(round);
    count_closed(true);
    account_->state = room_.state();
    account_->last_scene = write_scene(room_.scene(), *registry_);
  }

 private:
  static std::string name_in(const Json& arguments, const char* argument) { return arguments.value(argument, ""); }

  void note(const std::string& event, const Json& arguments, const LogEntry& entry, const Moment& moment) {
    const room::RoomState& state = room_.state();
    if (event == "join") account_->joined[arguments.value("seat", std::int64_t{0})] = moment;
    else if (event == "set_phase") note_phase(moment);
    else if (event == "mark") account_->marks.push_back(moment);
    else if (event == "comment") account_->comments.push_back({.id = name_in(arguments, "id"), .moment = moment});
    else if (event == "answer_comment") note_answer(name_in(arguments, "comment"), entry);
    else if (event == "save_scenario")
      account_->scenarios.push_back({name_in(arguments, "id"), moment, write_scene(room_.scene(), *registry_), {}});
    else if (event == "propose" || event == "decide_proposal")
      note_proposal(event == "propose", name_in(arguments, "draft"), moment);
    else if (event == "open_vote") {
      const std::string vote = name_in(arguments, "vote");
      const auto before =
          std::count_if(account_->rounds.begin(), account_->rounds.end(), [&](const Round& round) { return round.vote == vote; });
      open_[vote] = account_->rounds.size();
      account_->rounds.push_back(
          {.vote = vote, .number = before + 1, .opened = moment, .is_secret = state.votes.at(vote).is_secret});
    } else if (event == "close_vote") {
      const auto round = open_.find(name_in(arguments, "vote"));
      account_->rounds[round->second].closed = moment;
      closing_.push_back(round->second);
      open_.erase(round);
    }
  }

  // Another end of the timer is no other phase.
  void note_phase(const Moment& moment) {
    const room::Phase& phase = room_.state().phase;
    if (!account_->phases.empty()) {
      PhaseSpan& last = account_->phases.back();
      room::Phase same = phase;
      same.ends_at = last.phase.ends_at;
      if (same == last.phase) {
        last.phase = phase;
        return;
      }
      last.end = moment;
    }
    account_->phases.push_back({phase, moment, {}});
  }

  void note_answer(const std::string& comment, const LogEntry& entry) {
    for (Commented& one : account_->comments)
      if (one.id == comment) one.answered_by = room::RoomState::seat_of_author(entry.author.id);
  }

  void note_proposal(bool is_new, const std::string& draft, const Moment& moment) {
    const room::Proposal& proposal = room_.state().proposals.at(draft);
    if (is_new) {
      account_->proposals.push_back({draft, moment, proposal, {}});
      return;
    }
    const auto last = std::find_if(account_->proposals.rbegin(), account_->proposals.rend(),
                                   [&](const Proposed& one) { return one.draft == draft; });
    last->proposal = proposal;
    last->decided = moment;
  }

  // The room closes a vote in three steps: it says so, it enters the secret ballots, and it closes the node.
  void count_closed(bool is_end) {
    std::erase_if(closing_, [&](std::size_t index) {
      Round& round = account_->rounds[index];
      if (!is_end && takes_ballots(room_.scene(), *registry_, round.vote)) return false;
      round.seats = std::count_if(room_.state().seats.begin(), room_.state().seats.end(),
                                  [](const auto& one) { return !one.second.is_removed; });
      count_votes(room_.scene(), *registry_, round);
      return true;
    });
  }

  Account* account_;
  const Registry* registry_;
  Ledger ledger_;
  room::Room room_;
  std::map<std::string, std::size_t> open_;  // by vote: its round
  std::vector<std::size_t> closing_;         // rounds that are not counted yet
};

// Whoever has voted in secret once may have voted alike before.
void hide_secrets(std::vector<Round>& rounds) {
  std::set<std::string> secret;
  for (const Round& round : rounds)
    if (round.is_secret) secret.insert(round.vote);
  for (Round& round : rounds)
    if (secret.contains(round.vote)) round.ballots.clear();
}

// A scenario of a program that kept no running states, or whose snapshot is damaged, has no figures.
std::vector<SavedFigure> figures_of(const journal::Snapshot& snapshot, const Registry& registry) {
  const auto text = journal::unpack(snapshot.scene);
  if (!text) return {};
  const SceneReading reading = read_scene(*text, registry);
  Simulation simulation(registry, 1);
  if (!reading.is_usable() || !reading.state) return {};
  simulation.set_scene(reading.scene);
  if (!simulation.restore_state(*reading.state)) return {};
  std::vector<SavedFigure> figures;
  for (const auto& [node, row] : reading::rows<reading::IndicatorFigures>(*simulation.state())) {
    const NodePlan& plan = simulation.state()->plan->nodes[node];
    figures.push_back({plan.name.empty() ? plan.id : plan.name, row.unit, row.status, row.value});
  }
  return figures;
}

}  // namespace

// No id of a scenario begins with an underscore.
std::string Saved::file() const { return "scenes/" + std::string(id == "end" ? "_end" : id) + ".json"; }

std::string Account::words(const std::string& text) const {
  if (text.empty()) return {};
  const auto found = texts.find(text);
  return found == texts.end() ? "[not stored]" : found->second;
}

std::string Account::pseudonym(std::int64_t seat) const {
  const auto found = state.seats.find(seat);
  return found == state.seats.end() ? "the room" : found->second.name;
}

std::string Account::time_of(const Moment& moment) const { return moment.at == 0 ? "" : moment_text(moment.at, zone); }

std::string Account::when(const Moment& moment) const {
  return "tick " + std::to_string(moment.tick) + (moment.at == 0 ? "" : ", " + time_of(moment));
}

std::string Account::who(std::int64_t seat) const {
  return state.seats.contains(seat) ? pseudonym(seat) + " (seat " + std::to_string(seat) + ")" : pseudonym(seat);
}

std::int64_t ratings_of(const room::Comment& comment, int rating) {
  return std::count_if(comment.ratings.begin(), comment.ratings.end(), [&](const auto& one) { return one.second == rating; });
}

Result<Account> account_of(const journal::RoomRow& room, const journal::Loaded& loaded, const Registry& registry) {
  if (!loaded.damage.empty()) return loaded.damage.front();
  const SceneReading beginning = read_scene(room.scene, registry);
  if (!beginning.is_usable()) return beginning.first_error().within("the scene of the session file");
  const room::Record& stored = loaded.room.stored;
  Account account{.code = room.code, .title = room.title, .created = room.created};
  for (const room::TextRecord& text : stored.texts) account.texts[text.id] = text.body;
  for (const room::RefusalRecord& refusal : stored.refusals) ++account.refusals[refusal.refusal.why];
  Telling telling(account, beginning.scene, room.base, registry);
  for (const room::EntryRecord& record : stored.entries)
    if (auto done = telling.tell(record); !done) return done.error();
  telling.end();
  for (Saved& saved : account.scenarios)
    if (const auto kept = loaded.scenarios.find(saved.id); kept != loaded.scenarios.end())
      saved.figures = figures_of(kept->second, registry);
  for (const room::SecretBallotRecord& ballot : stored.secret_ballots)
    for (Round& round : account.rounds)
      if (round.vote == ballot.vote && !round.closed) ++round.waiting;
  hide_secrets(account.rounds);
  account.log = journal::log_text(room, loaded, registry);
  account.chain = loaded.chain;
  account.entries = stored.entries.size();
  return account;
}

}  // namespace bl::minutes
