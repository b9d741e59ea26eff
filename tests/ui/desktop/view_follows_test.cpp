// What is drawn of a state that follows another one is what would be drawn of it by a window that has just seen it.
#include <algorithm>
#include <cstring>

#include <gtest/gtest.h>
#include <imgui_internal.h>

#include "core/base/random.h"
#include "core/reading/figures_memo.h"
#include "tests/support/random_commands.h"
#include "tests/ui/desktop/canvas_support.h"
#include "ui/desktop/panels/canvas/sections.h"
#include "ui/desktop/panels/problems_list.h"
#include "ui/desktop/panels/scene_view.h"

namespace bl::desktop {
namespace {

// Chooses and points at something else now and then.
void pick_at_random(Picks& picks, const Scene& scene, Random& random) {
  const auto some = [&](const auto& records) {
    return records.empty() ? std::string()
                           : std::next(records.begin(), static_cast<std::ptrdiff_t>(random.below(records.size())))->first;
  };
  picks.clear();
  for (auto count = random.below(4); count > 0; --count) picks.nodes.insert(some(scene.nodes));
  if (random.below(2) == 0) picks.links.insert(some(scene.links));
  picks.hovered_node = random.below(2) == 0 ? some(scene.nodes) : "";
  picks.hovered_link = random.below(3) == 0 ? some(scene.links) : "";
}

class ViewFollows : public ::testing::TestWithParam<const char*> {};

TEST_P(ViewFollows, PicturesAndColoursAreThoseMadeAnew) {
  NullDesktop desktop(GetParam());
  Workbench& editor = desktop.editor();
  Random random(11);
  std::shared_ptr<const SceneFacts> facts;
  VolumePictures kept;
  std::map<std::string, ColourMemo> memos;
  Picks picks;
  ViewVolumes before;
  std::size_t shared = 0;
  for (int step = 0; step < 60; ++step) {
    if (random.below(2) == 0) (void)editor.document->session().submit(random_command(editor.scene(), random, step));
    if (random.below(3) > 0) desktop.ticks(1);
    if (random.below(3) == 0) pick_at_random(picks, editor.scene(), random);
    for (const char* layer : {"facades", "buildings"})
      if (random.below(8) == 0) set_layer(editor.person, layer, !is_on(editor.person, layer));
    facts = read_facts(editor.moment->state, facts.get());
    Colouring colouring;
    for (const char* choice : {"error", "tension", "fill", "smart_volume.volume", "use"}) {
      colouring = memos[choice].of(facts, choice, editor.theme);
      const Colouring fresh = colour_volumes(*facts, choice, editor.theme);
      EXPECT_EQ(colouring.colours, fresh.colours) << choice;
      EXPECT_EQ(colouring.legend.title, fresh.legend.title) << choice;
      EXPECT_EQ(colouring.legend.rows.size(), fresh.legend.rows.size()) << choice;
    }
    const std::vector<ColourChoice> choices = colour_choices(*facts);
    EXPECT_TRUE(std::equal(choices.begin(), choices.end(), memos["use"].choices(*facts).begin(),
                           memos["use"].choices(*facts).end(),
                           [](const ColourChoice& a, const ColourChoice& b) { return a.id == b.id; }));
    const ViewScene followed = build_view(*facts, colouring, {}, picks, editor.person, editor.theme, &kept);
    const ViewScene fresh = build_view(*facts, colouring, {}, picks, editor.person, editor.theme);
    EXPECT_EQ(followed, fresh) << "step " << step;
    for (std::size_t k = 0; k < std::min(before.size(), followed.volumes.size()); ++k)
      shared += followed.volumes.item(k) == before.item(k) ? 1 : 0;
    before = followed.volumes;
    if (HasFailure()) return;
  }
  EXPECT_GT(shared, 0u) << "else nothing was kept";
}

// All corners and colours of a frame, window after window.
std::vector<std::uint8_t> drawn() {
  std::vector<std::uint8_t> bytes;
  const ImDrawData& data = *ImGui::GetDrawData();
  for (int list = 0; list < data.CmdListsCount; ++list) {
    const auto& corners = data.CmdLists[list]->VtxBuffer;
    const auto* begin = reinterpret_cast<const std::uint8_t*>(corners.Data);
    bytes.insert(bytes.end(), begin, begin + corners.size_in_bytes());
  }
  return bytes;
}

TEST_P(ViewFollows, AWindowThatHasSeenEverythingDrawsWhatAFreshOneDraws) {
  NullDesktop desktop(GetParam());
  Workbench& editor = desktop.editor();
  Random random(12);
  desktop.frames(3);
  for (int step = 0; step < 40; ++step) {
    if (random.below(2) == 0) (void)editor.document->session().submit(random_command(editor.scene(), random, step));
    desktop.ticks(1);
    pick_at_random(editor.picks, editor.scene(), random);
    // From far away boxes are drawn by what was noted of them, from near by the state.
    canvas::Camera& eye = editor.canvas->board().camera;
    eye.zoom_at(eye.pane().centre(), (random.below(3) > 0 ? random.uniform(0.05, 0.4) : 0.8) / eye.zoom());
    const double now = desktop.now();
    const Camera camera = editor.view->camera();
    for (int settling = 0; settling < 3; ++settling) desktop.frame_at(now);
    const std::vector<std::uint8_t> followed = drawn();
    editor.view->forget();
    editor.canvas->board().glances = {};
    desktop.frame_at(now);
    editor.view->set_camera(camera);
    for (int settling = 0; settling < 2; ++settling) desktop.frame_at(now);
    ASSERT_EQ(drawn(), followed) << "step " << step;
  }
}

// The order of the rows as well: it goes by the list before, which both have.
TEST_P(ViewFollows, AListOfProblemsThatFollowsIsThatOfOneThatForgets) {
  NullDesktop desktop(GetParam());
  Workbench& editor = desktop.editor();
  Random random(13);
  reading::FiguresMemo figures;
  ProblemList followed, forgetful;
  std::set<ProblemKind> kinds;
  for (int step = 0; step < 60; ++step) {
    if (random.below(2) == 0) (void)editor.document->session().submit(random_command(editor.scene(), random, step));
    desktop.ticks(1 + static_cast<int>(random.below(3)));
    followed.refresh(editor, figures.of(editor.moment->state));
    forgetful.forget();
    reading::ReportModel fresh;
    reading::read_figures(*editor.moment->state, fresh);
    forgetful.refresh(editor, fresh);
    ASSERT_EQ(followed.items(), forgetful.items()) << "step " << step;
    for (ProblemItem item : followed.items()) {
      kinds.insert(item.kind);
      ProblemItem other = item;
      write_problem(editor.state(), figures.last().accounts, item);
      write_problem(editor.state(), fresh.accounts, other);
      EXPECT_EQ(item, other);
    }
  }
  EXPECT_GT(kinds.size(), 2u) << "else hardly anything was compared";
}

using SparkOfSection = std::pair<std::string, std::size_t>;

// All sections that have a spark-line, with what it was made of.
std::map<SparkOfSection, canvas::Spark> sparks_of(const canvas::Board& board) {
  std::map<SparkOfSection, canvas::Spark> sparks;
  for (const canvas::NodeBox& box : board.model.boxes)
    for (std::size_t k = 0; k < box.sections.size(); ++k)
      if (box.sections[k].spark != canvas::kNoIndex) sparks[{box.id, k}] = board.live.spark(box.id, k);
  return sparks;
}

// Samples are kept where they differ; what is drawn is what somebody has who notes all of them.
TEST_P(ViewFollows, SparkLinesHaveEverySampleOfTheLastSeconds) {
  NullDesktop desktop(GetParam());
  Workbench& editor = desktop.editor();
  const canvas::Board& board = editor.canvas->board();
  std::map<SparkOfSection, canvas::Spark> noted = sparks_of(board);
  Random random(14);
  std::size_t moments = 0;
  for (int step = 0; step < 160; ++step) {
    const Scene& scene = editor.scene();
    const auto& [id, node] = *std::next(scene.nodes.begin(), static_cast<std::ptrdiff_t>(random.below(scene.nodes.size())));
    const std::string number = std::to_string(random.below(5000));
    if (random.below(8) == 0) (void)editor.submit(command<SetPort>({id, {"smart_volume.demand"}, {number}}));
    if (random.below(30) == 0) (void)editor.submit(command<RenameNode>({id, "Name " + number}));
    if (random.below(3) > 0) editor.document->session().step(1);
    editor.document->session().settle();
    desktop.frame_at(desktop.now() + random.uniform(0.02, 0.3));
    const auto sparks = sparks_of(board);
    const double now = desktop.now();
    if (sparks.empty() || sparks.begin()->second.empty() || sparks.begin()->second.back().first < now) continue;
    ++moments;
    for (const canvas::NodeBox& box : board.model.boxes)
      for (std::size_t k = 0; k < box.sections.size(); ++k) {
        if (box.sections[k].spark == canvas::kNoIndex) continue;
        canvas::Spark& samples = noted[{box.id, k}];
        samples.emplace_back(now, as_number(*canvas::value_of(editor, box, box.sections[k], box.sections[k].spark)));
        while (samples.size() > 2 && samples[1].first < now - canvas::kSparkSeconds) samples.erase(samples.begin());
      }
    ASSERT_EQ(sparks, noted) << "step " << step;
  }
  EXPECT_GT(moments, 40u) << "else nothing was compared";
}

TEST(SightBalls, BlocksHoldBackNoBallThatALineGoesThrough) {
  Random random(5);
  const auto place = [&](double size) {
    return size * Vector3{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
  };
  const Point3 away{4e5, -7e5, 120};  // as far as places of a map are
  SightBalls balls;
  balls.resize(3000);
  const auto set = [&](std::size_t row, double size) {
    balls.set(row, random.below(9) == 0 ? MeshPointer() : ball_cell(away + place(size), random.uniform(0.5, 6)));
  };
  for (std::size_t row = 0; row < balls.size(); ++row) set(row, 100);
  balls.group();
  std::size_t met = 0, looked_at = 0;
  for (int step = 0; step < 60; ++step) {
    std::vector<std::size_t> moved;
    for (auto count = random.below(step % 10 == 0 ? 3000 : 5); count > 0; --count) moved.push_back(random.below(balls.size()));
    for (const std::size_t row : moved) set(row, step < 30 ? 100 : 300);
    balls.refit(moved);
    const Vector3 along = place(1);
    const Ray ray{away + place(50), along / norm(along)};
    const auto near = balls.rows_along(ray);
    looked_at += near.size();
    for (std::uint32_t row = 0; row < balls.size(); ++row) {
      const Vector3 to = ray.origin - Point3{balls.x[row], balls.y[row], balls.z[row]};
      const double b = dot(to, ray.direction);
      if (balls.squared_radius[row] < 0 || !(b * b - squared_norm(to) + balls.squared_radius[row] >= 0)) continue;
      ++met;
      ASSERT_NE(std::find(near.begin(), near.end(), row), near.end()) << "step " << step << ", ball " << row;
    }
  }
  EXPECT_GT(met, 60u);
  EXPECT_LT(looked_at, 60 * balls.size() / 3) << "most blocks are beside the line";
}

INSTANTIATE_TEST_SUITE_P(Scenes, ViewFollows,
                         ::testing::Values("scenes/start/quarter.json", "scenes/studies/sixty_volumes.json",
                                           "scenes/studies/urban_mode.json"));

}  // namespace
}  // namespace bl::desktop
