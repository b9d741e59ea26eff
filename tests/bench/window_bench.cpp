// The program `behaviourlinks-window-bench`: the window's own work for each frame, without a window and without a graphics
// driver.
#include <ctime>

#include <algorithm>
#include <cmath>
#include <memory>

#include <imgui.h>
#include <nlohmann/json.hpp>

#include "core/base/hash.h"
#include "core/base/median.h"
#include "core/base/text.h"
#include "core/file/file_io.h"
#include "tests/bench/bench_tools.h"
#include "tests/bench/random_scene.h"
#include "ui/cli/commands.h"
#include "ui/cli/file_rule.h"
#include "ui/cli/interrupt.h"
#include "ui/cli/program.h"
#include "ui/cli/terminal.h"
#include "ui/desktop/panels/scene_view.h"
#include "ui/desktop/shell/desktop.h"
#include "ui/desktop/view/renderer.h"

namespace bl::cli::bench {

namespace {

constexpr double kFill = 0.7, kFrame = 1.0 / 60, kDragStep = 0.2, kTurn = 0.01;  // [-], [s], [m], [radians]
constexpr int kMostTicksToRest = 40, kWarmUp = 4;

struct WindowBenchOptions {
  std::vector<int> sites = {1000, 10000};
  int frames = 60;
  std::string json;
};

// What the driver and the graphics processor would do is left out; what is handed to them is made.
class NoDriver final : public desktop::Renderer {
 public:
  std::uintptr_t draw(const desktop::ViewScene&, int, int) override { return 0; }
  std::uint64_t take_bytes_sent() override { return 0; }
  std::string description() const override { return "no driver"; }
};

double thread_time() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// The window's panels on a screen that nobody sees, with a scene of random volumes.
class BenchWindow {
 public:
  explicit BenchWindow(const Scene& scene) : context_(ImGui::CreateContext()) {
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;  // as the real window has
    io.DisplaySize = {1440, 900};
    io.DeltaTime = static_cast<float>(kFrame);
    io.MousePos = {-1, -1};
    desktop_ = std::make_unique<desktop::Desktop>(full_registry(), person_, renderer_);
    (void)editor().theme.load_fonts(1);
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    io.Fonts->GetTexDataAsAlpha8(&pixels, &width, &height);
    editor().theme.apply(true, 1);
    std::vector<Problem> problems;
    editor().take(
        desktop::Document::from_text(full_registry(), write_scene(scene, full_registry()), "", desktop::kTickThreads, problems));
  }
  ~BenchWindow() {
    desktop_.reset();
    ImGui::DestroyContext(context_);
  }
  BenchWindow(const BenchWindow&) = delete;
  BenchWindow& operator=(const BenchWindow&) = delete;

  desktop::Workbench& editor() { return desktop_->editor(); }
  host::LiveSession& session() { return editor().document->session(); }
  void tick() {
    session().step(1);
    session().settle();
  }
  // The processor time of the window's thread [s].
  double frame() {
    now_ += kFrame;
    const double begin = thread_time();
    ImGui::NewFrame();
    desktop_->frame(now_);
    ImGui::Render();
    return thread_time() - begin;
  }

