// GLFW, ImGui's backends and the loop: frames at the display's rate while there is something to draw, and none while there is
// not.
#include "ui/desktop/shell/window.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <new>
#include <vector>

#include <epoxy/gl.h>

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>
#include <stb_image_write.h>

#include "core/base/hash.h"
#include "core/base/printable.h"
#include "core/file/file_io.h"
#include "core/guest/room_guest.h"
#include "core/session/types/plugins.h"
#include "ui/desktop/shell/desktop.h"
#include "ui/desktop/shell/frame_watch.h"
#include "ui/desktop/shell/input_queue.h"
#include "ui/desktop/shell/live_scene.h"
#include "ui/desktop/view/gl_renderer.h"

namespace bl::desktop {

namespace {

constexpr int kDone = 0, kBadInput = 2;
// A window that nobody looks at draws seldom.
constexpr double kIdleFrame = 0.25;
constexpr double kShortestRest = 0.001;  // [s]

struct FrameTimes {
  struct Frame {
    double milliseconds, begin;
  };
  std::vector<Frame> frames;
};

// Writes what the window shows as a numbered PNG; where to, or why not, becomes a notice.
void take_picture(Editor& editor, const std::string& wanted_folder, GLFWwindow* window) {
  int width = 0, height = 0;
  glfwGetFramebufferSize(window, &width, &height);
  const std::string folder = !wanted_folder.empty() ? wanted_folder : host::person_folder() + "/pictures";
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  std::string path;
  for (int k = 1; path.empty() || std::filesystem::exists(path, error); ++k)
    path = folder + "/picture-" + (k < 10 ? "0" : "") + std::to_string(k) + ".png";
  std::vector<unsigned char> pixels(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
  for (std::size_t k = 3; k < pixels.size(); k += 4) pixels[k] = 255;
  stbi_flip_vertically_on_write(1);
  if (stbi_write_png(path.c_str(), width, height, 4, pixels.data(), 4 * width) != 0)
    editor.notify(NoticeKind::told, "Took the picture " + path + ".");
  else editor.notify(NoticeKind::error, "The picture " + path + " could not be written.");
}

// Without a display that paces the frames, the loop does it itself; an event ends the wait.
void wait_for_next_frame(GLFWwindow* window, double begin) {
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  const GLFWvidmode* mode = monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr;
  const double frame = 1.0 / (mode != nullptr && mode->refreshRate > 20 ? mode->refreshRate : 60);
  const bool is_seen = glfwGetWindowAttrib(window, GLFW_ICONIFIED) == 0;
  const double left = (is_seen ? 0.9 * frame : kIdleFrame) - (glfwGetTime() - begin);
  if (left > kShortestRest) glfwWaitEventsTimeout(left);
}

// Until somebody does something, another moment is there, or it is time to look again.
void rest(FrameWatch& watch, double end) {
  (void)watch.wait([&] {
    const double until = std::min(watch.next_look(), end);
    if (until == kNoFrame) glfwWaitEvents();
    else glfwWaitEventsTimeout(std::max(kShortestRest, until - glfwGetTime()));
  });
}

// What the screen has for windows; nothing known where there is no monitor.
Extent work_area() {
  Extent area;
  int x = 0, y = 0;
  if (GLFWmonitor* monitor = glfwGetPrimaryMonitor()) glfwGetMonitorWorkarea(monitor, &x, &y, &area.width, &area.height);
  return area;
}

void complain(const std::string& text) { std::fprintf(stderr, "behaviourlinks: %s\n", printable(text).c_str()); }

class Window {
 public:
  ~Window() {
    if (has_backends_) {
      ImGui_ImplOpenGL3_Shutdown();
      ImGui_ImplGlfw_Shutdown();
    }
    if (ImGui::GetCurrentContext() != nullptr) ImGui::DestroyContext();
    if (window_ != nullptr) glfwDestroyWindow(window_);
    glfwTerminate();
  }

  bool open(PersonSettings& person) {
    glfwSetErrorCallback([](int, const char* text) { last_error = text; });
    if (glfwInit() == GLFW_FALSE) {
      complain("no display was found to open a window on: " + last_error);
      return false;
    }
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    const Extent extent = fitting_window({person.width, person.height}, work_area());
    window_ = glfwCreateWindow(extent.width, extent.height, "BehaviourLinks", nullptr, nullptr);
    if (window_ == nullptr) {
      complain("this computer's graphics are too old, or have no driver: OpenGL 3.3 is needed (" + last_error +
               "). The scene can be run and reported without a window: behaviourlinks run SCENE --report DIR");
      return false;
    }
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
    IMGUI_CHECKVERSION();
    // Memory that runs out in a list of what is drawn ends in a sentence too, not in a pointer to nothing.
    ImGui::SetAllocatorFunctions([](std::size_t size, void*) { return ::operator new(size); },
                                 [](void* block, void*) { ::operator delete(block); });
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    ImGui_ImplGlfw_InitForOpenGL(window_, false);
    ImGui_ImplOpenGL3_Init("#version 330 core");
    has_backends_ = true;
    return true;
  }

  GLFWwindow* handle() { return window_; }

 private:
  inline static std::string last_error;
  GLFWwindow* window_ = nullptr;
  bool has_backends_ = false;
};

// What the window's callbacks reach.
struct CallbackTarget {
  Desktop& desktop;
  FrameWatch& watch;
  InputQueue input;
};
CallbackTarget& hands_of(GLFWwindow* window) { return *static_cast<CallbackTarget*>(glfwGetWindowUserPointer(window)); }
InputQueue& input_of(GLFWwindow* window) {
  hands_of(window).watch.touch();
  return hands_of(window).input;
}

void listen(GLFWwindow* window, CallbackTarget& hands) {
  glfwSetWindowUserPointer(window, &hands);
  glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** paths) {
    hands_of(w).watch.touch();
    if (count > 0) hands_of(w).desktop.drop(std::vector<std::string>(paths, paths + count));
  });
  glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int) {
    if (action != GLFW_REPEAT) input_of(w).key(key, action == GLFW_PRESS);
  });
  glfwSetCharCallback(window, [](GLFWwindow* w, unsigned int letter) { input_of(w).text(letter); });
  glfwSetMouseButtonCallback(
      window, [](GLFWwindow* w, int button, int action, int) { input_of(w).button(button, action == GLFW_PRESS); });
  glfwSetScrollCallback(window, [](GLFWwindow* w, double x, double y) {
    input_of(w).wheel({static_cast<float>(x), static_cast<float>(y)});
  });
  glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) {
    input_of(w).move({static_cast<float>(x), static_cast<float>(y)});
  });
  glfwSetCursorEnterCallback(window, [](GLFWwindow* w, int has_entered) {
    if (has_entered == GLFW_FALSE) input_of(w).leave();
  });
}

