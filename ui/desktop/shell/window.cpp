// GLFW, ImGui's backends and the loop: one frame at the display's rate, whatever the simulation does.
#include "ui/desktop/shell/window.h"

#include <chrono>
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

#include "core/base/printable.h"
#include "core/file/file_io.h"
#include "core/session/types/plugins.h"
#include "ui/desktop/shell/desktop.h"
#include "ui/desktop/shell/input_queue.h"
#include "ui/desktop/shell/live_scene.h"
#include "ui/desktop/view/gl_renderer.h"

namespace bl::desktop {

namespace {

constexpr int kDone = 0, kBadInput = 2;
// A window that nobody looks at draws seldom.
constexpr double kIdleFrame = 0.25;

struct FrameTimes {
  std::vector<double> milliseconds;
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
void wait_for_next_frame(double begin) {
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  const GLFWvidmode* mode = monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr;
  const double frame = 1.0 / (mode != nullptr && mode->refreshRate > 20 ? mode->refreshRate : 60);
  const double rest = 0.9 * frame - (glfwGetTime() - begin);
  if (rest > 0.001) glfwWaitEventsTimeout(rest);
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
  InputQueue input;
};
CallbackTarget& hands_of(GLFWwindow* window) { return *static_cast<CallbackTarget*>(glfwGetWindowUserPointer(window)); }

void listen(GLFWwindow* window, CallbackTarget& hands) {
  glfwSetWindowUserPointer(window, &hands);
  glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** paths) {
    if (count > 0) hands_of(w).desktop.drop(std::vector<std::string>(paths, paths + count));
  });
  glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int) {
    if (action != GLFW_REPEAT) hands_of(w).input.key(key, action == GLFW_PRESS);
  });
  glfwSetCharCallback(window, [](GLFWwindow* w, unsigned int letter) { hands_of(w).input.text(letter); });
  glfwSetMouseButtonCallback(
      window, [](GLFWwindow* w, int button, int action, int) { hands_of(w).input.button(button, action == GLFW_PRESS); });
  glfwSetScrollCallback(window, [](GLFWwindow* w, double x, double y) {
    hands_of(w).input.wheel({static_cast<float>(x), static_cast<float>(y)});
  });
  glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) {
    hands_of(w).input.move({static_cast<float>(x), static_cast<float>(y)});
  });
  glfwSetCursorEnterCallback(window, [](GLFWwindow* w, int has_entered) {
    if (has_entered == GLFW_FALSE) hands_of(w).input.leave();
  });
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
}

void write_times(const std::string& path, const FrameTimes& times) {
  if (path.empty()) return;
  std::string text = "frame_ms\n";
  for (const double ms : times.milliseconds) text += std::to_string(ms) + "\n";
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
    CallbackTarget hands{desktop, {}};
    LiveScene live(editor, options.is_live);
    listen(window.handle(), hands);
    Look look;
    if (!options.scene.empty()) editor.open(options.scene, options.is_playing);
    desktop.offer_recovery();
    std::string title;
    while (!editor.wants_quit) {
      glfwPollEvents();
      if (glfwGetWindowAttrib(window.handle(), GLFW_ICONIFIED) != 0) glfwWaitEventsTimeout(kIdleFrame);
      if (glfwWindowShouldClose(window.handle()) != 0) {
        glfwSetWindowShouldClose(window.handle(), GLFW_FALSE);
        desktop.ask_to_quit();
      }
      const double begin = glfwGetTime();
      if (options.seconds > 0 && begin > options.seconds) break;
      look.follow(editor);
      draw_frame(window.handle(), hands, begin);
      live.frame();
      if (!options.times.empty()) times.milliseconds.push_back(1000 * (glfwGetTime() - begin));
      if (editor.wants_picture) take_picture(editor, options.pictures, window.handle());
      editor.wants_picture = false;
      glfwSwapBuffers(window.handle());
      if (std::string now_title = desktop.title(); now_title != title) {
        title = std::move(now_title);
        glfwSetWindowTitle(window.handle(), title.c_str());
      }
      wait_for_next_frame(begin);
    }
    glfwGetWindowSize(window.handle(), &person.width, &person.height);
  }
  (void)write_person_settings(person);  // a settings file that cannot be written is no reason to fail at the end
  write_times(options.times, times);
  return kDone;
}

}  // namespace bl::desktop