 private:
  desktop::PersonSettings person_;
  NoDriver renderer_;
  ImGuiContext* context_;
  std::unique_ptr<desktop::Desktop> desktop_;
  double now_ = 0;
};

struct WindowCase {
  const char* name;
  std::function<void(BenchWindow&, int)> prepare;  // before each frame, not measured
};

// What is in the middle of the list: one of the volumes.
std::string dragged_volume(BenchWindow& window) {
  const auto& nodes = window.editor().scene().nodes;
  return std::next(nodes.begin(), static_cast<std::ptrdiff_t>(nodes.size() / 2))->first;
}

std::vector<WindowCase> cases_of_frames(int frames) {
  return {{"at rest, all the same", [](BenchWindow&, int) {}},
          {"camera moves",
           [](BenchWindow& window, int) {
             desktop::Camera camera = window.editor().view->camera();
             camera.azimuth += kTurn;
             window.editor().view->set_camera(camera);
           }},
          {"mouse over the volumes",
           [](BenchWindow& window, int frame) {
             const desktop::Camera camera = window.editor().view->camera();
             const desktop::Seen middle = window.editor().view->place_in_window(camera.target);
             ImGui::GetIO().MousePos = {static_cast<float>(middle.x) + static_cast<float>(frame % 60) - 30,
                                        static_cast<float>(middle.y)};
           }},
          {"one dragged", [frames, place = std::optional<Vector3>(), id = std::string()](BenchWindow& window, int frame) mutable {
             ImGui::GetIO().MousePos = {-1, -1};
             if (!place) {
               id = dragged_volume(window);
               const State& state = window.editor().state();
               place = std::get<Vector3>(state.value(*state.plan->find(state.plan->node_index(id), {"node", "position", ""})));
             }
             place->x += frame < frames / 2 ? kDragStep : -kDragStep;
             (void)window.editor().submit(
                 command<SetPort>({id, {"node.position"}, JsonValue::of(nlohmann::json::array({place->x, place->y, place->z}))}));
             window.tick();
           }}};
}

Result<void> measure(int count, bool is_standing, const WindowBenchOptions& options, Progress& progress, TextTable& table,
                     nlohmann::json& rows) {
  const auto scene = is_standing ? standing_scene(count, full_registry()) : random_scene(count, full_registry(), kFill);
  if (!scene) return scene.error();
  BenchWindow window(*scene);
  const std::string what = std::to_string(count) + (is_standing ? " that stand" : " volumes");
  for (int t = 0; t < kMostTicksToRest && !window.session().moment()->state->is_settled() && !is_interrupted(); ++t) {
    progress.show(what + ", tick " + std::to_string(t + 1));
    window.tick();
  }
  for (WindowCase& one : cases_of_frames(options.frames)) {
    progress.show(what + ", " + one.name);
    for (int k = 0; k < kWarmUp; ++k) (void)window.frame();
    std::vector<double> times;
    for (int frame = 0; frame < options.frames && !is_interrupted(); ++frame) {
      one.prepare(window, frame);
      times.push_back(window.frame());
    }
    if (times.empty()) return {};
    std::sort(times.begin(), times.end());
    const double middle = median(times), late = times[times.size() * 95 / 100];
    const std::string hash = hex_digits(window.editor().state().hash);
    table.add({what, one.name, fixed(1000 * middle, 3), fixed(1000 * late, 3), fixed(1000 * times.back(), 3), hash});
    rows.push_back({{"volumes", count},
                    {"stand", is_standing},
                    {"case", one.name},
                    {"frames", times.size()},
                    {"median_seconds", middle},
                    {"p95_seconds", late},
                    {"longest_seconds", times.back()},
                    {"hash", hash}});
  }
  return {};
}

int window_bench(const WindowBenchOptions& options) {
  catch_interrupts();
  print_line(machine_line());
  print_line("Processor time of the window's thread for each frame it draws, without the graphics driver.");
  TextTable table({{"scene"}, {"frame"}, {"median ms", true}, {"p95 ms", true}, {"longest ms", true}, {"hash", true}});
  nlohmann::json rows = nlohmann::json::array();
  {
    Progress progress;
    for (const int count : options.sites)
      for (const bool is_standing : {false, true})
        if (auto done = measure(count, is_standing, options, progress, table, rows); !done) {
          progress.clear();
          print_error("bench --window", done.error());
          return kBadInput;
        }
  }
  table.print();
  if (!options.json.empty())
    if (auto written = write_file(options.json, rows.dump(2) + "\n"); !written) {
      print_error(options.json, written.error());
      return kBadInput;
    }
  return is_interrupted() ? interrupt_exit_code() : kDone;
}

}  // namespace

}  // namespace bl::cli::bench

int main(int count, char** arguments) {
  return bl::cli::guarded([&] {
    CLI::App app{"Measures the window's own work for each frame, without a graphics driver.", "behaviourlinks-window-bench"};
    bl::cli::bench::WindowBenchOptions options;
    app.add_option("--sites", options.sites,
                   "Random volumes in a box, 70 % full, and as many that stand on half of a plot. Default: 1000 and 10000.")
        ->type_name("N")
        ->check(CLI::Range(1, 10000000));
    app.add_option("--frames", options.frames, "Frames of each row. Default: 60.")->type_name("N")->check(CLI::Range(1, 100000));
    app.add_option("--json", options.json, "Writes the rows as JSON, times in seconds.")->type_name("FILE");
    bl::cli::files_of(app).writes("--json", bl::cli::FileKind::figures);
    if (const auto code = bl::cli::refusal(app, count, arguments)) return *code;
    return bl::cli::bench::window_bench(options);
  });
}
