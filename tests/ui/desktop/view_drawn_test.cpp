// Volumes in another form, and the model cut above a storey: the shapes that are drawn, and what is said of them.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include "core/geometry/cell_mesh.h"
#include "core/reading/cell_cut.h"
#include "core/reading/views/volume.h"
#include "tests/support/world.h"
#include "tests/ui/desktop/panels_support.h"
#include "ui/desktop/panels/scene_view.h"
#include "ui/desktop/view/drawn_form.h"
#include "ui/desktop/view/section_plane.h"

namespace bl::desktop {
namespace {

// The mesh that a renderer makes of a coarse cell.
Mesh wrapped(const MeshPointer& cell, int depth) {
  Mesh mesh;
  mesh.coarse = std::make_shared<const Mesh>(*cell);
  return *geometry::mesh_of_depth(std::make_shared<const Mesh>(std::move(mesh)), depth);
}

bool stands(const SceneFacts& facts, const VolumeFacts& volume) {
  return reading::row_of<reading::FootprintFigures>(*facts.state, volume.node).has_value();
}

double highest(const Mesh& mesh) {
  double top = -1e300;
  for (const Point3& v : mesh.vertices) top = std::max(top, v.z);
  return top;
}
double lowest(const Mesh& mesh) {
  double low = 1e300;
  for (const Point3& v : mesh.vertices) low = std::min(low, v.z);
  return low;
}

TEST(CellCut, ACutBallIsItsCap) {
  constexpr double kRadius = 10;
  const MeshPointer ball = ball_cell({3, 4, 5}, kRadius);
  for (const double height : {-3.0, 1.0, 5.0, 9.0, 13.0}) {
    const MeshPointer left = reading::cut_cell(*ball, height, reading::Kept::below);
    ASSERT_TRUE(left) << height;
    const Mesh mesh = wrapped(left, 5);
    EXPECT_LE(highest(mesh), height + 1e-9) << height;
    const double cap = height - (5 - kRadius), volume = std::numbers::pi * cap * cap * (3 * kRadius - cap) / 3;
    EXPECT_NEAR(enclosed_volume(mesh) / volume, 1, 0.02) << height;
    const MeshPointer rest = reading::cut_cell(*ball, height, reading::Kept::above);
    ASSERT_TRUE(rest) << height;
    const double whole = 4.0 / 3 * std::numbers::pi * kRadius * kRadius * kRadius;
    EXPECT_NEAR(enclosed_volume(wrapped(rest, 5)) / whole, 1 - volume / whole, 0.02) << height;
  }
  EXPECT_FALSE(reading::cut_cell(*ball, -5.5, reading::Kept::below)) << "there is nothing of the ball";
}

class DrawnScene : public ::testing::TestWithParam<const char*> {
 protected:
  DrawnScene() : world_(World::from_file(GetParam())) {
    world_.tick(60);
    facts_ = read_facts(world_.session().state(), nullptr);
  }
  World world_;
  std::shared_ptr<const SceneFacts> facts_;
};

TEST_P(DrawnScene, BallsHaveTheVolumesOfTheScene) {
  DrawnShapes shapes;
  const auto drawn = shapes.of(facts_, {DrawnForm::balls, 0});
  ASSERT_EQ(drawn->volumes.size(), facts_->volumes.size());
  for (const VolumeFacts& volume : drawn->volumes) {
    const double radius = volume.cell->wrap->radius;
    EXPECT_NEAR(4.0 / 3 * std::numbers::pi * radius * radius * radius, volume.volume, 1e-6 * volume.volume) << volume.id;
  }
  EXPECT_EQ(shapes.legend().title, "Drawn: Balls");
}

TEST_P(DrawnScene, SlabsAddUpToTheFloorArea) {
  DrawnShapes shapes;
  const auto drawn = shapes.of(facts_, {DrawnForm::slabs, 0});
  for (const VolumeFacts& volume : drawn->volumes) {
    EXPECT_TRUE(volume.is_drawn_otherwise) << volume.id;
    EXPECT_NEAR(volume.drawn_area, volume.floor_area, 0.004 * volume.floor_area) << volume.id;
    EXPECT_GE(lowest(*volume.cell), volume.figures.bottom - 1e-6) << volume.id;
    EXPECT_FALSE(volume.is_dressed);
  }
}

TEST_P(DrawnScene, CellsHaveFlatFacetsBetweenTheirOwnTopAndBottom) {
  DrawnShapes shapes;
  const auto drawn = shapes.of(facts_, {DrawnForm::cells, 0});
  for (const VolumeFacts& volume : drawn->volumes) {
    EXPECT_GE(lowest(*volume.cell), volume.figures.bottom - 1e-6) << volume.id;
    EXPECT_LE(highest(*volume.cell), volume.figures.bottom + volume.figures.height + 1e-6) << volume.id;
    EXPECT_GE(volume.drawn_volume, 0.999 * volume.volume) << volume.id << ": a cell is never less than what is wrapped of it";
    if (stands(*facts_, volume)) continue;  // a building, whose triangles are no fans
    // Divided again it stays as it is: nothing is wrapped.
    EXPECT_NEAR(enclosed_volume(wrapped(volume.cell, 2)), enclosed_volume(*volume.cell), 1e-6 * volume.volume) << volume.id;
  }
}

TEST_P(DrawnScene, ACutShowsTheLowestStoreysOfEachVolume) {
  const int all = storeys_in(*facts_);
  ASSERT_GT(all, 3);
  for (const DrawnForm form : {DrawnForm::as_is, DrawnForm::balls, DrawnForm::cells, DrawnForm::slabs, DrawnForm::standing})
    for (int shown = 1; shown < all; shown += 2) {
      DrawnShapes shapes;
      const auto drawn = shapes.of(facts_, {form, shown});
      EXPECT_FALSE(drawn->volumes.empty());
      for (const VolumeFacts& volume : drawn->volumes) {
        const double storey = volume.figures.storey_height;
        const int own = shown - storeys_below(volume, facts_->ground);
        ASSERT_GT(own, 0) << volume.id;
        if (own >= storeys_of(volume)) continue;
        const double top = volume.figures.bottom + own * storey;
        const bool has_facets =
            form == DrawnForm::slabs || form == DrawnForm::standing || (form != DrawnForm::balls && stands(*facts_, volume));
        EXPECT_LE(highest(has_facets ? *volume.cell : wrapped(volume.cell, 3)), top + 1e-6) << volume.id << " of " << shown;
      }
    }
}

// Figures are those of the whole form, also where storeys are cut away; exports have the same by the same function.
TEST_P(DrawnScene, FiguresFollowTheForm) {
  for (const DrawnForm form : {DrawnForm::balls, DrawnForm::cells, DrawnForm::slabs, DrawnForm::standing}) {
    DrawnShapes whole, cut;
    const auto drawn = whole.of(facts_, {form, 0});
    cut.of(facts_, {form, 1});
    for (const VolumeFacts& volume : drawn->volumes) {
      const auto figures = whole.figures_of(volume.node), of_cut = cut.figures_of(volume.node);
      ASSERT_TRUE(figures && of_cut) << volume.id;
      EXPECT_EQ(figures->volume, of_cut->volume) << volume.id;
      EXPECT_EQ(figures->floor_area, of_cut->floor_area) << volume.id;
      EXPECT_GT(figures->floor_area, 0) << volume.id;
      const double storey = volume.figures.storey_height;
      if (form == DrawnForm::balls) EXPECT_EQ(figures->volume, volume.volume) << volume.id;
      else if (stands(*facts_, volume)) EXPECT_EQ(figures->floor_area, volume.floor_area) << volume.id;
      else if (form == DrawnForm::slabs) {
        // What is left above the last storey counts as floor area, and has no plate of its own where it is low.
        EXPECT_LE(figures->volume, volume.floor_area * storey * (1 + 1e-6)) << volume.id;
        EXPECT_GE(figures->volume, 0.9 * volume.floor_area * storey) << volume.id;
      } else if (form == DrawnForm::standing) EXPECT_NEAR(figures->volume, figures->floor_area * storey, 1e-6 * volume.volume);
      else EXPECT_GE(figures->volume, 0.999 * volume.volume) << volume.id;
    }
    const auto& rows = whole.legend().rows;
    ASSERT_FALSE(rows.empty());
    EXPECT_NE(rows.front().label.find(std::string("Figures ") + reading::choice_of(form).measured), std::string::npos);
  }
  DrawnShapes plain;
  plain.of(facts_, {});
  EXPECT_FALSE(plain.figures_of(facts_->volumes.front().node)) << "the scene's own figures are not doubled";
}

TEST_P(DrawnScene, WhatHasNotChangedKeepsItsShape) {
  DrawnShapes shapes;
  const auto first = shapes.of(facts_, {DrawnForm::slabs, 2});
  EXPECT_EQ(shapes.of(facts_, {DrawnForm::slabs, 2}), first);
  const auto again = shapes.of(read_facts(world_.session().state(), facts_.get()), {DrawnForm::slabs, 2});
  ASSERT_EQ(again->volumes.size(), first->volumes.size());
  for (std::size_t k = 0; k < first->volumes.size(); ++k) EXPECT_EQ(again->volumes[k].cell, first->volumes[k].cell);
  EXPECT_EQ(shapes.of(facts_, {}), facts_) << "as they are is the facts themselves";
}

// By hand: a pavilion of 2.4 m under storeys of 3.2 m has one slab, as high as itself.
TEST(DrawnLow, ASlabIsNoHigherThanItsBody) {
  World world = World::from_text(R"({"format": "behaviourlinks", "version": 1, "settings": {}, "nodes": [
      {"id": "site", "types": {"boundary": {"form": "plan", "plan": [[-30, -20, 0], [30, -20, 0], [30, 20, 0], [-30, 20, 0]], "height": 2.4}}},
      {"id": "solver", "types": {"smart_volumes_solver": {}}},
      {"id": "house", "position": [0, 0, 1.2], "types": {"smart_volume": {"demand": 900, "storey_height": 3.2}}}]})");
  ASSERT_TRUE(world.settle());
  const auto facts = read_facts(world.session().state(), nullptr);
  DrawnShapes shapes;
  const auto drawn = shapes.of(facts, {DrawnForm::slabs, 0});
  ASSERT_EQ(drawn->volumes.size(), 1u);
  const VolumeFacts& house = drawn->volumes.front();
  ASSERT_NEAR(house.figures.height, 2.4, 1e-6);
  EXPECT_NEAR(shapes.figures_of(house.node)->volume, 2.4 * house.drawn_area, 1e-6 * house.volume);
  EXPECT_LE(highest(*house.cell), 2.4 + 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Start, DrawnScene, ::testing::Values("scenes/start/standing.json", "scenes/start/quarter.json"));

// Flats over two cellars of 3 m, and a round shop over one of 3.5 m.
class CellarScene : public ::testing::Test {
 protected:
  CellarScene() : world_(World::from_file("scenes/nodes/footprint.json")) {
    world_.settle();
    facts_ = read_facts(world_.session().state(), nullptr);
  }
  const VolumeFacts& volume(const SceneFacts& facts, const std::string& id) {
    return *facts.volume_of(facts.state->plan->node_index(id));
  }
  double area(const std::string& id) { return world_.number(id, "footprint.cellar_area"); }
  World world_;
  std::shared_ptr<const SceneFacts> facts_;
};

TEST_F(CellarScene, LieUnderTheVolumesWhereTheGroundIsOpen) {
  ASSERT_EQ(facts_->cellars.size(), 2u);
  EXPECT_EQ(cellars_in(*facts_), 2);
  EXPECT_FALSE(facts_->cellars.front().cell) << "the ground hides them";
  DrawnShapes shapes;
  const auto drawn = shapes.of(facts_, {DrawnForm::as_is, 0, true});
  ASSERT_EQ(drawn->volumes.size(), facts_->volumes.size());
  EXPECT_TRUE(shapes.legend().title.empty());
  for (std::size_t k = 0; k < drawn->cellars.size(); ++k) {
    const CellarFacts& cellar = drawn->cellars[k];
    const VolumeFacts& above = *drawn->volume_of(cellar.node);
    EXPECT_EQ(above.cell, facts_->volume_of(cellar.node)->cell) << "volumes stay as they are";
    ASSERT_TRUE(cellar.cell);
    EXPECT_NEAR(highest(*cellar.cell), above.figures.bottom, 1e-6);
    EXPECT_NEAR(lowest(*cellar.cell), cellar.bottom, 1e-6);
    const double volume = cellar.storeys * cellar.area * cellar.storey_height;
    EXPECT_NEAR(enclosed_volume(*cellar.cell), volume, 0.01 * volume);
    EXPECT_EQ(shapes.of(read_facts(world_.session().state(), facts_.get()), {DrawnForm::as_is, 0, true})->cellars[k].cell,
              cellar.cell)
        << "it is made once";
  }
  const auto slabs = shapes.of(facts_, {DrawnForm::slabs, 1, true});
  EXPECT_TRUE(slabs->cellars.front().cell) << "in every form and cut";
}

TEST_F(CellarScene, TakeThePlaceOfTheVolumesBelowTheGround) {
  DrawnShapes shapes;
  const auto first = shapes.of(facts_, {DrawnForm::as_is, -1});
  ASSERT_EQ(first->volumes.size(), 2u);
  EXPECT_NEAR(volume(*first, "flats").drawn_area, area("flats"), 1e-9 * area("flats"));
  EXPECT_NEAR(lowest(*volume(*first, "shop").cell), -3.5, 1e-6);
  EXPECT_NEAR(highest(*volume(*first, "flats").cell), 0, 1e-6);
  ASSERT_TRUE(first->pit);
  EXPECT_NEAR(*first->pit, -6, 1e-9);
  EXPECT_NE(shapes.legend().rows.front().label.find("no part of the floor area"), std::string::npos);
  const auto second = shapes.of(facts_, {DrawnForm::balls, -2});
  ASSERT_EQ(second->volumes.size(), 1u) << "the shop has no second cellar";
  EXPECT_NEAR(highest(*second->volumes[0].cell), -3, 1e-6);
  EXPECT_NEAR(second->volumes[0].drawn_area, 0.5 * area("flats"), 1e-6 * area("flats"));
  EXPECT_TRUE(shapes.figures_of(second->volumes[0].node)) << "figures are those of the whole form";
}

TEST_F(CellarScene, AreMetByTheMouseAndReachedByTheFrameOfASection) {
  DrawnShapes shapes;
  const auto drawn = shapes.of(facts_, {DrawnForm::as_is, 0, true});
  EXPECT_NEAR(model_box(*drawn).low.z, -6, 1e-9);
  EXPECT_NEAR(model_box(*facts_).low.z, 0, 1e-9);
  // Before the plane, looking north: what is cut open at a height of -4.5 m is the second cellar of the flats.
  const Ray ray{{-12, -100, -4.5}, {0, 1, 0}};
  const auto hit = pick(ray, *drawn, upright_section(0, 4), false);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->node, volume(*drawn, "flats").node);
  EXPECT_NEAR(hit->place.y, 4, 1e-6);
  EXPECT_FALSE(pick(ray, *facts_, upright_section(0, 4), false));
}

