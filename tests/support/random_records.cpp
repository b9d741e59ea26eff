// Each kind of row with keys from a small stock, so that rows replace each other.
#include "tests/support/random_records.h"

#include <sstream>

#include <nlohmann/json.hpp>

#include "core/base/hash.h"
#include "core/define/codec.h"
#include "core/session/log.h"
#include "tests/support/random_commands.h"

namespace bl {

namespace {

std::string of_stock(const char* stem, Random& random, std::uint64_t count) { return stem + std::to_string(random.below(count)); }

room::Refusal random_refusal(Random& random) {
  Json args = Json::object();
  if (random.below(2) == 0) args["holder"] = random_words(random);
  return {static_cast<room::Reason>(random.below(16)), "nodes/" + random_words(random), random_words(random),
          JsonValue::of(args)};
}

}  // namespace

std::string random_words(Random& random) {
  static constexpr const char* kParts[] = {"Bea", "the tower", " ", "\"north\"", "Straße", "공원", "'; DROP TABLE entry; --",
                                           "\n",  "%",         "\\"};
  std::string text;
  for (std::uint64_t parts = 1 + random.below(4); parts > 0; --parts) text += kParts[random.below(std::size(kParts))];
  return text;
}

RandomRecords::RandomRecords(const Scene& scene, std::uint64_t seed, std::int64_t last_seq)
    : scene_(&scene), random_(seed), seq_(last_seq), seq_before_(last_seq), first_seq_(last_seq + 1) {}

// A command that fits the declarations, as it is after it was read: an argument of null, for one, is the same as none.
Command RandomRecords::command() {
  while (true) {
    const LogEntry entry{.seq = 1, .gesture = 1, .author = "1", .command = random_command(*scene_, random_, ++number_)};
    if (auto read = log_entry_of(log_line(entry, full_registry()), full_registry())) return std::move(read->command);
  }
}

room::EntryRecord RandomRecords::entry() {
  room::EntryRecord record;
  LogEntry& entry = record.entry;
  tick_ += static_cast<std::int64_t>(random_.below(3));
  entry.seq = ++seq_;
  entry.tick = tick_;
  entry.gesture = seq_;
  entry.author = {std::to_string(random_.below(5)), static_cast<AuthorKind>(random_.below(3))};
  entry.source = {of_stock("run", random_, 4), seq_};
  record.at = 1700000000000 + seq_;
  const std::uint64_t kind = random_.below(10);
  if (kind == 0 && tick_ > 0) {
    entry.rewinds_to = static_cast<std::int64_t>(random_.below(static_cast<std::uint64_t>(tick_)));
    tick_ = *entry.rewinds_to;
  } else if (kind == 1 && seq_ > first_seq_) {
    entry.restarts_from = seq_ - 1;
    entry.state_hash = hex_digits(random_.below(1000000));
  } else if (kind < 3) {
    Json event = Json::object();
    event["event"] = "comment";
    event["arguments"] = {{"text", of_stock("text", random_, 9)}, {"count", random_.below(1000)}};
    entry.event = JsonValue::of(event);
  } else {
    entry.command = command();
    if (kind == 3) record.draft = of_stock("draft", random_, 5), record.by = 1;
    if (kind == 4) entry.label = random_words(random_);
  }
  return record;
}

room::Record RandomRecords::next() {
  seq_before_ = seq_;
  tick_before_ = tick_;
  room::Record record = filled();
  while (record.is_nothing()) record = filled();
  return record;
}

room::Record RandomRecords::next_of(std::size_t entries) {
  seq_before_ = seq_;
  tick_before_ = tick_;
  room::Record record;
  while (record.entries.size() < entries) record.entries.push_back(entry());
  record.runs.push_back({of_stock("run", random_, 4), 1, seq_});
  return record;
}

void RandomRecords::take_back() {
  seq_ = seq_before_;
  tick_ = tick_before_;
}

room::Record RandomRecords::filled() {
  room::Record record;
  const auto some = [&](std::uint64_t one_in) { return random_.below(one_in) == 0; };
  const auto seat = [&] { return static_cast<std::int64_t>(1 + random_.below(6)); };
  for (std::uint64_t count = random_.below(4); count > 0; --count) record.entries.push_back(entry());
  if (!record.entries.empty()) record.runs.push_back({record.entries.back().entry.source.origin, seat(), seq_});
  if (some(4))
    record.refusals.push_back(
        {of_stock("run", random_, 4), static_cast<std::int64_t>(random_.below(2000)), random_refusal(random_)});
  if (some(6)) record.tokens.push_back({seat(), some(3) ? std::string() : hex_digits(random_.bits())});
  if (some(6)) record.persons.push_back({seat(), some(3) ? std::string() : random_words(random_), "", "", 0});
  if (some(5)) {
    const bool is_erased = some(4);
    record.texts.push_back({of_stock("text", random_, 9), seat(), "comment", is_erased ? "" : random_words(random_), is_erased});
  }
  if (some(5)) record.drafts.push_back({of_stock("draft", random_, 5), seat(), seq_, random_words(random_), "open"});
  if (some(5)) {
    room::DraftStepRecord step{of_stock("draft", random_, 5), static_cast<std::int64_t>(random_.below(4)), {}};
    if (!some(4)) step.command = command();
    record.draft_steps.push_back(std::move(step));
  }
  if (some(6)) record.ballot_keys.push_back({of_stock("vote", random_, 3), some(3) ? std::string() : hex_digits(random_.bits())});
  if (some(4))
    record.secret_ballots.push_back({of_stock("vote", random_, 3), of_stock("ballot", random_, 9),
                                     some(5) ? JsonValue::null() : JsonValue("[" + std::to_string(random_.below(9)) + ", 2]")});
  if (some(9)) record.ballots_in_log.push_back(of_stock("vote", random_, 3));
  return record;
}

void StoredRows::add(const room::Record& record) {
  const auto key_of = [](const std::string& table, const std::string& key) { return table + " " + key + ":"; };
  const auto put = [&](const std::string& table, const std::string& key, const std::string& value) {
    rows_[key_of(table, key)] = value;
  };
  for (const auto& row : record.entries)
    entries_[row.entry.seq] = log_line(row.entry, full_registry()) + std::to_string(row.at) + row.draft + std::to_string(row.by) +
                              (row.entry.is_called_off ? "called off" : "");
  for (const auto& row : record.runs) put("run", row.run, std::to_string(row.seat) + " " + std::to_string(row.last_operation));
  for (const auto& row : record.refusals) {
    auto& kept = refusals_[row.run];
    kept[row.operation] =
        std::string(room::name_of(row.refusal.why)) + row.refusal.place + row.refusal.text + row.refusal.args.text();
    while (kept.size() > 256) kept.erase(kept.begin());
  }
  for (const auto& row : record.tokens) put("token", std::to_string(row.seat), row.hash);
  for (const auto& row : record.persons) {
    put("person", std::to_string(row.seat), row.name + row.contact + row.language + std::to_string(row.consent_at));
    if (row.name.empty() && row.contact.empty() && row.language.empty() && row.consent_at == 0)
      rows_.erase(key_of("person", std::to_string(row.seat)));
  }
  for (const auto& row : record.texts)
    put("text", row.id, std::to_string(row.seat) + row.kind + row.body + (row.is_erased ? " erased" : ""));
  for (const auto& row : record.drafts)
    put("draft", row.id, std::to_string(row.seat) + " " + std::to_string(row.base) + row.title + row.state);
  for (const auto& row : record.draft_steps)
    put("draft_step", row.draft + "/" + std::to_string(row.number),
        row.command.id.empty() ? "undone" : write_json_line(command_to_json(full_registry(), row.command)));
  for (const auto& row : record.ballot_keys) put("ballot_key", row.vote, row.key);
  for (const std::string& vote : record.ballots_in_log)
    std::erase_if(rows_, [&](const auto& row) { return row.first.starts_with("secret_ballot " + vote + "/"); });
  for (const auto& row : record.secret_ballots) {
    put("secret_ballot", row.vote + "/" + row.id, row.ballot.text());
    if (row.ballot.is_null()) rows_.erase(key_of("secret_ballot", row.vote + "/" + row.id));
  }
}

std::string StoredRows::text() const {
  std::string text;
  for (const auto& [seq, line] : entries_) text += std::to_string(seq) + " " + line + "\n";
  for (const auto& [key, value] : rows_) text += key + value + "\n";
  for (const auto& [run, kept] : refusals_)
    for (const auto& [operation, answer] : kept) text += "refusal " + run + "/" + std::to_string(operation) + ":" + answer + "\n";
  return text;
}

std::string first_difference(const std::string& found, const std::string& expected) {
  if (found == expected) return "";
  std::istringstream left(found), right(expected);
  std::string line, other;
  do {
    line.clear();
    other.clear();
    std::getline(left, line);
    std::getline(right, other);
  } while (line == other);
  return "found " + line + "\nexpected " + other;
}

}  // namespace bl
