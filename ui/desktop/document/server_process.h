// A run of the program `behaviourlinks` beside the window, which outlives the window where nobody ends it.
#pragma once

#include <sys/types.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace bl::desktop {

/// Where that program lies: in the folder of this one, or in that of a build. Empty where there is none.
std::string server_program();

/// What it writes goes into files of a folder that only this person can read, and not into pipes: a program whose pipe is gone
/// ends, and this one shall go on when the window has ended or has crashed.
class ServerProcess {
 public:
  enum class Lives { on, with_this_one };  ///< when this program ends or crashes, it goes on, or is interrupted
  static Result<std::unique_ptr<ServerProcess>> start(const std::string& program, const std::vector<std::string>& words,
                                                      Lives lives = Lives::on);
  /// Lets a process that runs go on, without the files of `private_file`; of one that has ended nothing stays.
  ~ServerProcess();
  ServerProcess(const ServerProcess&) = delete;
  ServerProcess& operator=(const ServerProcess&) = delete;

  /// A path for a file with secrets, which exists already, is empty, and can be read by this person alone. Words that begin with
  /// `kPrivateFile` name it.
  const std::string& private_file() const { return private_file_; }
  static constexpr const char* kPrivateFile = "{private file}";

  std::string output() const;
  /// What it has complained of, without its name at the beginning of lines.
  std::string complaints() const;
  /// None while it runs; 128 and more: ended by a signal.
  std::optional<int> exit_code();
  /// As Ctrl-C does.
  void interrupt();
  pid_t number() const { return number_; }

 private:
  ServerProcess() = default;
  std::string folder_, private_file_;
  pid_t number_ = -1;
  std::optional<int> code_;
};

}  // namespace bl::desktop