TEST(CellarView, TheSliderGoesDownToTheCellarsAndASectionOpensTheGround) {
  PanelDesktop desktop("scenes/nodes/footprint.json");
  desktop.ticks(60);
  desktop.frames(40);
  SceneView& view = *desktop.editor().view;
  ASSERT_EQ(view.cellars_in_all(), 2);
  ASSERT_EQ(view.storeys_in_all(), 5);
  const ImVec4 slider = view.storey_slider();
  ASSERT_GT(slider.w, slider.y);
  desktop.click({(slider.x + slider.z) / 2, slider.w - 8});
  desktop.frames(3);
  EXPECT_EQ(view.drawn_look().storeys, -2) << "its lower end is the deepest cellar";
  EXPECT_EQ(view.facts()->volumes.size(), 1u);
  desktop.editor().area = Area::view;
  desktop.key(GLFW_KEY_PAGE_DOWN);
  EXPECT_EQ(view.drawn_look().storeys, -2) << "there is nothing below";
  desktop.key(GLFW_KEY_PAGE_UP);
  EXPECT_EQ(view.drawn_look().storeys, -1);
  desktop.key(GLFW_KEY_PAGE_UP);
  EXPECT_EQ(view.drawn_look().storeys, 1) << "above the first cellar comes the first storey";
  desktop.key(GLFW_KEY_PAGE_UP, false, true);
  EXPECT_TRUE(view.drawn_look().is_plain());
  view.set_section(upright_section(0, 4));
  desktop.frames(3);
  EXPECT_TRUE(view.drawn_look().opens_ground);
  EXPECT_TRUE(view.facts()->cellars.front().cell);
  // From above the chosen volume has the lengths of its cellar, without the courtyard.
  view.set_section({});
  view.show_storeys(-1);
  desktop.choose("flats");
  view.look_from(SceneView::Side::plan);
  desktop.frames(40);
  EXPECT_EQ(view.dimensions().size(), 5u) << "a block, one corner of which the shop cuts off";
}

