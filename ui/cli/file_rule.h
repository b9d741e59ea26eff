// The one rule on files of all tasks: what a task writes is nothing that it reads, no other output, and no file of another
// kind; and it can be written, which is known before the work and not after it.
#pragma once

#include <functional>
#include <initializer_list>
#include <map>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "ui/cli/declarations.h"

namespace bl::cli {

/// What a task writes into a file. A file that is there already is replaced where it holds the same, or nothing.
enum class FileKind { scene, figures, table, page, log };

/// What the options of one task do with the files that they name. An option with the type name of a file that is not told here
/// is a defect, which any call of the task reports.
class TaskFiles {
 public:
  /// Options that name files or folders which the task reads.
  TaskFiles& reads(std::initializer_list<const char*> options);
  /// An option that names a file which the task writes. It may name the file of `changed`, too: then that one is changed in
  /// place.
  TaskFiles& writes(const char* option, FileKind kind, const char* changed = nullptr);
  /// What speaks against filling a folder: what of others lies in it under the names that are written.
  using Objection = std::function<Result<void>(const std::string& folder)>;
  /// An option that names a folder into which files with these endings are written.
  TaskFiles& fills(const char* option, std::vector<std::string> endings, Objection objection = {});

  struct Role {
    enum class Use { reads, writes, fills } use = Use::reads;
    FileKind kind = FileKind::figures;
    std::string changed;
    std::vector<std::string> endings;
    Objection objection;
  };
  const std::map<std::string, Role>& roles() const { return roles_; }

 private:
  std::map<std::string, Role> roles_;  // by the name of the option
};

/// Where a task says what its options do with files.
TaskFiles& files_of(CLI::App& task);

/// Nothing, or what is wrong with the files that a call of the task names: one sentence with the option.
std::string wrong_files(const CLI::App& task);

}  // namespace bl::cli
