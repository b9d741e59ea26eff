// Problems, history and statistics, on the null renderer.
#include <algorithm>

#include "core/file/file_io.h"
#include "tests/ui/desktop/panels_support.h"
#include "ui/desktop/panels/brief_uses.h"
#include "ui/desktop/panels/panels.h"
#include "ui/desktop/panels/problems_list.h"
#include "ui/desktop/panels/scene_view.h"
#include "ui/desktop/panels/statistics_record.h"
#include "ui/desktop/view/colouring.h"

namespace bl::desktop {
namespace {

constexpr const char* kListedQuarter = "scenes/start/quarter.json";

class ListDesktop : public PanelDesktop {
 public:
  explicit ListDesktop(const std::string& scene) : PanelDesktop(scene) {}
  ProblemList& problems() { return *memory_of(editor()).problems; }
  RunRecord& record() { return *memory_of(editor()).record; }
  // The items of a kind, written out.
  std::vector<ProblemItem> of(ProblemKind kind) {
    std::vector<ProblemItem> found;
    for (ProblemItem item : problems().items()) {
      if (item.kind != kind) continue;
      write_problem(editor().state(), record().figures(editor()).accounts, item);
      found.push_back(item);
    }
    return found;
  }
  void open_tab(const std::string& name) {
    memory_of(editor()).wanted_tab = name;
    frames(3);
  }
};

TEST(Problems, AConflictNamesWhoPullsAndHowMuch) {
  ListDesktop desktop(kListedQuarter);
  ASSERT_TRUE(desktop.editor().submit(command<SetPort>({"library", {"smart_volume.demand"}, {"4000"}})));
  desktop.ticks(10);
  bool is_found = false;
  for (const ProblemItem& item : desktop.of(ProblemKind::conflict)) {
    if (item.nodes.front() != "library" || item.subject.find("demand of Library") == std::string::npos) continue;
    is_found = true;
    EXPECT_EQ(item.subject, "One link pulls on the demand of Library");
    EXPECT_NE(item.text.find("brief (Demand) wants 7200"), std::string::npos) << item.text;
    EXPECT_NE(item.text.find("set by hand to 4000"), std::string::npos) << item.text;
    EXPECT_EQ(item.links, std::vector<std::string>{"brief"});
  }
  EXPECT_TRUE(is_found);
}

TEST(Problems, APressGoesThere) {
  ListDesktop desktop(kListedQuarter);
  desktop.ticks(10);
  ASSERT_FALSE(desktop.problems().items().empty());
  const std::string node = desktop.problems().items().front().nodes.front();
  desktop.press_on("problem/0");
  EXPECT_TRUE(desktop.editor().picks.nodes.contains(node));
}

TEST(Problems, ABrokenRuleOfAPlotIsListedWithWhoBreaksIt) {
  ListDesktop desktop("scenes/nodes/plot.json");
  ASSERT_TRUE(desktop.editor().submit(command<SetPort>({"plot", {"plot.height_max"}, {"3"}})));
  desktop.ticks(30);
  const auto broken = desktop.of(ProblemKind::rule);
  ASSERT_EQ(broken.size(), 2u);
  EXPECT_EQ(broken[0].subject, "Plot breaks a rule");
  EXPECT_NE(broken[0].text.find("of 3.0 m allowed, by `"), std::string::npos) << broken[0].text;
  EXPECT_EQ(broken[0].nodes.front(), "plot");
  EXPECT_EQ(broken[0].nodes.size(), 3u) << "with both volumes on it";
  EXPECT_NE(broken[1].text.find("so that however small it becomes"), std::string::npos) << broken[1].text;
}

// A garden that has less sun than it asks for is short of sun; no boundary is too small for it.
TEST(Problems, AGardenIsShortOfSun) {
  ListDesktop desktop("scenes/studies/tower_and_garden.json");
  desktop.ticks(80);
  const auto items = desktop.of(ProblemKind::shortage);
  ASSERT_EQ(items.size(), 1u);
  EXPECT_EQ(items[0].subject, "Garden is short of sun");
  EXPECT_EQ(items[0].nodes, std::vector<std::string>{"garden"});
  EXPECT_NE(items[0].text.find("where 100 % is asked for"), std::string::npos) << items[0].text;
}

TEST(Problems, ABoundaryThatIsTooSmallNamesTheLosers) {
  ListDesktop desktop(kListedQuarter);
  ASSERT_TRUE(desktop.editor().submit(command<SetPort>({"site", {"boundary.height"}, {"12"}})));
  desktop.ticks(25);
  const auto short_of = desktop.of(ProblemKind::shortage);
  ASSERT_FALSE(short_of.empty());
  bool names_a_use = false, names_the_solver = false, names_a_volume = false;
  for (const ProblemItem& item : short_of) {
    names_a_use = names_a_use || (item.subject.find("Not all") == 0 && item.text.find("missing:") != std::string::npos);
    names_the_solver = names_the_solver ||
                       (item.nodes == std::vector<std::string>{"solver"} && item.text.find("can be had") != std::string::npos);
    names_a_volume = names_a_volume || item.key.starts_with("volume/");
  }
  EXPECT_TRUE(names_a_use);
  EXPECT_TRUE(names_the_solver);
  EXPECT_TRUE(names_a_volume);
}

// What people have set by hand counts as what a brief asks: a cap over a thousand volumes leaves none of them "everybody has
// room".
TEST(Problems, WhatPeopleAskForByHandAndACapTakesIsShort) {
  ListDesktop desktop("scenes/studies/thousand_volumes.json");
  desktop.ticks(25);
  const auto short_of = desktop.of(ProblemKind::shortage);
  ASSERT_FALSE(short_of.empty());
  const auto housing =
      std::find_if(short_of.begin(), short_of.end(), [](const ProblemItem& i) { return i.key == "use/housing"; });
  ASSERT_NE(housing, short_of.end());
  EXPECT_NE(housing->text.find("asked for:"), std::string::npos) << housing->text;
  EXPECT_NE(housing->text.find("link `cap` leaves"), std::string::npos) << housing->text;
  EXPECT_NE(std::find(housing->nodes.begin(), housing->nodes.end(), "v0567"), housing->nodes.end());
  const reading::Accounts& accounts = desktop.record().figures(desktop.editor()).accounts;
  EXPECT_GT(accounts.worst_short, 0.1);
}

// The law: list, colours, statistics and report agree on who is short, whatever was set, in every tick.
TEST(ProblemsLaw, ListColoursStatisticsAndReportAgreeOnWhoIsShort) {
  for (const char* scene : {kListedQuarter, "scenes/studies/thousand_volumes.json", "scenes/studies/urban_mode.json"}) {
    ListDesktop desktop(scene);
    for (int round = 0; round < 3; ++round) {
      desktop.ticks(9);
      const State& state = desktop.editor().state();
      const auto facts = read_facts(desktop.editor().moment->state, nullptr);
      const Colouring fill = colour_volumes(*facts, "fill", desktop.editor().theme);
      const auto items = desktop.of(ProblemKind::shortage);
      reading::ReportModel page;
      reading::read_model(state, page);
      const auto& rows = desktop.record().figures(desktop.editor()).volumes;
      ASSERT_EQ(rows.size(), facts->volumes.size());
      ASSERT_EQ(rows.size(), page.volumes.size());
      for (std::size_t k = 0; k < rows.size(); ++k) {
        const bool is_short = rows[k].is_short(page.accounts.tolerance);
        EXPECT_EQ(facts->volumes[k].is_short(facts->tolerance), is_short) << rows[k].id;
        EXPECT_EQ(facts->volumes[k].standing(), page.volumes[k].standing()) << rows[k].id;
        if (!is_short) continue;
        EXPECT_NE(fill.colours[k], Theme::ramp(1)) << rows[k].id << " is short, and its colour says that it is full";
        const bool is_told = !rows[k].is_alive || std::any_of(items.begin(), items.end(), [&](const ProblemItem& item) {
          return item.key == "volume/" + rows[k].id ||
                 std::find(item.nodes.begin(), item.nodes.end(), rows[k].id) != item.nodes.end();
        });
        EXPECT_TRUE(is_told) << rows[k].id << " is short by " << rows[k].short_share() << " and the list does not say so";
      }
      for (const reading::UseAccount& use : page.accounts.uses) {
        if (!use.is_short(page.accounts.tolerance)) continue;
        EXPECT_TRUE(std::any_of(items.begin(), items.end(), [&](const ProblemItem& item) {
          return item.key == "use/" + use.use;
        })) << use.use;
      }
    }
  }
}

TEST(Problems, FailuresAndSwitchedOffLinksAreListedAndFiltered) {
  ListDesktop desktop(kListedQuarter);
  ASSERT_TRUE(desktop.editor().submit(command<SetPort>({"floor_area", {"statistics.port"}, {"\"\""}})));
  ASSERT_TRUE(desktop.editor().submit(command<MuteLink>({"library_cafe", true})));
  desktop.ticks(2);
  const auto failing = desktop.of(ProblemKind::failing);
  // The statistic, and the cap that follows from its figures.
  ASSERT_EQ(failing.size(), 2u);
  EXPECT_EQ(failing.front().nodes, std::vector<std::string>{"floor_area"});
  EXPECT_NE(failing.back().text.find("out of date"), std::string::npos) << failing.back().text;
  const auto idle = desktop.of(ProblemKind::idle);
  ASSERT_EQ(idle.size(), 1u);
  EXPECT_EQ(idle.front().links, std::vector<std::string>{"library_cafe"});
  desktop.press_on("problems/filter/Switched off");
  EXPECT_EQ(desktop.problems().filter, static_cast<int>(ProblemKind::idle));
  desktop.frames(1);
  desktop.press_on("problem/0");
  EXPECT_TRUE(desktop.editor().picks.links.contains("library_cafe"));
}

TEST(Problems, OfAnOldFileAreListedWithTheirPlace) {
  ListDesktop desktop("scenes/old/v1/everything.json");
  const auto file = desktop.of(ProblemKind::file);
  ASSERT_FALSE(file.empty());
  EXPECT_EQ(file.front().nodes, std::vector<std::string>{"flat-2"});
}

TEST(Problems, OfAFileThatCannotBeOpenedAreListedBesideTheOldScene) {
  ListDesktop desktop(kListedQuarter);
  const std::string path = ::testing::TempDir() + "panels_garbage.json";
  std::FILE* file = std::fopen(path.c_str(), "w");
  ASSERT_NE(file, nullptr);
  std::fputs("{\"format\": 7, \xff", file);
  std::fclose(file);
  EXPECT_FALSE(desktop.editor().open(path));
  desktop.frames(2);
  const auto listed = desktop.of(ProblemKind::file);
  ASSERT_FALSE(listed.empty());
  EXPECT_TRUE(listed.front().is_error);
  EXPECT_EQ(listed.front().subject, "panels_garbage.json");
}

TEST(Problems, OfAFileThatIsTriedAgainAreThoseOfNow) {
  ListDesktop desktop(kListedQuarter);
  const std::string path = ::testing::TempDir() + "panels_twice.json";
  ASSERT_TRUE(write_file(path, R"({"format": "behaviourlinks", "version": 999})"));
  EXPECT_FALSE(desktop.editor().open(path));
  desktop.frames(2);
  const auto first = desktop.of(ProblemKind::file);
  ASSERT_EQ(first.size(), 1u);
  ASSERT_TRUE(write_file(path, R"({"type": "FeatureCollection"})"));
  EXPECT_FALSE(desktop.editor().open(path));
  desktop.frames(2);
  const auto second = desktop.of(ProblemKind::file);
  ASSERT_EQ(second.size(), 1u);
  EXPECT_NE(second.front().text, first.front().text);
}

// Its solver has named a node that is no volume: the solver fails for it, and the list says so once.
TEST(Problems, ASolverWhoseMemberLacksAPortIsListedOnce) {
  ListDesktop desktop(kListedQuarter);
  ASSERT_TRUE(
      desktop.editor().submit(command<SetPort>({"solver", {"smart_volumes_solver.members"}, {R"(["library", "programme"])"}})));
  desktop.ticks(2);
  const auto failing = desktop.of(ProblemKind::failing);
  std::size_t of_solver = 0;
  for (const ProblemItem& item : failing) of_solver += item.nodes == std::vector<std::string>{"solver"} ? 1 : 0;
  EXPECT_EQ(of_solver, 1u);
}

TEST(Problems, RowsKeepTheirPlacesWhileASettledSceneTicks) {
  ListDesktop desktop(kListedQuarter);
  desktop.ticks(300);
  const auto order = [&] {
    std::string text;
    for (const ProblemItem& item : desktop.problems().items()) text += item.nodes.empty() ? "-" : item.nodes.front() + " ";
    return text;
  };
  const std::string before = order();
  int changes = 0;
  for (int k = 0; k < 30; ++k) {
    desktop.ticks(1);
    changes += order() == before ? 0 : 1;
  }
  EXPECT_EQ(changes, 0);
}

// What is listed follows from the state alone: who has watched every tick reads the same as who opens the scene now.
TEST(ProblemsLaw, TheListDoesNotDependOnWhatWasBefore) {
  const auto listed = [](const ProblemList& problems) {
    std::multiset<std::string> all;
    for (const ProblemItem& item : problems.items())
      all.insert(std::string(label_of(item.kind)) + " " + item.key + " " + (item.nodes.empty() ? "" : item.nodes.front()) + " " +
                 std::to_string(item.tense.ref.port));
    return all;
  };
  ListDesktop desktop(kListedQuarter);
  for (int tick = 1; tick <= 120; ++tick) {
    if (tick == 50) {
      ASSERT_TRUE(desktop.editor().submit(
          command<AddNode>({"guest", {R"({"position": [20, 20, 10], "types": {"smart_volume": {"use": "library"}}})"}})));
    }
    if (tick == 60) { ASSERT_TRUE(desktop.editor().submit(command<RemoveNode>({"guest"}))); }
    desktop.ticks(1);
    ProblemList fresh;
    fresh.refresh(desktop.editor(), desktop.record().figures(desktop.editor()));
    ASSERT_EQ(listed(desktop.problems()), listed(fresh)) << "tick " << tick;
  }
}

TEST(History, APressTakesBackAndBringsBack) {
  ListDesktop desktop(kListedQuarter);
  const std::string before = desktop.scene_text();
  for (const char* name : {"One", "Two", "Three"}) ASSERT_TRUE(desktop.editor().submit(command<RenameNode>({"library", name})));
  desktop.frames(1);  // the places of the boxes go into the last step
  const std::string after = desktop.scene_text();
  desktop.open_tab("History");
  desktop.press_on("step/1");
  EXPECT_EQ(desktop.editor().name_of("library"), "One");
  desktop.press_on("step/3");
  EXPECT_EQ(desktop.scene_text(), after);
  desktop.press_on("step/0");
  EXPECT_EQ(desktop.scene_text(), before);
  EXPECT_EQ(desktop.editor().document->history().size(), 3u);
}

TEST(Statistics, SamplesEveryTickAndForgetsWhatWasRewound) {
  ListDesktop desktop(kListedQuarter);
  for (int k = 0; k < 12; ++k) desktop.ticks(1);
  EXPECT_EQ(desktop.record().tick.size(), 13u);
  EXPECT_EQ(desktop.record().tick.back(), 12);
  EXPECT_GT(desktop.record().volume.back(), 1000);
  desktop.editor().document->session().rewind(5);
  desktop.frames(2);
  EXPECT_EQ(desktop.record().tick.back(), 7);
  EXPECT_EQ(desktop.record().tick.size(), 8u);
}

TEST(Statistics, AreGatheredWhileNobodyLooks) {
  ListDesktop desktop(kListedQuarter);
  desktop.editor().person.shows_bottom = false;
  desktop.frames(2);
  for (int k = 0; k < 6; ++k) desktop.ticks(1);
  desktop.editor().is_beamer = true;
  for (int k = 0; k < 6; ++k) desktop.ticks(1);
  EXPECT_EQ(desktop.record().tick.size(), 13u);
  const std::vector<reading::ErrorSample> errors = desktop.record().errors();
  ASSERT_EQ(errors.size(), 13u);
  EXPECT_EQ(errors.back().tick, 12);
  EXPECT_EQ(errors.back().worst_error, desktop.editor().state().largest_residual);
}

TEST(Statistics, APressOnABarChoosesItsVolume) {
  ListDesktop desktop(kListedQuarter);
  desktop.ticks(5);
  desktop.open_tab("Statistics");
  desktop.press_on("order/name");
  desktop.frames(2);
  const auto& volumes = desktop.record().figures(desktop.editor()).volumes;
  EXPECT_EQ(volumes[desktop.record().ordered(desktop.editor()).front()].id, "assisted_living");
  desktop.press_on("volume/assisted_living");
  EXPECT_EQ(desktop.editor().picks.nodes, std::set<std::string>{"assisted_living"});
}

// The garden keeps its sun, and takes two storeys from the tower: the brief says so below what the offices got.
TEST(Statistics, TheBriefSaysWhoTakesStoreys) {
  ListDesktop desktop("scenes/studies/tower_and_garden.json");
  desktop.ticks(80);
  desktop.open_tab("Statistics");
  EXPECT_TRUE(desktop.has("use/office/why"));
  EXPECT_FALSE(desktop.has("use/housing/why")) << "the houses have their storeys";
  EXPECT_NE(desktop.record().why["office"].find("Tower: 8 of 10 storeys: link `sun` (Solar right)"), std::string::npos)
      << desktop.record().why["office"];
}

// A row of open space has a line of its own, and a shortage that says what to do until there is ground enough.
TEST(Statistics, TheBriefShowsOpenSpace) {
  ListDesktop desktop(kListedQuarter);
  Workbench& editor = desktop.editor();
  const std::string row = R"({"use": "lawn", "floor_area": 200})", use = R"({"types": {"use": {"use": "lawn", "is_open": true}}})";
  ASSERT_TRUE(editor.submit(command<AddNode>({"use_lawn", {use}})));
  ASSERT_TRUE(editor.submit(command<AddRow>({"programme", {"programme.rows"}, {row}, -1})));
  desktop.ticks(4);
  desktop.open_tab("Statistics");
  EXPECT_TRUE(desktop.has("use/lawn"));
  EXPECT_TRUE(desktop.has("use/lawn/why"));
  const auto short_of_lawn = [&] {
    for (const ProblemItem& item : desktop.of(ProblemKind::shortage))
      if (item.key == "open/lawn") return item.text;
    return std::string();
  };
  EXPECT_NE(short_of_lawn().find("no boundary keeps ground open for it"), std::string::npos) << short_of_lawn();
  EXPECT_EQ(desktop.record().figures(editor).accounts.open.front().asked, 200);
  const auto uses = known_uses(editor.scene());
  EXPECT_EQ(std::count(uses.begin(), uses.end(), "lawn"), 0) << "no volume can have it";
  std::string corners;
  for (const char* at : {R"("x": 10, "y": 10)", R"("x": 30, "y": 10)", R"("x": 30, "y": 20)", R"("x": 10, "y": 20)"})
    corners += (corners.empty() ? "" : ", ") + std::string(R"({"name": "lawn", "use": "lawn", "bottom": 0, "top": 500, )") + at + "}";
  ASSERT_TRUE(editor.submit(command<SetPort>({"site", {"boundary.exclusions"}, {"[" + corners + "]"}})));
  desktop.ticks(4);
  EXPECT_EQ(short_of_lawn(), "");
  EXPECT_NEAR(desktop.record().figures(editor).accounts.open.front().area, 200, 1e-9);
}

// In another form bars and sums are those of that form.
TEST(Statistics, FollowTheFormThatIsDrawn) {
  ListDesktop desktop(kListedQuarter);
  desktop.ticks(60);
  desktop.editor().view->draw_as("slabs");
  desktop.open_tab("Statistics");
  const std::uint32_t library = desktop.editor().index_of("library");
  const auto figures = desktop.editor().view->form_figures(library);
  ASSERT_TRUE(figures);
  const auto& accounts = desktop.record().figures(desktop.editor()).accounts;
  const reading::VolumeAccount& own = accounts.volumes[accounts.row_of(library)];
  EXPECT_NE(figures->volume, own.volume);
  EXPECT_EQ(figures->floor_area, own.floor_area);
  desktop.editor().view->draw_as("as_is");
  desktop.frames(2);
  EXPECT_FALSE(desktop.editor().view->form_figures(library));
}

TEST(Statistics, AThousandVolumesAreDrawnOnlyWhereTheyAreSeen) {
  ListDesktop desktop("scenes/studies/thousand_volumes.json");
  desktop.open_tab("Statistics");
  std::size_t drawn = 0;
  for (const auto& [key, place] : memory_of(desktop.editor()).places) drawn += key.starts_with("volume/") ? 1 : 0;
  EXPECT_GT(drawn, 2u);
  EXPECT_LT(drawn, 60u);
}

}  // namespace
}  // namespace bl::desktop
