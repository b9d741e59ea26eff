// The same proposal as balls, cells, slabs and standing bodies: bodies and figures of each form, and what formats say of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/export/format.h"
#include "core/export/forms.h"
#include "core/export/identity.h"
#include "core/export/option_text.h"
#include "core/export/read_proposal.h"
#include "core/export/solids.h"
#include "tests/core/export/two_houses.h"

namespace bl::exporting {
namespace {

class ProposalForms : public ::testing::TestWithParam<const char*> {
 protected:
  ProposalForms() : world_(World::from_file(GetParam())) {
    world_.tick(60);
    auto read = read_proposal(world_.state(), "scene.json");
    EXPECT_TRUE(read) << read.error().text();
    scene_ = std::move(*read);
  }
  World world_;
  Proposal scene_;
};

TEST_P(ProposalForms, BodiesAreClosedAndHaveTheVolumesOfTheirFigures) {
  for (const reading::VolumeFormChoice& choice : reading::volume_forms()) {
    const Proposal formed = in_form(scene_, choice.form);
    EXPECT_EQ(formed.form, choice.form);
    EXPECT_EQ(formed.buildings.size() + formed.shapeless.size(), scene_.buildings.size() + scene_.shapeless.size()) << choice.id;
    double area = 0, volume = 0, uses = 0;
    for (const Building& building : formed.buildings) {
      const std::string what = std::string(choice.id) + ", " + building.id;
      double storeys = 0;
      for (const Storey& storey : building.storeys) storeys += storey.floor_area;
      EXPECT_NEAR(storeys, building.floor_area, 1e-9 * building.floor_area) << what;
      EXPECT_TRUE(is_closed(*building.mesh)) << what;
      area += building.floor_area;
      volume += building.volume;
      EXPECT_FALSE(building.outline.empty()) << what;
      if (choice.form == VolumeForm::as_is) continue;
      // Plates are drawn with chords, and hold a thousandth less than their figures.
      const bool is_exact = choice.form == VolumeForm::balls || (choice.form == VolumeForm::cells && !building.is_standing);
      EXPECT_NEAR(enclosed_volume(*building.mesh), building.volume, (is_exact ? 1e-6 : 5e-3) * building.volume) << what;
    }
    for (const Building& building : formed.shapeless) area += building.floor_area, volume += building.volume;
    for (const UseRow& use : formed.uses) uses += use.floor_area;
    EXPECT_NEAR(formed.all.floor_area, area, 1e-9 * area) << choice.id;
    EXPECT_NEAR(formed.all.volume, volume, 1e-9 * volume) << choice.id;
    EXPECT_NEAR(uses, area, 1e-9 * area) << choice.id;
    EXPECT_GT(formed.levels, 1) << choice.id;
  }
}

// By hand: a ball of radius 5 with storeys of 5 m is cut at 2.5 m below and above its middle.
TEST(VolumeForms, FloorsOfABallAreCutInTheMiddleOfItsStoreys) {
  reading::FormSource source;
  source.position = {3, 4, 10};
  source.volume = 4.0 / 3 * std::numbers::pi * 125;
  source.storey_height = 5;
  const reading::FormedVolume ball = reading::in_form(source, VolumeForm::balls);
  ASSERT_EQ(ball.storeys.size(), 2u);
  EXPECT_NEAR(ball.bottom, 5, 1e-9);
  EXPECT_NEAR(ball.floor_area, 2 * std::numbers::pi * (25 - 6.25), 1e-9);
  EXPECT_NEAR(enclosed_volume(*ball.mesh), source.volume, 1e-9 * source.volume);
  const reading::FormedVolume figures = reading::in_form(source, VolumeForm::balls, false);
  EXPECT_EQ(figures.floor_area, ball.floor_area);
  EXPECT_EQ(figures.mesh, nullptr);
}

// By hand: floors of 80 and 100 m², storeys of 3 m. As slabs 540 m³; 700 m³ fill two storeys of 100 m² and a third of one more.
TEST(VolumeForms, SlabsAndStandingBodiesFollowFromFloors) {
  reading::FormSource source;
  source.volume = 700;
  source.floor_area = 180;
  source.bottom = 1;
  source.height = 6;
  const auto square = [](double side) {
    return std::vector<geometry::PlateFace>{{{{0, 0, 0}, {side, 0, 0}, {side, 10, 0}, {0, 10, 0}}, {}}};
  };
  source.storeys = {{1, 4, 80, square(8)}, {4, 7, 100, square(10)}};
  const reading::FormedVolume slabs = reading::in_form(source, VolumeForm::slabs);
  EXPECT_NEAR(slabs.floor_area, 180, 1e-9);
  EXPECT_NEAR(slabs.volume, 540, 1e-9);
  EXPECT_NEAR(enclosed_volume(*slabs.mesh), 540, 1e-9);
  const reading::FormedVolume standing = reading::in_form(source, VolumeForm::standing);
  EXPECT_EQ(standing.storeys.size(), 2u);
  EXPECT_NEAR(standing.floor_area, 200, 1e-9);
  EXPECT_NEAR(standing.volume, 600, 1e-9);
  EXPECT_NEAR(enclosed_volume(*standing.mesh), 600, 1e-9);
  EXPECT_EQ(standing.bottom, 1);
  EXPECT_EQ(standing.top, 7);
}

TEST_P(ProposalForms, EveryFormatTakesTheFormOrSaysWhyNot) {
  for (const FormatDefinition& format : all_formats()) {
    ASSERT_NE(format.find_port("form"), nullptr) << format.id;
    if (!format.shell.empty() || format.id == "geojson") continue;  // these want a page, and a place on Earth
    const auto plain = format.write(scene_, *option_values(format, {}), false);
    ASSERT_TRUE(plain) << format.id << ": " << plain.error().text();
    for (const char* form : {"balls", "slabs"}) {
      const auto options = option_values(format, {std::string("form=") + form});
      ASSERT_TRUE(options) << options.error().text();
      const auto files = format.write(scene_, *options, false);
      const bool is_refused = std::string(form) == "balls" && (format.id == "ifc" || format.id == "cityjson");
      ASSERT_EQ(files.ok(), !is_refused) << format.id << ", " << form;
      if (is_refused) {
        EXPECT_NE(files.error().message.find("form=slabs"), std::string::npos) << files.error().message;
        continue;
      }
      EXPECT_TRUE(files->files.front().content != plain->files.front().content) << format.id << ", " << form;
    }
  }
  EXPECT_NE(identity_line(scene_).find("volumes as they are"), std::string::npos);
  EXPECT_NE(identity_line(in_form(scene_, VolumeForm::slabs)).find("volumes as slabs"), std::string::npos);
}

// Its solver has kept no coarse mesh, as one of another program, or one that has failed since the scene was saved.
TEST(VolumeForms, AVolumeWithoutABodyInAFormIsToldAndMeasuresNothing) {
  Proposal proposal = proposal_of(settled_world());
  proposal.buildings[1].shape = {};
  const Proposal cells = in_form(proposal, VolumeForm::cells);
  ASSERT_EQ(cells.buildings.size(), 1u);
  ASSERT_EQ(cells.shapeless.size(), 1u);
  EXPECT_EQ(cells.all.floor_area, cells.buildings[0].floor_area);
  EXPECT_EQ(cells.all.volume, cells.buildings[0].volume);
  EXPECT_EQ(cells.shapeless[0].floor_area, 0);
  EXPECT_EQ(cells.shapeless[0].asked_area, proposal.buildings[1].asked_area);
  for (const FormatDefinition& format : all_formats()) {
    if (!format.shell.empty()) continue;  // these want a page
    const ExportFiles made = files_of(proposal, format.id.c_str(), {"form=cells"});
    ASSERT_EQ(made.notes.size(), 1u) << format.id;
    EXPECT_EQ(made.notes.front(), "in tables only: west: it has no body as cells") << format.id;
  }
}

// As an import may bring it, or people: it encloses a volume all the same.
TEST(Solids, AnOpenMeshIsNotPrinted) {
  Proposal proposal = proposal_of(settled_world());
  const Building& one = proposal.buildings.front();
  Mesh open = *one.mesh;
  EXPECT_TRUE(is_closed(open));
  open.triangles.pop_back();
  EXPECT_FALSE(is_closed(open));
  EXPECT_FALSE(is_closed(Mesh{}));
  proposal.neighbours = {{"shed", "Shed", "", one.outline.front(), 0, 9, std::make_shared<const Mesh>(open)},
                         {"barn", "Barn", "", one.outline.front(), 0, 9, one.mesh}};
  for (const char* id : {"stl", "3mf"}) {
    const ExportFiles made = files_of(proposal, id, {"surroundings=yes"});
    ASSERT_EQ(made.notes.size(), 1u) << id;
    EXPECT_TRUE(made.notes.front().starts_with("Shed ")) << made.notes.front();
  }
  std::vector<std::string> notes;
  for (const Solid& solid : printable_solids_of(proposal, true, true, notes)) EXPECT_TRUE(is_closed(*solid.mesh)) << solid.name;
}

// An option must not be without effect and without a word.
TEST(VolumeForms, BodiesWithoutWallsAreTold) {
  const Proposal proposal = proposal_of(settled_world());
  for (const char* form : {"form=slabs", "form=standing"}) {
    const ExportFiles with = files_of(proposal, "ifc", {form}), without = files_of(proposal, "ifc", {form, "walls=no"});
    EXPECT_EQ(with.files.front().content.find("IFCWALL("), std::string::npos);
    ASSERT_EQ(with.notes.size(), 1u) << form;
    EXPECT_NE(with.notes.front().find("volumes as s"), std::string::npos) << with.notes.front();
    EXPECT_NE(with.notes.front().find("no walls"), std::string::npos) << with.notes.front();
    EXPECT_TRUE(without.notes.empty()) << form;
  }
}

INSTANTIATE_TEST_SUITE_P(Start, ProposalForms, ::testing::Values("scenes/start/standing.json", "scenes/start/quarter.json"));

}  // namespace
}  // namespace bl::exporting
