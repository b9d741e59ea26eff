// Windows in a room of a real server, without a screen: how tests open them, wait for them, and press what they show.
#pragma once

#include <algorithm>
#include <chrono>
#include <initializer_list>
#include <memory>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "core/guest/room_guest.h"
#include "tests/core/serve/running_server.h"
#include "tests/support/deadline.h"
#include "tests/ui/desktop/null_desktop.h"
#include "ui/desktop/panels/panel_memory.h"
#include "ui/desktop/panels/room_agenda.h"
#include "ui/desktop/panels/scene_view.h"

namespace bl::desktop {

inline std::string address_of(const serve::RunningServer& server, const std::string& role) {
  return "room://127.0.0.1:" + std::to_string(server.port()) + "/BKRT#k=" + server.invite(role);
}

inline guest::RoomGuest& room_of(NullDesktop& desktop) { return *desktop.editor().document->room(); }

// Two windows on one thread: each has a context of Dear ImGui, and the one that draws makes its own the present one.
class RoomWindow {
 public:
  explicit RoomWindow(const std::string& address, ImVec2 size = {1440, 900}) {
    desktop_ = std::make_unique<NullDesktop>("", size);
    context_ = ImGui::GetCurrentContext();
    EXPECT_TRUE(desktop_->editor().open(address));
  }
  ~RoomWindow() {
    ImGui::SetCurrentContext(context_);
    desktop_.reset();
  }
  NullDesktop& operator*() {
    ImGui::SetCurrentContext(context_);
    return *desktop_;
  }
  NullDesktop* operator->() { return &**this; }
  Workbench& editor() { return desktop_->editor(); }
  guest::RoomGuest& room() { return room_of(*desktop_); }

 private:
  std::unique_ptr<NullDesktop> desktop_;
  ImGuiContext* context_ = nullptr;
};

template <class IsOver>
bool frames_until(std::initializer_list<RoomWindow*> windows, const IsOver& is_over) {
  // Far more than a fast machine needs: rooms take ten ticks a second, whoever else wants the processor.
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(2);
  while (std::chrono::steady_clock::now() < end) {
    for (RoomWindow* window : windows) (*window)->frames(1);
    if (is_over()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

inline bool has_notice(Workbench& editor, const std::string& part) {
  return std::any_of(editor.notices.begin(), editor.notices.end(),
                     [&](const Notice& notice) { return notice.text.find(part) != std::string::npos; });
}

inline std::string notices_of(Workbench& editor) {
  std::string all;
  for (const Notice& notice : editor.notices) all += notice.text + "\n";
  return all;
}

inline void open_tab(RoomWindow& window) {
  memory_of(window.editor()).wanted_tab = "Room";
  window->frames(3);
}

inline bool has_place(RoomWindow& window, const std::string& key) { return memory_of(window.editor()).places.contains(key); }

inline void press(RoomWindow& window, const std::string& key) {
  NullDesktop& desktop = *window;
  desktop.frames(2);
  ASSERT_TRUE(has_place(window, key)) << key;
  const ImVec4 place = memory_of(window.editor()).places.at(key);
  desktop.click({(place.x + place.z) / 2, (place.y + place.w) / 2});
}

}  // namespace bl::desktop
