// Isochrones in the 3D view: the parts of streets against the scene's own times at junctions, and what is shown when.
#include <algorithm>
#include <cmath>

#include "core/reading/views/traffic.h"
#include "tests/support/world.h"
#include "tests/ui/desktop/panels_support.h"
#include "ui/desktop/panels/scene_view.h"
#include "ui/desktop/view/urban_picture.h"

namespace bl::desktop {
namespace {

class ViewIsochrones : public ::testing::Test {
 protected:
  void SetUp() override {
    set("library", "traffic_zone.list_reach", "true");
    set("network", "traffic_network.isochrone_step", "60");
    set("network", "traffic_network.isochrone_bands", "4");
    desktop.ticks(40);
  }
  void set(const std::string& node, const std::string& port, const std::string& value) {
    ASSERT_TRUE(editor().submit(command<SetPort>({node, {port}, {value}}))) << node << "/" << port;
  }
  Workbench& editor() { return desktop.editor(); }
  const State& state() { return editor().state(); }
  std::uint32_t index(const std::string& id) { return editor().index_of(id); }
  std::vector<StreetFacts> streets() { return read_facts(editor().moment->state, nullptr)->urban.streets; }
  reading::StreetFigures street(std::uint32_t node) { return *reading::row_of<reading::StreetFigures>(state(), node); }

  // Each point of each street has to be in the band of its time, by the times that the zone lists.
  std::size_t compare(bool by_car) {
    const auto shown = isochrones_of(state(), index("library"), by_car);
    if (!shown) return 0;
    const auto& reach = std::get<Shared<Table>>(value_in(state(), "library", "traffic_zone.reach"));
    std::map<std::uint32_t, double> at;
    for (std::size_t row = 0; row < reach->rows.size(); ++row)
      if (const double time = reach->number(row, by_car ? "driving" : "walking"); time >= 0)
        at[index(reach->text(row, "junction"))] = time;
    std::size_t reached = 0;
    for (const StreetFacts& facts : streets())
      for (int k = 0; k < 50; ++k) {
        const double share = (k + 0.5) / 50, walk = street(facts.node).used_length / shown->walking_speed;
        const double forth = by_car ? street(facts.node).time_forth : walk, back = by_car ? street(facts.node).time_back : walk;
        const double time = std::min(at.at(facts.start) + share * forth, at.at(facts.end) + (1 - share) * back);
        std::size_t band = shown->times.size();
        for (const Isochrones::Part& part : shown->parts)
          if (part.street == facts.node && part.begin <= share && share <= part.end) band = part.band;
        const auto& times = shown->times;
        const auto wanted = static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), time) - times.begin());
        const bool is_at_edge = std::any_of(times.begin(), times.end(), [&](double t) { return std::abs(t - time) < 1e-3; });
        if (is_at_edge) continue;
        EXPECT_EQ(band, wanted) << facts.id << " at " << share << ", " << time << " s";
        reached += band < times.size() ? 1 : 0;
      }
    return reached;
  }

  NullDesktop desktop{"scenes/studies/urban_mode.json"};
};

TEST_F(ViewIsochrones, AgreeOnFootWithTheTimesThatTheZoneLists) { EXPECT_GT(compare(false), 100u); }

TEST_F(ViewIsochrones, AgreeByCarWithTheTimesAtTheFlowsOfTheTick) {
  EXPECT_GT(compare(true), 100u);
  set("j_nw", "junction.delay", "25");
  desktop.ticks(3);
  EXPECT_GT(compare(true), 100u) << "with a wait at a junction";
}

TEST_F(ViewIsochrones, MindTheRulesOfTurning) {
  const auto bands = [&] { return isochrones_of(state(), index("library"), true)->parts.size(); };
  const std::size_t before = bands();
  ASSERT_TRUE(editor().submit(command<Typify>({"j_nw", "turn_rules", {"{}"}})));
  std::string rows;
  for (const StreetFacts& from : streets())
    for (const StreetFacts& to : streets())
      if ((from.start == index("j_nw") || from.end == index("j_nw")) && (to.start == index("j_nw") || to.end == index("j_nw")))
        rows += (rows.empty() ? "" : ", ") + ("{\"from\": \"" + from.id + "\", \"to\": \"" + to.id + "\"}");
  set("j_nw", "turn_rules.turns", "[" + rows + "]");
  desktop.ticks(3);
  EXPECT_LT(bands(), before) << "nobody goes on from that corner";
}

