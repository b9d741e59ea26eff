// What a room must have on the disk before anybody is told of it: the rows of one commit.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/define/command_builder.h"
#include "core/define/payload.h"
#include "core/room/answer.h"
#include "core/session/log.h"

namespace bl::room {

/// An entry of the log: a command, a rewind or an event of the room.
struct EntryRecord {
  LogEntry entry;
  std::int64_t at = 0;     ///< when it came, by the host's clock [ms since 1970]; nothing that is computed reads it
  std::string draft = {};  ///< the draft that it was accepted from; empty: none
  std::int64_t by = 0;     ///< the seat that accepted it for its author; 0: nobody
};

/// How far the operations of one page or window (a run) have been answered.
struct RunRecord {
  std::string run;
  std::int64_t seat = 0, last_operation = 0;
};

/// A refused operation, kept so that the same operation gets the same answer again.
struct RefusalRecord {
  std::string run;
  std::int64_t operation = 0;
  Refusal refusal = {};
};

/// What opens a seat: a hash of its token, never the token. Empty: it is void.
struct TokenRecord {
  std::int64_t seat = 0;
  std::string hash;
};

/// Who sits on a seat. It is the only place with names; a row without any content is deleted.
struct PersonRecord {
  std::int64_t seat = 0;
  std::string name, contact, language;
  std::int64_t consent_at = 0;  ///< [ms since 1970]; 0: none
};

/// The words of a comment, a proposal or a reason; entries name them by id, so that they can be erased.
struct TextRecord {
  std::string id;
  std::int64_t seat = 0;
  std::string kind, body;
  bool is_erased = false;
};

/// A draft: changes that its owner has not proposed yet, or that are proposed and neither accepted nor rejected.
struct DraftRecord {
  std::string id;
  std::int64_t seat = 0, base = 0;  ///< `base`: the last entry of the log when it was begun
  std::string title, state;
};

/// One step of a draft; a step that was undone has no command.
struct DraftStepRecord {
  std::string draft;
  std::int64_t number = 0;
  Command command = {};
};

/// The key that ties a secret ballot to its seat while the vote is open. Empty: it was destroyed, and nobody can tell any more.
struct BallotKeyRecord {
  std::string vote, key;
};

/// A secret ballot before it is in the log; `id` says nothing about the seat without the key. A ballot of null is withdrawn.
struct SecretBallotRecord {
  std::string vote, id;
  JsonValue ballot = JsonValue::null();
};

/// Everything of one commit. It is stored as a whole or not at all; rows replace those with the same key.
struct Record {
  std::vector<EntryRecord> entries;
  std::vector<RunRecord> runs;
  std::vector<RefusalRecord> refusals;
  std::vector<TokenRecord> tokens;
  std::vector<PersonRecord> persons;
  std::vector<TextRecord> texts;
  std::vector<DraftRecord> drafts;
  std::vector<DraftStepRecord> draft_steps;
  std::vector<BallotKeyRecord> ballot_keys;
  std::vector<SecretBallotRecord> secret_ballots;
  std::vector<std::string> ballots_in_log;  ///< votes whose secret ballots the log has now: their rows are deleted

  bool is_nothing() const {
    return entries.empty() && runs.empty() && refusals.empty() && tokens.empty() && persons.empty() && texts.empty() &&
           drafts.empty() && draft_steps.empty() && ballot_keys.empty() && secret_ballots.empty() && ballots_in_log.empty();
  }
};

/// What a room begins from: the scene file as text (with its saved state, if any) and what was stored since. `stored.entries`
/// are all entries since that scene, in order; of the other rows it has the last of each key.
struct Stored {
  std::string code, title;
  std::int64_t base = 0;  ///< number of the last entry before the scene
  std::string scene;
  Record stored;
};

}  // namespace bl::room