// What has to be drawn anew though nobody has touched keys or mouse.
void listen_to_screen(GLFWwindow* window) {
  glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) { hands_of(w).watch.touch(); });
  glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) { hands_of(w).watch.touch(); });
  glfwSetWindowContentScaleCallback(window, [](GLFWwindow* w, float, float) { hands_of(w).watch.touch(); });
  glfwSetWindowFocusCallback(window, [](GLFWwindow* w, int) { hands_of(w).watch.touch(); });
  glfwSetWindowIconifyCallback(window, [](GLFWwindow* w, int) { hands_of(w).watch.touch(); });
  glfwSetWindowCloseCallback(window, [](GLFWwindow* w) { hands_of(w).watch.touch(); });
}

// Fonts and colours as the person has chosen them, made anew only where that has changed.
class Look {
 public:
  void follow(Editor& editor) {
    const PersonSettings& person = editor.person;
    if (scale_ == person.scale && is_dark_ == person.is_dark) return;
    if (scale_ != person.scale) {
      if (const std::string note = editor.theme.load_fonts(person.scale); !note.empty()) editor.notify(NoticeKind::warning, note);
      // The first letters go to the graphics processor with all else; later ones take their place.
      if (scale_ != 0) ImGui_ImplOpenGL3_DestroyFontsTexture(), ImGui_ImplOpenGL3_CreateFontsTexture();
    }
    editor.theme.apply(person.is_dark, person.scale);
    scale_ = person.scale;
    is_dark_ = person.is_dark;
  }

 private:
  bool is_dark_ = false;
  float scale_ = 0;  // none yet
};

