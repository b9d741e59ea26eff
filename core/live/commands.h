// The commands of devices: what connections say about their sensors, with their arguments.
#pragma once

#include "core/session/commands.h"

namespace bl::live {

// Each command is declared and applied in commands/<id>.cpp, as those of core/session are.

/// What a sensor has measured, or why a message of it is no measurement. Devices submit it, so that live data stand in the log.
struct Receive {
  struct In {
    std::string node;
    double value = 0;
    std::string time, problem;
    std::int64_t tick = 0;
    bool whole = false;
  };
  static constexpr Rights kRights{.device = Ground::own};
  static void declare(CommandBuilder<Receive>& c);
  static Inverse apply(SceneEdit& edit, const In& in);
};
/// Why the device of a sensor cannot be reached; empty where it can.
struct NoteConnection {
  struct In {
    std::string node, sentence;
  };
  static constexpr Rights kRights{.device = Ground::own};
  static void declare(CommandBuilder<NoteConnection>& c);
  static Inverse apply(SceneEdit& edit, const In& in);
};

}  // namespace bl::live
