// A room that this window has opened: a server beside it, from its start to its end.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "ui/desktop/document/phase_plan.h"
#include "ui/desktop/document/server_process.h"

namespace bl::desktop {

/// What people choose for a session.
struct HostingPlan {
  std::string scene, journal;    ///< files
  std::string bind = "0.0.0.0";  ///< the address to listen on; this one: all of them
  std::string port = "8080";     ///< as it was typed
  std::string certificate, key;  ///< PEM files; both, or neither
  std::string name;              ///< the host name for which the certificate was made
  bool is_live = false, scripts = false;
  std::map<std::string, int> people;  ///< by role: how many invitations are wanted on paper
  PhasePlan phases;
};

/// Why the room cannot be opened like this, in a sentence; empty where it can.
std::string fault_of_place(const HostingPlan& plan);
/// The words after `behaviourlinks` that open the room, or with `is_check` only look whether all is ready.
std::vector<std::string> words_of(const HostingPlan& plan, bool is_check);

class Hosting {
 public:
  enum class Stage { opening, open, ending, ended };

  static Result<std::unique_ptr<Hosting>> begin(const std::string& program, HostingPlan plan,
                                                ServerProcess::Lives lives = ServerProcess::Lives::on);
  /// A room that is not open yet is given up. An open one goes on.
  ~Hosting();
  Hosting(const Hosting&) = delete;
  Hosting& operator=(const Hosting&) = delete;

  /// Looks how far the server has come. Call it in each frame.
  Stage turn();
  Stage stage() const { return stage_; }
  /// Asks the server to end in order.
  void end();
  /// Why it did not open, or has ended by itself, in words for people.
  std::string why() const { return why_; }
  const HostingPlan& plan() const { return plan_; }
  const std::string& code() const { return code_; }
  /// By which the window joins as facilitator, with the key.
  const std::string& address() const { return address_; }
  /// By which others join, without a key.
  const std::string& page() const { return page_; }
  const std::map<std::string, std::string>& keys() const { return keys_; }  ///< by role
  pid_t number() const { return process_->number(); }
  bool has_begun_phases = false;  ///< the first phase was said

 private:
  Hosting() = default;
  void read_opening();

  HostingPlan plan_;
  std::unique_ptr<ServerProcess> process_;
  Stage stage_ = Stage::opening;
  std::string code_, address_, page_, why_;
  std::map<std::string, std::string> keys_;
};

}  // namespace bl::desktop
