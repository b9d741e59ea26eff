// The tables as SQL. They are strict: SQLite itself refuses a text in the place of a number.
#include "core/journal/tables.h"

namespace bl::journal {

// entry.line is the line of the log as an export has it. It has no name and no words of anybody: words are in `text`, names in
// `person`. entry.chain is the hash of this entry and all before it, so that a changed, missing or exchanged entry is noticed.
const char* const kTables = R"(
CREATE TABLE room (one INTEGER PRIMARY KEY CHECK (one = 1), code TEXT NOT NULL, title TEXT NOT NULL, epoch INTEGER NOT NULL,
  build TEXT NOT NULL, registry TEXT NOT NULL, hash_scheme INTEGER NOT NULL, base INTEGER NOT NULL, scene BLOB NOT NULL,
  scene_size INTEGER NOT NULL, scene_digest TEXT NOT NULL, created INTEGER NOT NULL, closes INTEGER NOT NULL,
  erase_on INTEGER NOT NULL) STRICT;
CREATE TABLE entry (seq INTEGER PRIMARY KEY, at INTEGER NOT NULL, draft TEXT NOT NULL, accepted_by INTEGER NOT NULL,
  is_called_off INTEGER NOT NULL, line TEXT NOT NULL, chain TEXT NOT NULL) STRICT;
CREATE TABLE run (run TEXT PRIMARY KEY, seat INTEGER NOT NULL, last_operation INTEGER NOT NULL) STRICT, WITHOUT ROWID;
CREATE TABLE refusal (run TEXT, operation INTEGER, why TEXT NOT NULL, place TEXT NOT NULL, text TEXT NOT NULL, args TEXT NOT NULL,
  PRIMARY KEY (run, operation)) STRICT, WITHOUT ROWID;
CREATE TABLE token (seat INTEGER PRIMARY KEY, hash TEXT NOT NULL) STRICT;
CREATE TABLE person (seat INTEGER PRIMARY KEY, name TEXT NOT NULL, contact TEXT NOT NULL, language TEXT NOT NULL,
  consent_at INTEGER NOT NULL) STRICT;
CREATE TABLE text (id TEXT PRIMARY KEY, seat INTEGER NOT NULL, kind TEXT NOT NULL, body TEXT NOT NULL,
  is_erased INTEGER NOT NULL) STRICT;
CREATE TABLE draft (id TEXT PRIMARY KEY, seat INTEGER NOT NULL, base INTEGER NOT NULL, title TEXT NOT NULL,
  state TEXT NOT NULL) STRICT, WITHOUT ROWID;
CREATE TABLE draft_step (draft TEXT, number INTEGER, command TEXT, PRIMARY KEY (draft, number)) STRICT, WITHOUT ROWID;
CREATE TABLE ballot_key (vote TEXT PRIMARY KEY, key TEXT NOT NULL) STRICT, WITHOUT ROWID;
CREATE TABLE secret_ballot (vote TEXT, id TEXT, ballot TEXT NOT NULL, PRIMARY KEY (vote, id)) STRICT, WITHOUT ROWID;
CREATE TABLE snapshot (seq INTEGER, tick INTEGER, epoch INTEGER NOT NULL, hash TEXT NOT NULL, name TEXT NOT NULL,
  scene BLOB NOT NULL, scene_size INTEGER NOT NULL, scene_digest TEXT NOT NULL, PRIMARY KEY (seq, tick, name)) STRICT;
CREATE TABLE hash (seq INTEGER, tick INTEGER, hash TEXT NOT NULL, PRIMARY KEY (seq, tick)) STRICT, WITHOUT ROWID;
)";

}  // namespace bl::journal