class StandingView : public ::testing::Test {
 protected:
  void SetUp() override {
    desktop.ticks(80);
    desktop.frames(40);
  }
  SceneView& view() { return *desktop.editor().view; }
  const reading::FootprintFigures footprint(const std::string& id) {
    return *reading::row_of<reading::FootprintFigures>(desktop.editor().state(), desktop.editor().index_of(id));
  }
  PanelDesktop desktop{"scenes/start/standing.json"};
};

TEST_F(StandingView, TheSliderCutsTheModelAndLetsItGrowAgain) {
  const int all = view().storeys_in_all();
  ASSERT_EQ(all, 13) << "the hotel is the tallest";
  const std::size_t volumes = view().facts()->volumes.size();
  const ImVec4 slider = view().storey_slider();
  ASSERT_GT(slider.w, slider.y);
  const float x = (slider.x + slider.z) / 2;
  desktop.click({x, slider.w - 8});
  desktop.frames(3);
  EXPECT_EQ(view().drawn_look().storeys, 1);
  EXPECT_EQ(view().facts()->volumes.size(), volumes);
  for (const VolumeFacts& volume : view().facts()->volumes)
    EXPECT_LE(highest(*volume.cell), volume.figures.bottom + volume.figures.storey_height + 1e-6) << volume.id;
  desktop.drag({x, slider.w - 8}, {x, slider.y - 20});
  desktop.frames(3);
  EXPECT_EQ(view().drawn_look().storeys, 0) << "at its top all are shown";
  EXPECT_EQ(view().facts()->volumes.front().cell, view().facts()->volumes.front().cell);
  desktop.editor().area = Area::view;
  desktop.key(GLFW_KEY_PAGE_DOWN);
  desktop.key(GLFW_KEY_PAGE_DOWN);
  EXPECT_EQ(view().drawn_look().storeys, all - 2);
  desktop.key(GLFW_KEY_PAGE_UP, false, true);
  EXPECT_EQ(view().drawn_look().storeys, 0);
}

