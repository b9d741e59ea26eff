// A rehearsal of a session: a room of its own beside the window, bots in it, and nothing left of either.
#pragma once

#include <memory>
#include <string>

#include "core/base/result.h"
#include "ui/desktop/document/hosting.h"

namespace bl::desktop {

struct RehearsalSize {
  int bots = 20;
  double seconds = 30;
};

class RehearsalRun {
 public:
  enum class Stage { opening, running, closing, ended };

  /// Of the scene of that plan, in a folder beside its session file: the disk is that of the session. The session file itself is
  /// neither read nor written; no sensor and no actuator is connected, and only this computer can open the room.
  static Result<std::unique_ptr<RehearsalRun>> begin(const std::string& program, const HostingPlan& plan,
                                                     const RehearsalSize& size);
  /// Ends what is under way, and waits for it: mostly a few tenths of a second, and never more than four.
  ~RehearsalRun();
  RehearsalRun(const RehearsalRun&) = delete;
  RehearsalRun& operator=(const RehearsalRun&) = delete;

  /// Looks how far it is. Call it in each frame. Once it has ended, its folder is gone.
  Stage turn();
  Stage stage() const { return stage_; }
  /// Ends it before its time: there will be no result.
  void cancel();
  bool is_cancelled() const { return is_cancelled_; }
  /// How much of its time is over, 0 to 1.
  double part() const { return part_; }
  /// What is said of it meanwhile, such as "12 of 30 s, 200 operations, 0 without an answer".
  const std::string& progress() const { return progress_; }
  /// Everything that the bots' program has written; its last lines are findings.
  const std::string& output() const { return output_; }
  /// Why there is no result, in words for people; empty where there is one.
  const std::string& why() const { return why_; }
  const std::string& folder() const { return folder_; }

 private:
  RehearsalRun() = default;
  void begin_bots();
  void read_progress();
  void close();

  std::string program_, folder_, progress_, output_, why_;
  RehearsalSize size_;
  std::unique_ptr<Hosting> room_;
  std::unique_ptr<ServerProcess> bots_;
  Stage stage_ = Stage::opening;
  double part_ = 0;
  bool is_cancelled_ = false;
};

}  // namespace bl::desktop
