// Feeds ImGui's input by hand.
#include "tests/ui/desktop/null_desktop.h"
#include "tests/support/place/source_folder.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include "ui/desktop/panels/statistics_record.h"

namespace bl::desktop {

namespace {

constexpr double kFrame = 1.0 / 60;

}  // namespace

NullDesktop::NullDesktop(const std::string& scene, ImVec2 size) {
  // Journals of tests stay away from the person's own.
  const std::string state = ::testing::TempDir() + "behaviourlinks_desktop_tests_" + std::to_string(getpid());
  setenv("XDG_STATE_HOME", state.c_str(), 1);
  context_ = ImGui::CreateContext();
  ImGui::SetCurrentContext(context_);
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;  // as the real window has: large canvases need it
  io.DisplaySize = size;
  io.DeltaTime = static_cast<float>(kFrame);
  io.MousePos = {-1, -1};
  // The key map of the real window's backend.
  const std::pair<int, int> kKeys[] = {{ImGuiKey_Tab, GLFW_KEY_TAB},
                                       {ImGuiKey_LeftArrow, GLFW_KEY_LEFT},
                                       {ImGuiKey_RightArrow, GLFW_KEY_RIGHT},
                                       {ImGuiKey_UpArrow, GLFW_KEY_UP},
                                       {ImGuiKey_DownArrow, GLFW_KEY_DOWN},
                                       {ImGuiKey_Home, GLFW_KEY_HOME},
                                       {ImGuiKey_End, GLFW_KEY_END},
                                       {ImGuiKey_Delete, GLFW_KEY_DELETE},
                                       {ImGuiKey_Backspace, GLFW_KEY_BACKSPACE},
                                       {ImGuiKey_Enter, GLFW_KEY_ENTER},
                                       {ImGuiKey_Escape, GLFW_KEY_ESCAPE},
                                       {ImGuiKey_Space, GLFW_KEY_SPACE},
                                       {ImGuiKey_A, GLFW_KEY_A},
                                       {ImGuiKey_C, GLFW_KEY_C},
                                       {ImGuiKey_V, GLFW_KEY_V},
                                       {ImGuiKey_X, GLFW_KEY_X},
                                       {ImGuiKey_Y, GLFW_KEY_Y},
                                       {ImGuiKey_Z, GLFW_KEY_Z}};
  for (const auto& [ours, native] : kKeys) io.KeyMap[ours] = native;
  desktop_ = std::make_unique<Desktop>(full_registry(), person_, renderer_);
  (void)editor().theme.load_fonts(1);
  unsigned char* pixels = nullptr;
  int width = 0, height = 0;
  io.Fonts->GetTexDataAsAlpha8(&pixels, &width, &height);
  editor().theme.apply(true, 1);
  if (!scene.empty() && !editor().open(test::source_folder() + "/" + scene)) ADD_FAILURE() << scene << " does not open";
  frames(2);
}

NullDesktop::~NullDesktop() {
  desktop_.reset();
  ImGui::DestroyContext(context_);
}

void NullDesktop::frames(int count) {
  for (int k = 0; k < count; ++k) frame_at(now_ + kFrame);
}

void NullDesktop::frame_at(double now) {
  ImGui::SetCurrentContext(context_);  // a test may have two desktops
  ImGui::GetIO().DeltaTime = static_cast<float>(std::max(kFrame, now - now_));
  now_ = now;
  // What the other thread shows of people's changes is there before each frame: tests are the same every time.
  host::LiveSession* session = editor().document ? editor().document->local() : nullptr;
  if (session != nullptr && !session->moment()->is_playing) session->settle();
  ImGui::NewFrame();
  desktop_->frame(now_);
  ImGui::Render();
  ImGui::GetIO().MouseWheel = 0;
}

void NullDesktop::ticks(int count) {
  editor().document->session().step(count);
  editor().document->session().settle();
  frames(1);
  // Lists of large scenes follow a moment later.
  if (const double pause = figures_pause(editor().state().nodes.size()); pause > 0) frame_at(now_ + 2 * pause);
}

void NullDesktop::move_to(ImVec2 at) {
  ImGui::GetIO().MousePos = at;
  frames(2);
}

void NullDesktop::press(int button) {
  ImGui::GetIO().MouseDown[button] = true;
  frames(1);
}

void NullDesktop::release(int button) {
  ImGui::GetIO().MouseDown[button] = false;
  frames(2);
}

void NullDesktop::click(ImVec2 at, int button) {
  move_to(at);
  press(button);
  release(button);
}

void NullDesktop::double_click(ImVec2 at) {
  click(at);
  press();
  release();
}

void NullDesktop::drag(ImVec2 from, ImVec2 to, int button, int steps) {
  move_to(from);
  press(button);
  for (int k = 1; k <= steps; ++k) {
    const float t = static_cast<float>(k) / static_cast<float>(steps);
    ImGui::GetIO().MousePos = {from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)};
    frames(1);
  }
  release(button);
}

void NullDesktop::wheel(float steps) {
  ImGui::GetIO().MouseWheel = steps;
  frames(2);
}

void NullDesktop::hold(bool ctrl, bool shift, bool alt) {
  ImGuiIO& io = ImGui::GetIO();
  io.KeyCtrl = ctrl;
  io.KeyShift = shift;
  io.KeyAlt = alt;
}

void NullDesktop::key(int key, bool ctrl, bool shift, bool alt) {
  hold(ctrl, shift, alt);
  ImGui::GetIO().KeysDown[key] = true;
  frames(1);
  ImGui::GetIO().KeysDown[key] = false;
  frames(1);
  hold(false, false);
}

void NullDesktop::type(std::string_view text) {
  for (const char c : text) {
    ImGui::GetIO().AddInputCharacter(static_cast<unsigned char>(c));
    frames(1);
  }
}

std::string NullDesktop::logic_text() {
  Scene scene = editor().scene();
  scene.view.clear();
  return write_scene(scene, full_registry());
}

std::string NullDesktop::scene_text() { return write_scene(editor().scene(), full_registry()); }

}  // namespace bl::desktop