// From what people have done since the last frame to the picture behind the screen.
void draw_frame(GLFWwindow* window, CallbackTarget& hands, double begin) {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  hands.input.hand_over(ImGui::GetIO());
  ImGui::NewFrame();
  hands.desktop.frame(begin);
  ImGui::Render();
  int width = 0, height = 0;
  glfwGetFramebufferSize(window, &width, &height);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glViewport(0, 0, width, height);
  glClearColor(0, 0, 0, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  hands.watch.drawn(begin);
  // What one frame could not tell apart waits for the next one.
  if (!hands.input.is_empty()) hands.watch.touch();
}

void write_times(const std::string& path, const FrameTimes& times) {
  if (path.empty()) return;
  std::string text = "frame_ms,begin_s\n";
  for (const FrameTimes::Frame& frame : times.frames)
    text += std::to_string(frame.milliseconds) + "," + std::to_string(frame.begin) + "\n";
  if (auto written = write_file(path, text); !written) complain(written.error().text());
}

// Whether this window took the same ticks as its room.
void write_room_report(const std::string& path, Editor& editor) {
  const guest::RoomGuest* room = editor.document ? editor.document->room() : nullptr;
  if (room == nullptr) return;
  const auto moment = room->moment();
  const guest::Standing standing = room->standing();
  const std::string text = "tick,hash,entry,agreed,differed,waiting,role\n" + std::to_string(moment->ticked->tick) + "," +
                           hex_digits(moment->ticked->hash) + "," + std::to_string(room->fold().seq()) + "," +
                           std::to_string(room->agreed()) + "," + std::to_string(room->differed()) + "," +
                           std::to_string(standing.waiting) + "," + room->role() + "\n";
  if (auto written = write_file(path, text); !written) complain(written.error().text());
}

}  // namespace

int run_window(const WindowOptions& options) noexcept {
  use_plugins(options.plugins);
  for (const PluginReport& report : plugin_reports())
    if (report.error) complain(report.error->text());
  PersonSettings person = read_person_settings(host::person_folder().empty() ? "" : host::person_folder() + "/desktop.json");
  Window window;
  if (!window.open(person)) return kBadInput;
  std::string failure;
  const std::unique_ptr<Renderer> renderer = GlRenderer::make(failure);
  if (!renderer) {
    complain(failure);
    return kBadInput;
  }
  FrameTimes times;
  {
    Desktop desktop(full_registry(), person, *renderer);
    Editor& editor = desktop.editor();
    FrameWatch watch(desktop, glfwPostEmptyEvent);
    CallbackTarget hands{desktop, watch, {}};
    LiveScene live(editor, options.is_live);
    listen(window.handle(), hands);
    listen_to_screen(window.handle());
    Look look;
    if (!options.scene.empty()) editor.open(options.scene, options.is_playing);
    desktop.offer_recovery();
    std::string title;
    const double end = options.seconds > 0 ? options.seconds : kNoFrame;
    while (!editor.wants_quit) {
      glfwPollEvents();
      if (glfwWindowShouldClose(window.handle()) != 0) {
        glfwSetWindowShouldClose(window.handle(), GLFW_FALSE);
        desktop.ask_to_quit();
      }
      const double begin = glfwGetTime();
      if (begin > end) break;
      if (!watch.is_due(begin)) {
        rest(watch, end);
        continue;
      }
      look.follow(editor);
      draw_frame(window.handle(), hands, begin);
      live.frame();
      if (!options.times.empty()) times.frames.push_back({1000 * (glfwGetTime() - begin), begin});
      if (editor.wants_picture) take_picture(editor, options.pictures, window.handle());
      editor.wants_picture = false;
      glfwSwapBuffers(window.handle());
      if (std::string now_title = desktop.title(); now_title != title) {
        title = std::move(now_title);
        glfwSetWindowTitle(window.handle(), title.c_str());
      }
      wait_for_next_frame(window.handle(), begin);
    }
    if (!options.room_report.empty()) write_room_report(options.room_report, editor);
    glfwGetWindowSize(window.handle(), &person.width, &person.height);
  }
  (void)write_person_settings(person);  // a settings file that cannot be written is no reason to fail at the end
  write_times(options.times, times);
  return kDone;
}

}  // namespace bl::desktop
