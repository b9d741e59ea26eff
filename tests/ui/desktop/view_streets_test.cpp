// Streets with bends in the 3D view: drawn, pointed at and reached along their course, also while a hand holds a junction.
#include <algorithm>
#include <cmath>

#include <GLFW/glfw3.h>

#include "core/reading/views/traffic.h"
#include "core/traffic/street_line.h"
#include "tests/ui/desktop/panels_support.h"
#include "ui/desktop/panels/scene_view.h"
#include "ui/desktop/view/urban_picture.h"

namespace bl::desktop {
namespace {

// The street from the west gate to the corner in the south-west, 70 m apart, takes a way round over two bends.
class ViewStreets : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const auto& [id, node] : editor().scene().nodes)
      if (const auto type = node.types.find("street"); type != node.types.end() && id.find("w_sw") != std::string::npos)
        street = id;
    ASSERT_FALSE(street.empty());
    set(street, "street.course", "[[-50, 40, 0], [-50, -30, 0]]");
    desktop.ticks(5);
  }
  void set(const std::string& node, const std::string& port, const std::string& value) {
    ASSERT_TRUE(editor().submit(command<SetPort>({node, {port}, {value}}))) << node << "/" << port;
  }
  Workbench& editor() { return desktop.editor(); }
  const SceneFacts& facts() { return *editor().view->facts(); }
  const StreetFacts& bent() {
    const auto& all = facts().urban.streets;
    return *std::find_if(all.begin(), all.end(), [&](const StreetFacts& s) { return s.id == street; });
  }
  ViewScene picture(const ViewChoices& choices) {
    return build_view(facts(), colour_volumes(facts(), "use", editor().theme), choices, {}, editor().person, editor().theme);
  }
  // Pieces of lines that run from one point to the other in plan, whatever their height.
  static std::size_t count_between(const ViewScene& scene, const Point3& a, const Point3& b) {
    const auto is_at = [](const Point3& p, const Point3& q) { return std::hypot(p.x - q.x, p.y - q.y) < 1e-9; };
    return static_cast<std::size_t>(std::count_if(
        scene.lines.begin(), scene.lines.end(), [&](const ViewLine& line) { return is_at(line.from, a) && is_at(line.to, b); }));
  }

  NullDesktop desktop{"scenes/studies/urban_mode.json"};
  std::string street;
};

TEST_F(ViewStreets, AreDrawnAlongTheirCourse) {
  ASSERT_EQ(bent().line.size(), 4u);
  const ViewScene scene = picture(editor().view->choices());
  EXPECT_EQ(count_between(scene, bent().line[0], bent().line[1]), 1u);
  EXPECT_EQ(count_between(scene, bent().line[1], bent().line[2]), 1u);
  EXPECT_EQ(count_between(scene, bent().line[2], bent().line[3]), 1u);
  EXPECT_EQ(count_between(scene, bent().line[0], bent().line[3]), 0u) << "nothing runs straight across";
  for (const ViewLine& line : scene.lines)
    if (std::abs(line.from.x + 50) < 1e-9 && std::abs(line.to.x + 50) < 1e-9) {
      EXPECT_EQ(line.from - line.came, bent().line[0] + (line.from - bent().line[1])) << "it knows the piece before it";
      EXPECT_EQ(line.to + line.goes, bent().line[3] + (line.to - bent().line[2]));
    }
  EXPECT_LT(distance(facts().places[editor().index_of(street)], traffic::point_on_line(bent().line, 0.5)), 1e-9);
  EXPECT_NEAR(reading::read<&reading::StreetFigures::used_length>(editor().state(), editor().index_of(street)),
              traffic::street_length(bent().line.front(), bent().course, bent().line.back()), 1e-9);
}

TEST_F(ViewStreets, ArePointedAtWhereTheyBend) {
  set_layer(editor().person, "buildings", false);
  editor().view->fit_to({-110, -60, 0}, {40, 70, 10});
  desktop.frames(30);
  desktop.move_to({1440 - 330 - 30, 130});
  desktop.key(GLFW_KEY_1);  // from above
  desktop.frames(30);
  for (const double share : {0.1, 0.3, 0.5, 0.7, 0.9}) {
    const Seen at = editor().view->place_in_window(traffic::point_on_line(bent().line, share));
    ASSERT_GT(at.x, 600) << "in the picture";
    desktop.move_to({static_cast<float>(at.x), static_cast<float>(at.y)});
    EXPECT_EQ(editor().picks.hovered_node, street) << share;
  }
  // Where it would run straight there is nothing of it.
  const Seen at = editor().view->place_in_window(0.5 * (bent().line.front() + bent().line.back()));
  desktop.move_to({static_cast<float>(at.x), static_cast<float>(at.y)});
  EXPECT_NE(editor().picks.hovered_node, street);
}

TEST_F(ViewStreets, FollowAHandThatHoldsAJunction) {
  ViewChoices choices = editor().view->choices();
  const Point3 held{-20, 55, 0};
  choices.held[bent().start] = held;
  const ViewScene scene = picture(choices);
  EXPECT_EQ(count_between(scene, held, bent().line[1]), 1u);
  EXPECT_EQ(count_between(scene, bent().line[1], bent().line[2]), 1u) << "bends stay where they are";
  set("j_w", "node.position", "[-20, 55, 0]");
  desktop.ticks(2);
  EXPECT_LT(std::hypot(bent().line[0].x + 20, bent().line[0].y - 55), 1e-9);
  EXPECT_EQ(bent().line[1].x, -50);
}

TEST_F(ViewStreets, IsochronesRunAlongTheCourseAtTheRightDistance) {
  set("network", "traffic_network.isochrone_step", "60");
  set("network", "traffic_network.isochrone_bands", "2");
  desktop.ticks(2);
  editor().picks.only_node("j_w");
  desktop.frames(1);
  const auto shown = editor().view->choices().isochrones;
  ASSERT_NE(shown, nullptr);
  const double whole = traffic::street_length(bent().line.front(), bent().course, bent().line.back());
  double reached = -1;
  for (const Isochrones::Part& part : shown->parts)
    if (part.street == bent().node && part.begin == 0) reached = part.end * whole;
  EXPECT_NEAR(reached, 60 * shown->walking_speed, 0.1) << "a minute on foot";
  // The first band ends on the course, so far from the junction along it.
  const Point3 wanted = traffic::point_on_line(bent().line, reached / whole);
  const ViewScene scene = picture(editor().view->choices());
  EXPECT_TRUE(std::any_of(scene.lines.begin(), scene.lines.end(),
                          [&](const ViewLine& line) { return std::hypot(line.to.x - wanted.x, line.to.y - wanted.y) < 1e-6; }));
}

}  // namespace
}  // namespace bl::desktop
