// fork and exec: between them only what may be done in a program that has several threads.
#include "ui/desktop/document/server_process.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "core/file/file_io.h"
#include "core/host/journal.h"

namespace bl::desktop {

namespace {

namespace fs = std::filesystem;

constexpr const char *kOutput = "/output", *kComplaints = "/complaints", *kSecrets = "/secrets.json", *kNumber = "process";

// An empty file that only this person can read, open for writing; below 0 where there is none.
int new_file(const std::string& path) {
  std::error_code error;
  if (!write_file(path, "")) return -1;
  fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write, error);
  return error ? -1 : ::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
}

std::string text_of_file(const std::string& path) {
  auto text = read_file(path);
  return text ? std::move(*text) : std::string();
}

// The program's name before each line is for terminals.
std::string without_name(const std::string& text) {
  constexpr std::string_view kName = "behaviourlinks: ";
  std::string plain;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size() - 1) + 1;
    std::string_view line(text.data() + begin, end - begin);
    if (line.starts_with(kName)) line.remove_prefix(kName.size());
    plain += line;
    begin = end;
  }
  return plain;
}

// Folders of processes that are gone: of rooms that outlived their window, and of windows that crashed.
void sweep(const fs::path& rooms) {
  std::error_code error;
  std::vector<fs::path> gone;
  for (const auto& one : fs::directory_iterator(rooms, error)) {
    const int number = std::atoi(text_of_file((one.path() / kNumber).string()).c_str());
    if (number > 0 && ::kill(number, 0) != 0 && errno == ESRCH) gone.push_back(one.path());
  }
  for (const fs::path& one : gone) fs::remove_all(one, error);
}

[[noreturn]] void become(const char* program, char* const* arguments, int output, int complaints, int nothing, bool lives_on) {
  if (!lives_on) ::prctl(PR_SET_PDEATHSIG, SIGINT);
  ::setsid();  // a terminal that closes, and its Ctrl-C, are nothing to a room
  ::dup2(nothing, STDIN_FILENO);
  ::dup2(output, STDOUT_FILENO);
  ::dup2(complaints, STDERR_FILENO);
  ::execv(program, arguments);
  ::_exit(127);
}

}  // namespace

std::string server_program() {
  std::error_code error;
  const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (const fs::path& place : {folder / "behaviourlinks", folder.parent_path() / "cli" / "behaviourlinks"})
    if (fs::exists(place, error)) return place.string();
  return "";
}

Result<std::unique_ptr<ServerProcess>> ServerProcess::start(const std::string& program, const std::vector<std::string>& words,
                                                            Lives lives) {
  if (program.empty() || ::access(program.c_str(), X_OK) != 0)
    return Error{ErrorCode::not_found, "", "The program `behaviourlinks` is not beside the window's program. Install it again."};
  std::unique_ptr<ServerProcess> process(new ServerProcess());
  const std::string rooms = host::person_folder() + "/rooms";
  std::error_code error;
  fs::create_directories(rooms, error);
  sweep(rooms);
  std::string pattern = rooms + "/XXXXXX";
  if (::mkdtemp(pattern.data()) == nullptr)
    return Error{ErrorCode::io, rooms, std::string("no folder can be made here: ") + std::strerror(errno)};
  process->folder_ = pattern;
  process->private_file_ = pattern + kSecrets;
  const int output = new_file(pattern + kOutput), complaints = new_file(pattern + kComplaints);
  const int secrets = new_file(process->private_file_), nothing = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  std::vector<std::string> all{program};
  for (const std::string& word : words) all.push_back(word == kPrivateFile ? process->private_file_ : word);
  std::vector<char*> arguments;
  for (std::string& word : all) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const bool is_ready = output >= 0 && complaints >= 0 && secrets >= 0 && nothing >= 0;
  process->number_ = is_ready ? ::fork() : -1;
  if (process->number_ == 0) become(program.c_str(), arguments.data(), output, complaints, nothing, lives == Lives::on);
  for (const int file : {output, complaints, secrets, nothing})
    if (file >= 0) ::close(file);
  if (process->number_ < 0) return Error{ErrorCode::io, program, std::string("cannot be started: ") + std::strerror(errno)};
  (void)write_file(pattern + "/" + kNumber, std::to_string(process->number_) + "\n");  // without it the folder stays
  return process;
}

ServerProcess::~ServerProcess() {
  std::error_code ignored;
  if (number_ < 0 || exit_code()) fs::remove_all(folder_, ignored);
  else fs::remove(private_file_, ignored);
}

std::string ServerProcess::output() const { return text_of_file(folder_ + kOutput); }

std::string ServerProcess::complaints() const { return without_name(text_of_file(folder_ + kComplaints)); }

std::optional<int> ServerProcess::exit_code() {
  int status = 0;
  if (code_ || number_ < 0 || ::waitpid(number_, &status, WNOHANG) != number_) return code_;
  code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return code_;
}

void ServerProcess::interrupt() {
  if (!exit_code()) ::kill(number_, SIGINT);
}

}  // namespace bl::desktop
