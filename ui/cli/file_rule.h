// The rule on files for all tasks, checked before the work: an output can be written, and is no input or file of another kind.
#pragma once

#include <functional>
#include <initializer_list>
#include <map>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "ui/cli/declarations.h"

namespace bl::cli {

/// The kind of content that a task writes into a file. An existing file is replaced where it holds the same kind, or nothing.
enum class FileKind { scene, figures, table, page, log };

/// What the options of one task do with the files that they name. An option that takes a file and is not listed here is a defect,
/// which any call of the task reports.
class TaskFiles {
 public:
  /// Options that name files or folders which the task reads.
  TaskFiles& reads(std::initializer_list<const char*> options);
  /// An option that names a file which the task writes. It may name the file of `changed` as well, which is then changed in
  /// place.
  TaskFiles& writes(const char* option, FileKind kind, const char* changed = nullptr);
  /// Why a folder cannot be filled: files of others in it have names that would be written.
  using Objection = std::function<Result<void>(const std::string& folder)>;
  /// An option that names a folder into which files with these endings are written.
  TaskFiles& fills(const char* option, std::vector<std::string> endings, Objection objection = {});

  /// An option that names files or folders which the task itself judges when it knows what they are to hold. Here it is only seen
  /// to that they are no inputs and no other outputs.
  TaskFiles& exports(const char* option);

  struct Role {
    enum class Use { reads, writes, fills, exports } use = Use::reads;
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