TEST_F(StandingView, TheFormIsChosenInTheViewAndKept) {
  desktop.press_on("view/forms");
  desktop.frames(3);
  desktop.press_on("view/forms/slabs");
  desktop.frames(3);
  EXPECT_EQ(desktop.editor().person.drawn_as, "slabs");
  const auto& legends = view().legend_places().legends;
  EXPECT_TRUE(std::any_of(legends.begin(), legends.end(), [](const Legend& l) { return l.title == "Drawn: Slabs"; }));
  EXPECT_TRUE(view().facts()->volumes.front().is_drawn_otherwise);
}

TEST_F(StandingView, FromAboveTheChosenVolumeHasItsDimensions) {
  desktop.choose("hotel");
  EXPECT_TRUE(view().dimensions().empty()) << "not from the side";
  view().look_from(SceneView::Side::plan);
  desktop.frames(40);
  // The upper storeys of the hotel set back.
  const std::vector<double> upper = view().dimensions();
  ASSERT_GE(upper.size(), 3u);
  view().show_storeys(1);
  desktop.frames(3);
  const std::vector<double> lower = view().dimensions();
  ASSERT_GE(lower.size(), 3u);
  EXPECT_GT(*std::max_element(lower.begin(), lower.end()), *std::max_element(upper.begin(), upper.end()));
  const auto plates = footprint("hotel").plates;
  const auto& corners = *plates.numbers(0, "corners");
  const double side = std::hypot(corners[4] - corners[0], corners[5] - corners[1]);
  EXPECT_TRUE(std::any_of(lower.begin(), lower.end(), [&](double d) { return d >= side - 1e-9; }));
}

}  // namespace
}  // namespace bl::desktop
