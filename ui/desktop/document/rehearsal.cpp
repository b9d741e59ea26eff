// Two processes, one after the other: the server of the room as in a session, and the bots of `behaviourlinks rehearse`.
#include "ui/desktop/document/rehearsal.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <thread>

#include "core/base/text.h"

namespace bl::desktop {

namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr std::string_view kFolder = ".rehearsal_", kProgress = "progress: ";

// Processes have their numbers on one computer, and the folder may be shared with others.
std::string beginning_of_folders() {
  char host[256] = {};
  (void)::gethostname(host, sizeof host - 1);
  return std::string(kFolder) + host + "_";
}

// Folders of windows that have crashed in a rehearsal; the number of the process stands in the name.
void sweep_rehearsals(const fs::path& place) {
  const std::string begin = beginning_of_folders();
  std::error_code error;
  std::vector<fs::path> gone;
  for (const auto& one : fs::directory_iterator(place, error)) {
    const std::string name = one.path().filename().string();
    if (!name.starts_with(begin)) continue;
    pid_t number = 0;
    const auto [end, fault] = std::from_chars(name.data() + begin.size(), name.data() + name.size(), number);
    const bool is_ours = fault == std::errc() && number > 0 && *end == '_';
    if (is_ours && ::kill(number, 0) != 0 && errno == ESRCH) gone.push_back(one.path());
  }
  for (const fs::path& one : gone) fs::remove_all(one, error);
}

// `http://127.0.0.1:45123/BKRT`, with the key of whoever leads.
std::string address_of_lead(const Hosting& room) {
  const auto key = room.keys().find("facilitator");
  return room.page() + "#k=" + (key == room.keys().end() ? "" : key->second);
}

}  // namespace

Result<std::unique_ptr<RehearsalRun>> RehearsalRun::begin(const std::string& program, const HostingPlan& plan,
                                                          const RehearsalSize& size) {
  std::error_code error;
  const fs::path place = fs::absolute(plan.journal, error).parent_path();
  sweep_rehearsals(place);
  std::string pattern = (place / (beginning_of_folders() + std::to_string(::getpid()) + "_XXXXXX")).string();
  if (::mkdtemp(pattern.data()) == nullptr)
    return Error{ErrorCode::io, place.string(), std::string("no folder can be made here: ") + std::strerror(errno)};
  std::unique_ptr<RehearsalRun> run(new RehearsalRun());
  run->folder_ = pattern;
  run->program_ = program;
  run->size_ = size;
  HostingPlan own;
  own.scene = plan.scene;
  own.journal = pattern + "/rehearsal.blsession";
  own.bind = "127.0.0.1";
  own.port = "0";  // any free one
  own.scripts = plan.scripts;
  auto room = Hosting::begin(program, std::move(own), ServerProcess::Lives::with_this_one);
  if (!room) return room.error();
  run->room_ = std::move(*room);
  return run;
}

RehearsalRun::~RehearsalRun() {
  if (stage_ != Stage::ended) cancel();
  const auto wait = [&](std::chrono::milliseconds patience) {
    const auto end = std::chrono::steady_clock::now() + patience;
    while (room_ && turn() != Stage::ended && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(10ms);
  };
  wait(2s);
  // Nothing of a rehearsal is worth waiting for longer, and nobody may write into a folder that is removed.
  if (room_ && stage_ != Stage::ended) {
    ::kill(room_->number(), SIGKILL);
    if (bots_ && !bots_->exit_code()) ::kill(bots_->number(), SIGKILL);
    wait(2s);
  }
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

void RehearsalRun::begin_bots() {
  auto bots = ServerProcess::start(program_,
                                   {"rehearse", address_of_lead(*room_), "--bots", std::to_string(size_.bots), "--seconds",
                                    shortest(size_.seconds), "--progress"},
                                   ServerProcess::Lives::with_this_one);
  if (!bots) {
    why_ = bots.error().text();
    return close();
  }
  bots_ = std::move(*bots);
  stage_ = Stage::running;
  progress_ = "The bots come in.";
}

// The last whole line of `progress: 12 of 30 s, 200 operations, ...`.
void RehearsalRun::read_progress() {
  const std::size_t begin = output_.rfind(kProgress), end = output_.find('\n', begin);
  if (begin == std::string::npos || end == std::string::npos) return;
  progress_ = output_.substr(begin + kProgress.size(), end - begin - kProgress.size());
  double seconds = 0;
  const auto [stop, fault] = std::from_chars(progress_.data(), progress_.data() + progress_.size(), seconds);
  if (fault == std::errc()) part_ = std::clamp(seconds / size_.seconds, 0.0, 1.0);
}

void RehearsalRun::close() {
  stage_ = Stage::closing;
  progress_ = "The room of the rehearsal is closed.";
  if (room_) room_->end();
}

void RehearsalRun::cancel() {
  is_cancelled_ = true;
  if (bots_) bots_->interrupt();
  if (stage_ != Stage::ended) close();
}

RehearsalRun::Stage RehearsalRun::turn() {
  if (stage_ == Stage::ended) return stage_;
  const Hosting::Stage room = room_->turn();
  if (stage_ == Stage::opening && room == Hosting::Stage::open) begin_bots();
  if (stage_ == Stage::running) {
    const bool is_over = bots_->exit_code().has_value();  // looked at first: what it has written is whole then
    output_ = bots_->output();
    read_progress();
    if (is_over) close();
  }
  const bool has_bots = bots_ && !bots_->exit_code();
  if (room == Hosting::Stage::ended && has_bots && !is_cancelled_) bots_->interrupt();
  if (room != Hosting::Stage::ended || has_bots) return stage_;
  if (stage_ != Stage::closing) why_ = "The server of the rehearsal has ended: " + room_->why();
  stage_ = Stage::ended;
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
  return stage_;
}

}  // namespace bl::desktop
