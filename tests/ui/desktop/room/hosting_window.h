// A window whose dialog opens and rehearses rooms by the real program, for tests.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "tests/ui/desktop/null_desktop.h"
#include "ui/desktop/panels/dialogs.h"
#include "ui/desktop/panels/host_dialog.h"
#include "ui/desktop/panels/panel_memory.h"

namespace bl::desktop {

/// The program `behaviourlinks`: build/X/ui/cli/behaviourlinks, seen from build/X/tests/ui/desktop; empty where it is not built.
inline std::string command_line_program() {
  namespace fs = std::filesystem;
  fs::path folder = fs::read_symlink("/proc/self/exe").parent_path();
  for (; folder != folder.root_path(); folder = folder.parent_path())
    if (fs::exists(folder / "ui/cli/behaviourlinks")) return (folder / "ui/cli/behaviourlinks").string();
  return "";
}

class HostingWindow : public ::testing::Test {
 protected:
  Workbench& editor() { return desktop_->editor(); }
  HostDialog& host() { return editor().dialogs->host(); }
  template <class IsOver>
  bool frames_until(const IsOver& is_over) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(2);
    while (std::chrono::steady_clock::now() < end) {
      desktop_->frames(1);
      if (is_over()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }
  bool is_drawn(const std::string& key) { return memory_of(editor()).places.contains(key); }
  /// The middle of what was drawn under this key.
  void press(const std::string& key) {
    desktop_->frames(2);
    ASSERT_TRUE(frames_until([&] { return is_drawn(key); })) << key;
    const ImVec4 place = memory_of(editor()).places.at(key);
    desktop_->click({(place.x + place.z) / 2, (place.y + place.w) / 2});
    desktop_->frames(2);
  }

  std::unique_ptr<NullDesktop> desktop_;
};

}  // namespace bl::desktop
