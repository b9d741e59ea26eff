// The way of an operation: once only, allowed, fitting, in the log; then everything that follows from it.
#include "core/room/room.h"

#include <algorithm>
#include <charconv>
#include <iterator>

#include <nlohmann/json.hpp>

#include "core/define/codec.h"
#include "core/room/refusals.h"

namespace bl::room {

namespace {

constexpr std::size_t kKeptAnswers = 256, kKeptInverses = 20000;
constexpr std::string_view kBackTo = "Back to ";

// A rewind takes back what was done to the scene, not what people have voted, nor that a vote was opened or closed.
bool can_be_taken_back(const LogEntry& entry) {
  return entry.is_command() && entry.command.id != "cast_vote" && entry.author.id != "room";
}

}  // namespace

Room::Room(Ledger& ledger, RoomOptions options) : ledger_(&ledger), options_(std::move(options)) {}

// --- Once only ------------------------------------------------------------------------------------------------------

std::int64_t Room::greet(std::int64_t seat, const std::string& run, std::int64_t last_known) {
  if (run.empty() || state_.seat(seat) == nullptr) return -1;
  Run& known =
      runs_.try_emplace(run, Run{.seat = seat, .last = 0, .last_of_draft = 0, .answers = {}, .gesture = {}}).first->second;
  if (known.seat != seat) return -1;
  if (last_known > known.last) {
    known.last = known.last_of_draft = last_known;
    record_.runs.push_back({run, seat, known.last});
  }
  return known.last;
}

std::map<std::string, std::int64_t> Room::last_of_drafts(std::int64_t seat) const {
  std::map<std::string, std::int64_t> last;
  for (const auto& [name, run] : runs_)
    if (run.seat == seat && run.last_of_draft > 0) last.emplace(name, run.last_of_draft);
  return last;
}

Answer Room::submit(std::int64_t seat, const Operation& operation, Now now) {
  if (operation.run.empty() || operation.id < 1) return refuse(Reason::bad, "id", "an operation needs a run and a number from 1");
  if (state_.seat(seat) == nullptr) return refuse(Reason::right, "", "you have no seat in this room");
  Run& run = runs_.try_emplace(operation.run, Run{.seat = seat, .last = 0, .last_of_draft = 0, .answers = {}, .gesture = {}})
                 .first->second;
  if (run.seat != seat) return refuse(Reason::right, "run", "this run belongs to another seat");
  if (operation.id <= run.last) {
    const auto known =
        std::find_if(run.answers.begin(), run.answers.end(), [&](const auto& one) { return one.first == operation.id; });
    return known == run.answers.end() ? Answer(done(now)) : known->second;
  }
  if (operation.id > run.last + 1)
    return refuse(Reason::gap, "id", "the operation " + std::to_string(run.last + 1) + " has not come yet",
                  {{"next", run.last + 1}});
  Answer result = decide({seat, operation, now});
  answer(run, operation, result);
  return result;
}

bool Room::is_of_draft(const Operation& operation) {
  return !operation.draft.empty() || operation.kind == OperationKind::draft_begin ||
         operation.kind == OperationKind::draft_undo || operation.kind == OperationKind::draft_redo ||
         operation.kind == OperationKind::draft_drop;
}

void Room::answer(Run& run, const Operation& operation, const Answer& answer) {
  run.last = operation.id;
  if (is_of_draft(operation)) run.last_of_draft = operation.id;
  run.answers.emplace_back(operation.id, answer);
  if (run.answers.size() > kKeptAnswers) run.answers.pop_front();
  record_.runs.push_back({operation.run, run.seat, run.last});
  if (const auto* refusal = std::get_if<Refusal>(&answer)) record_.refusals.push_back({operation.run, operation.id, *refusal});
}

Answer Room::decide(const Said& said) {
  if (said.operation.unreadable) return *said.operation.unreadable;
  if (auto stale = why_stale(said.operation)) return *stale;
  switch (said.operation.kind) {
    case OperationKind::command: return say_command(said);
    case OperationKind::event: return say_event(said);
    case OperationKind::undo:
    case OperationKind::redo: return take_back(said);
    case OperationKind::rewind: return rewind(said);
    default: return change_draft(said);
  }
}

// --- Commands -------------------------------------------------------------------------------------------------------

Result<Command> Room::read_command(const Operation& operation) const {
  const auto content = operation.content.read();
  if (!content) return content.error();
  return command_from_json(ledger_->registry(), **content, "");
}

std::int64_t Room::gesture_of(const Said& said) {
  Run& run = runs_.at(said.operation.run);
  if (said.operation.gesture == 0) return 0;
  if (run.gesture.first != said.operation.gesture) run.gesture = {said.operation.gesture, ledger_->new_gesture()};
  return run.gesture.second;
}

Answer Room::say_command(const Said& said) {
  const auto command = read_command(said.operation);
  if (!command) return refusal_of(command.error().code == ErrorCode::out_of_range ? Reason::range : Reason::bad, command.error());
  if (!said.operation.draft.empty()) return add_to_draft(said, *command);
  if (auto refusal = why_not(asking(said.seat), *command, scene())) return *refusal;
  if (command->id == "cast_vote") {
    if (auto refusal = why_no_ballot(state_, *command)) return *refusal;
    if (is_secret(state_, *command)) return cast_secretly(said, *command);
  }
  Submission submission{.command = *command, .author = said.author(), .gesture = gesture_of(said), .source = said.source()};
  auto put_in = put(submission, said.now);
  // A gesture that was ended by an undo goes on as a new one.
  if (!put_in && submission.gesture != 0 && put_in.error().place == "gesture") {
    runs_.at(said.operation.run).gesture = {};
    submission.gesture = gesture_of(said);
    put_in = put(submission, said.now);
  }
  return put_in ? Answer(done(said.now)) : Answer(refusal_of_scene(put_in.error()));
}

Guard Room::guard() {
  return [this](const Change& change) -> Result<void> {
    touches_ = change.touches;
    inverse_ = change.inverse;
    return {};
  };
}

Result<void> Room::put(Submission submission, Now now, const std::string& draft, std::int64_t by) {
  if (auto done = ledger_->submit(std::move(submission), now.tick, guard()); !done) return done;
  follow(ledger_->log().back());
  record_.entries.push_back({ledger_->log().back(), now.at, draft, by});
  remember(record_.entries.back());
  return {};
}

// Who has made what, who has written what last, and how to get back: all that follows from an entry of the log.
void Room::follow(const LogEntry& entry) {
  const std::int64_t seat = RoomState::seat_of_author(entry.author.id);
  for (const Touch& touch : touches_) {
    writes_[touch] = {entry.seq, entry.author.id};
    const bool is_node = touch.part == ScenePart::node;
    if (!touch.path.empty() || (!is_node && touch.part != ScenePart::link)) continue;
    const bool is_there = is_node ? scene().nodes.contains(touch.id) : scene().links.contains(touch.id);
    const std::string place = (is_node ? "nodes/" : "links/") + touch.id;
    if (!is_there) state_.makers.erase(place);
    else if (seat != 0) state_.makers[place] = seat;
  }
  if (can_be_taken_back(entry)) inverses_.push_back({entry.seq, std::move(inverse_), goes_back_to(entry)});
  inverse_.clear();
  scene_seq_ = entry.seq;
  if (inverses_.size() > kKeptInverses) inverses_.pop_front();
  touches_.clear();
}

std::string Room::last_writer(Touch place) const {
  do {
    const auto write = writes_.find(place);
    if (write != writes_.end()) return write->second.author;
  } while (widen(place));
  return "";
}

Result<void> Room::submit_device(const Submission& submission, Now now) { return put(submission, now); }

std::optional<Refusal> Room::why_stale(const Operation& operation) const {
  for (const Condition& condition : operation.conditions) {
    const auto place = touch_named(condition.key);
    const auto now = place ? value_at(scene(), ledger_->registry(), *place) : std::nullopt;
    if (!now) return refuse(Reason::gone, condition.key, "is not there any more");
    if (*now == condition.was) continue;
    const auto write = writes_.find(*place);
    Json args = Json::object();
    args["now"] = **now->read();
    if (write != writes_.end()) {
      const Seat* seat = state_.seat(RoomState::seat_of_author(write->second.author));
      args["by"] = seat == nullptr ? write->second.author : seat->name;
      args["seq"] = write->second.seq;
    }
    return refuse(Reason::stale, condition.key, "has been changed since", std::move(args));
  }
  return std::nullopt;
}

// --- Undo, redo, rewind ---------------------------------------------------------------------------------------------

Answer Room::take_back(const Said& said) {
  const auto content = said.operation.content.read();
  if (!content) return refusal_of(Reason::bad, content.error());
  const auto gesture = whole_number(**content, "gesture", 0), of = whole_number(**content, "of", said.seat);
  if (!gesture || !of) return refuse(Reason::bad, gesture ? "of" : "gesture", "expects a whole number");
  const Seat& seat = *state_.seat(said.seat);
  if (*of != said.seat && seat.role != Role::facilitator)
    return refuse(Reason::right, "of", "only the facilitator takes back what others have done");
  const Scene before = scene();
  std::optional<Refusal> refusal;
  const Guard check = [&](const Change& change) -> Result<void> {
    refusal = why_no_undo(asking(said.seat), before, scene(), change.touches);
    if (refusal) return Error{ErrorCode::conflict, refusal->place, refusal->text};
    return guard()(change);
  };
  const Author author = RoomState::author_of_seat(*of);
  const std::size_t first = ledger_->log().size();
  const auto taken = said.operation.kind == OperationKind::undo
                         ? ledger_->undo(author, said.now.tick, *gesture, said.source(), check)
                         : ledger_->redo(author, said.now.tick, *gesture, said.source(), check);
  if (refusal) return *refusal;
  if (!taken) return refusal_of(taken.error().code == ErrorCode::not_found ? Reason::gone : Reason::stale, taken.error());
  // One undo may be several entries; what it touched as a whole belongs to the last of them.
  for (std::size_t k = first; k < ledger_->log().size(); ++k)
    record_.entries.push_back({ledger_->log()[k], said.now.at, {}, *of == said.seat ? 0 : said.seat});
  follow(ledger_->log().back());
  return done(said.now);
}

Answer Room::rewind(const Said& said) {
  if (state_.seat(said.seat)->role != Role::facilitator)
    return refuse(Reason::right, "", "only the facilitator takes back what everybody has done");
  const auto content = said.operation.content.read();
  if (!content) return refusal_of(Reason::bad, content.error());
  const auto to = whole_number(**content, "to", -1);
  if (!to || *to < 0 || *to >= ledger_->last_seq())
    return refuse(Reason::bad, "to", "expects the number of an entry before the last one");
  auto way = way_back_to(*to);
  if (const auto* refusal = std::get_if<Refusal>(&way)) return *refusal;
  std::vector<Command>& back = std::get<std::vector<Command>>(way);
  if (back.empty()) return refuse(Reason::gone, "to", "nothing of the scene has changed since that entry");
  Submission submission{.command = command<Batch>({std::move(back)}), .author = said.author(), .source = said.source()};
  submission.label = std::string(kBackLabel) + std::to_string(*to);
  const auto put_in = put(std::move(submission), said.now);
  return put_in ? Answer(done(said.now)) : Answer(refusal_of_scene(put_in.error()));
}

std::ptrdiff_t Room::place_after(std::int64_t seq) const {
  const auto after = std::upper_bound(inverses_.begin(), inverses_.end(), seq,
                                      [](std::int64_t one, const WayBack& way) { return one < way.seq; });
  const std::ptrdiff_t last = after - inverses_.begin() - 1;
  if (last < 0) return last;
  const std::int64_t same_as = inverses_[static_cast<std::size_t>(last)].same_as;
  const bool is_known = inverses_.size() < kKeptInverses || same_as + 1 >= inverses_.front().seq;
  return same_as >= 0 && is_known ? place_after(same_as) : last;
}

std::vector<std::pair<std::int64_t, std::int64_t>> Room::unchanged_since() const {
  std::vector<std::pair<std::int64_t, std::int64_t>> spans;
  const std::int64_t last = ledger_->last_seq();
  const std::ptrdiff_t now = place_after(last);
  const std::size_t first = inverses_.size() > kLookedBack ? inverses_.size() - kLookedBack : 0;
  if (now < 0 && first == 0) spans.emplace_back(0, inverses_.empty() ? last : inverses_.front().seq - 1);
  for (std::size_t k = first; k < inverses_.size(); ++k) {
    if (place_after(inverses_[k].seq) != now) continue;
    const std::int64_t end = k + 1 < inverses_.size() ? inverses_[k + 1].seq - 1 : last;
    if (!spans.empty() && spans.back().second + 1 == inverses_[k].seq) spans.back().second = end;
    else spans.emplace_back(inverses_[k].seq, end);
  }
  return spans;
}

std::vector<Command> Room::commands_of(std::size_t place) const {
  const std::int64_t first = place == 0 ? 0 : inverses_[place - 1].seq, last = inverses_[place].seq;
  std::vector<Command> commands;
  const auto& log = ledger_->log();
  auto entry = std::upper_bound(log.begin(), log.end(), first, [](std::int64_t one, const LogEntry& e) { return one < e.seq; });
  for (; entry != log.end() && entry->seq <= last; ++entry)
    if (can_be_taken_back(*entry)) commands.push_back(entry->command);
  return commands;
}

// The scenes after the entries are a tree: each lies behind the one that its entry has changed, and whoever goes back is where
// they have been. The way leads up to where both have parted, and down again. Would it take back the steps back themselves, each
// of them would hold all those before it, and be twice as long as the last one.
std::variant<std::vector<Command>, Refusal> Room::way_back_to(std::int64_t seq) const {
  if (inverses_.size() == kKeptInverses && inverses_.front().seq > seq + 1)
    return refuse(Reason::gone, "to",
                  "the entries before " + std::to_string(inverses_.front().seq) + " can no longer be taken back");
  std::vector<Command> back;
  std::vector<std::size_t> down;
  std::ptrdiff_t from = place_after(ledger_->last_seq()), to = place_after(seq);
  while (from != to) {
    const auto higher = static_cast<std::size_t>(std::max(from, to));
    const WayBack& way = inverses_[higher];
    if (from > to) back.insert(back.end(), way.commands.begin(), way.commands.end());
    else down.push_back(higher);
    (from > to ? from : to) = place_after(way.seq - 1);
  }
  for (auto place = down.rbegin(); place != down.rend(); ++place) {
    std::vector<Command> commands = commands_of(*place);
    std::move(commands.begin(), commands.end(), std::back_inserter(back));
  }
  return back;
}

std::int64_t Room::goes_back_to(const LogEntry& entry) const {
  if (!entry.label.starts_with(kBackTo)) return -1;
  const std::string id = entry.label.substr(kBackTo.size());
  if (const auto scenario = state_.scenarios.find(id); scenario != state_.scenarios.end()) return scenario->second.seq;
  std::int64_t seq = -1;
  if (!entry.label.starts_with(kBackLabel)) return -1;
  const char* begin = entry.label.data() + kBackLabel.size();
  const char* end = entry.label.data() + entry.label.size();
  // Nobody goes back to what comes later, whatever a damaged file says.
  return std::from_chars(begin, end, seq).ptr == end && seq < entry.seq ? seq : -1;
}

// The scene first, by a command that can be undone; then the running state, which cannot; then what the minutes say of it. From
// there on the ticks count from that of the scenario.
Answer Room::restart(const Said& said, const EventDefinition& kind, const std::map<std::string, Value>& arguments) {
  const std::string id = std::get<std::string>(arguments.at("scenario"));
  const auto scenario = state_.scenarios.find(id);
  if (scenario == state_.scenarios.end()) return refuse(Reason::gone, "arguments/scenario", "there is no scenario `" + id + "`");
  const auto kept = options_.kept_state ? options_.kept_state(id) : std::nullopt;
  if (!kept) return refuse(Reason::gone, "arguments/scenario", "the running state of `" + id + "` was not kept");
  const std::int64_t from = scenario->second.seq;
  auto way = way_back_to(from);
  if (const auto* refusal = std::get_if<Refusal>(&way)) return *refusal;
  if (std::vector<Command>& back = std::get<std::vector<Command>>(way); !back.empty()) {
    Submission submission{.command = command<Batch>({std::move(back)}), .author = said.author()};
    submission.label = std::string(kBackTo) + id;
    if (auto put_in = put(std::move(submission), said.now); !put_in) return refusal_of_scene(put_in.error());
  }
  // It goes back to an entry that is there.
  (void)ledger_->restart(said.author(), said.now.tick, from, kept->hash);
  record_.entries.push_back({ledger_->log().back(), said.now.at});
  scene_seq_ = ledger_->last_seq();
  restart_ = id;
  std::map<std::string, Value> told = arguments;
  told["state"] = kept->hash;
  return enter_event({said.seat, said.operation, {kept->tick, said.now.at}}, kind, std::move(told));
}

// --- Coming back ----------------------------------------------------------------------------------------------------

Result<void> Room::replay(const EntryRecord& record) {
  const LogEntry& entry = record.entry;
  touches_.clear();
  inverse_.clear();
  if (auto done = ledger_->replay(entry, guard()); !done) return done;
  if (entry.event) {
    const auto content = entry.event->read();
    if (!content) return content.error();
    const std::string event = (**content).value("event", "");
    if (auto folded = fold(ledger_->log().back(), event, (**content)["arguments"]); !folded) return folded;
  } else {
    follow(entry);
  }
  remember(record);
  return {};
}

void Room::restore(const Record& rows) {
  for (const RunRecord& run : rows.runs)
    runs_[run.run] = {
        .seat = run.seat, .last = run.last_operation, .last_of_draft = run.last_operation, .answers = {}, .gesture = {}};
  for (const LogEntry& entry : ledger_->log()) {
    const auto run = runs_.find(entry.source.origin);
    if (entry.source.operation == 0 || run == runs_.end()) continue;
    run->second.answers.emplace_back(entry.source.operation, Acknowledgement{entry.seq, entry.tick});
  }
  for (const RefusalRecord& refusal : rows.refusals)
    if (const auto run = runs_.find(refusal.run); run != runs_.end())
      run->second.answers.emplace_back(refusal.operation, refusal.refusal);
  for (auto& [name, run] : runs_) {
    std::stable_sort(run.answers.begin(), run.answers.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    // Of an operation with several entries the last one counts, as it did when it was answered.
    std::deque<std::pair<std::int64_t, Answer>> last;
    for (auto& one : run.answers) {
      if (!last.empty() && last.back().first == one.first) last.pop_back();
      last.push_back(std::move(one));
    }
    while (last.size() > kKeptAnswers) last.pop_front();
    run.answers = std::move(last);
  }
  for (const TokenRecord& token : rows.tokens)
    if (!token.hash.empty()) tokens_[token.hash] = token.seat;
  for (const TextRecord& text : rows.texts) texts_[text.id] = text;
  text_count_ = static_cast<std::int64_t>(texts_.size());
  for (const DraftRecord& row : rows.drafts) {
    Draft draft(ledger_->registry(), row.id, row.seat, row.title, row.base);
    for (std::size_t k = 0; k < std::size(kDraftStateNames); ++k)
      if (kDraftStateNames[k] == row.state) draft.set_state(static_cast<DraftState>(k));
    drafts_.insert_or_assign(row.id, std::move(draft));
  }
  for (const DraftStepRecord& step : rows.draft_steps)
    if (const auto draft = drafts_.find(step.draft); draft != drafts_.end()) draft->second.restore(step.number, step.command);
  for (const BallotKeyRecord& key : rows.ballot_keys)
    if (!key.key.empty()) ballot_keys_[key.vote] = key.key;
  for (const SecretBallotRecord& ballot : rows.secret_ballots) secret_ballots_[ballot.vote][ballot.id] = ballot.ballot;
}

const TextRecord* Room::text(const std::string& id) const {
  const auto found = texts_.find(id);
  return found == texts_.end() ? nullptr : &found->second;
}

std::string Room::words(const std::string& id) const {
  const TextRecord* known = text(id);
  return known == nullptr ? id : known->body;
}

}  // namespace bl::room
