// An SQLite file: open, change and read, with each failure as a sentence.
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <variant>

#include "core/base/result.h"

struct sqlite3;
struct sqlite3_session;
struct sqlite3_stmt;

namespace bl::journal {

/// Bytes that are no text.
struct Blob {
  std::string_view bytes;
};
/// What a parameter of a statement takes; nothing is NULL.
using Cell = std::variant<std::monostate, std::int64_t, std::string_view, Blob>;

/// One row of an answer; its texts are valid until the next row.
class Row {
 public:
  explicit Row(sqlite3_stmt* statement) : statement_(statement) {}
  bool is_null(int column) const;
  std::int64_t number(int column) const;
  std::string text(int column) const;

 private:
  sqlite3_stmt* statement_;
};

class Database {
 public:
  enum class Access : std::uint8_t { create, write, read };
  /// `vfs`: by which SQLite reaches the disk; empty: its own. Nothing is read yet.
  static Result<Database> open(const std::string& path, Access access, const std::string& vfs);
  /// Whether the file has a part that has not been brought into it, as after a crash.
  static bool has_unfinished_part(const std::string& path, const std::string& vfs);
  static bool exists(const std::string& path, const std::string& vfs);

  /// Statements without parameters.
  Result<void> run(const std::string& statements);
  /// One statement, kept prepared.
  Result<void> change(const char* statement, std::initializer_list<Cell> cells = {});
  using Reader = std::function<Result<void>(const Row&)>;
  /// Calls `reader` with each row, until it fails.
  Result<void> read(const char* statement, std::initializer_list<Cell> cells, const Reader& reader);
  /// The first number of the first row; 0 where there is none.
  Result<std::int64_t> number(const char* statement, std::initializer_list<Cell> cells = {});

  /// All that `changes` does, or nothing of it; on the disk when this returns.
  Result<void> in_one_transaction(const std::function<Result<void>()>& changes);
  /// Rows that the last statement has changed.
  std::int64_t changed_rows() const;
  bool is_open() const { return database_ != nullptr; }
  bool is_read_only() const;
  /// Of the part that is not yet in the file itself [bytes].
  std::int64_t unfinished_bytes() const;
  /// Brings that part into the file, and empties it.
  Result<void> checkpoint();
  /// Ends the work with the file; otherwise that happens with the object, and failures are not told.
  Result<void> close();

  // Copies that are kept while the file is written (copying.cpp).
  /// All of the file as bytes.
  Result<std::string> bytes();
  /// Makes this file the one that those bytes are, as one transaction.
  Result<void> become(const std::string& bytes);
  /// From now on changes of rows are noted.
  Result<void> note_changes();
  void stop_noting() { session_.reset(); }
  /// Those since the last call, for `repeat` on a file that has all before them. Empty where nothing has changed.
  Result<std::string> take_changes();
  Result<void> repeat(const std::string& changes);

 private:
  struct CloseDatabase {
    void operator()(sqlite3* database) const;
  };
  struct EndStatement {
    void operator()(sqlite3_stmt* statement) const;
  };
  struct EndSession {
    void operator()(sqlite3_session* session) const;
  };
  Error failure() const;
  Result<sqlite3_stmt*> prepared(const char* statement, std::initializer_list<Cell> cells);

  std::string path_;
  std::unique_ptr<sqlite3, CloseDatabase> database_;
  std::map<std::string, std::unique_ptr<sqlite3_stmt, EndStatement>, std::less<>> statements_;
  std::unique_ptr<sqlite3_session, EndSession> session_;  // after the database: it ends before
};

/// Whether such changes take something out that shall be out for good: names, words, keys, secret ballots.
Result<bool> erases_words(const std::string& changes);

}  // namespace bl::journal