TEST_F(ViewIsochrones, BeginAtJunctionsAsWellAndNowhereElse) {
  const auto gate = isochrones_of(state(), index("j_w"), false);
  ASSERT_NE(gate, nullptr);
  EXPECT_FALSE(gate->parts.empty());
  EXPECT_EQ(gate->reason, "");
  EXPECT_EQ(gate->times, (std::vector<double>{60, 120, 180, 240}));
  EXPECT_EQ(isochrones_of(state(), index("solver"), false), nullptr);
  EXPECT_EQ(isochrones_of(state(), index("network"), false), nullptr);
}

TEST_F(ViewIsochrones, ClosedStreetsAreNotWalkedAndAnIslandSaysWhy) {
  const std::size_t before = isochrones_of(state(), index("library"), false)->parts.size();
  for (const StreetFacts& facts : streets()) set(facts.id, "street.open", "0");
  desktop.ticks(2);
  const auto shown = isochrones_of(state(), index("library"), false);
  EXPECT_GT(before, 0u);
  EXPECT_TRUE(shown->parts.empty());
  EXPECT_EQ(shown->reason, "no street is reached in that time");
  EXPECT_EQ(isochrone_legend(*editor().view->facts(), shown.get(), editor().theme).rows.size(), 1u) << "the reason";
}

TEST_F(ViewIsochrones, FollowTheChoiceElseTheMouseAndTheLayers) {
  EXPECT_EQ(editor().view->choices().isochrones, nullptr) << "nobody has chosen anything";
  editor().picks.only_node("library");
  desktop.frames(1);
  ASSERT_NE(editor().view->choices().isochrones, nullptr);
  EXPECT_EQ(editor().view->choices().isochrones->node, index("library"));
  EXPECT_FALSE(editor().view->choices().isochrones->is_by_car);
  set_layer(editor().person, "isochrones_by_car", true);
  desktop.frames(1);
  EXPECT_TRUE(editor().view->choices().isochrones->is_by_car);
  const auto facts = editor().view->facts();
  const Legend legend = isochrone_legend(*facts, editor().view->choices().isochrones.get(), editor().theme);
  EXPECT_EQ(legend.title.rfind("Library, reached by car", 0), 0u) << legend.title;
  ASSERT_EQ(legend.rows.size(), 4u);
  EXPECT_EQ(legend.rows[0].label, "within 1 min");
  EXPECT_EQ(legend.rows[3].label, "3 to 4 min");
  set_layer(editor().person, "isochrones", false);
  desktop.frames(1);
  EXPECT_EQ(editor().view->choices().isochrones, nullptr);
  set_layer(editor().person, "isochrones", true);
  desktop.frames(1);
  EXPECT_NE(editor().view->choices().isochrones, nullptr) << "and back again";
  editor().picks.clear();
  desktop.frames(1);
  EXPECT_EQ(editor().view->choices().isochrones, nullptr);
  const Seen at = editor().view->place_in_window(facts->places[index("library")]);
  desktop.move_to({static_cast<float>(at.x), static_cast<float>(at.y)});
  if (editor().picks.hovered_node == "library") {
    ASSERT_NE(editor().view->choices().isochrones, nullptr) << "what the mouse is over";
  }
}

TEST_F(ViewIsochrones, AreLinesUnderTheStreetsInColoursOfTheLegend) {
  editor().picks.only_node("library");
  desktop.frames(1);
  const SceneFacts& facts = *editor().view->facts();
  const ViewChoices& choices = editor().view->choices();
  const Legend legend = isochrone_legend(facts, choices.isochrones.get(), editor().theme);
  const ViewScene scene =
      build_view(facts, colour_volumes(facts, "use", editor().theme), choices, {}, editor().person, editor().theme);
  double length = 0;
  for (const Legend::Row& row : legend.rows)
    for (const ViewLine& line : scene.lines)
      if (line.colour == row.colour) length += distance(line.from, line.to);
  double wanted = 0;
  for (const Isochrones::Part& part : choices.isochrones->parts)
    wanted += (part.end - part.begin) * street(part.street).used_length;
  EXPECT_GT(wanted, 300);
  EXPECT_NEAR(length, wanted, 0.01 * wanted);
}

TEST_F(ViewIsochrones, TellWhenTheFlowsStillMove) {
  editor().document->session().settle();
  set("network", "traffic_network.gap", "1e-12");
  set("network", "traffic_network.steps", "1");
  set("suburb", "traffic_zone.trips_out", "900");
  desktop.ticks(1);
  const auto by_car = isochrones_of(state(), index("library"), true);
  EXPECT_EQ(by_car->tentative, "tentative: flows still change");
  EXPECT_NE(isochrone_legend(*editor().view->facts(), by_car.get(), editor().theme).title.find("tentative"), std::string::npos);
  EXPECT_EQ(isochrones_of(state(), index("library"), false)->tentative, "") << "walks do not depend on flows";
}

}  // namespace
}  // namespace bl::desktop
