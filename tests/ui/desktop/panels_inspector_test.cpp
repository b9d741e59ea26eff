// The inspector, driven by keys and mouse on the null renderer.
#include "core/define/catalogue.h"
#include "core/reading/figures.h"
#include "tests/ui/desktop/panels_support.h"
#include "ui/desktop/panels/inspector_quantity.h"
#include "ui/desktop/panels/inspector_value.h"

namespace bl::desktop {
namespace {

constexpr const char* kInspectedQuarter = "scenes/start/quarter.json";

// A limit at the end of its range holds nobody back: the number that stands for it tells people nothing.
TEST(Quantities, ALimitThatIsNoneSaysSo) {
  const PortDefinition& limit = *full_registry().typification("smart_volume")->find_port("demand_limit");
  EXPECT_EQ(value_text(Value(1e9), limit, limit.unit), "none");
  EXPECT_EQ(value_text(Value(5000.0), limit, limit.unit), shown_number(5000, limit.unit));
  EXPECT_NE(facts_of(limit, limit.unit).find("default  none"), std::string::npos) << facts_of(limit, limit.unit);
  const PortDefinition& demand = *full_registry().typification("smart_volume")->find_port("demand");
  EXPECT_NE(value_text(Value(1e9), demand, demand.unit), "none") << "that much is asked for";
  PanelDesktop desktop(kInspectedQuarter);
  desktop.choose("library");
  ASSERT_TRUE(desktop.has("smart_volume.demand_limit"));
  desktop.type_into("smart_volume.demand_limit", "5000");
  EXPECT_EQ(desktop.number("library", "smart_volume", "demand_limit"), 5000);
  desktop.type_into("smart_volume.demand_limit", "none");
  EXPECT_EQ(desktop.number("library", "smart_volume", "demand_limit"), 1e9) << desktop.complaint();
}

// Of a building as well: a depth, a height and a ground that nobody has set are no lengths.
TEST(Quantities, NumbersThatStandForNoneSaySo) {
  const TypificationDefinition& footprint = *full_registry().typification("footprint");
  for (const auto& [id, value] : {std::pair{"depth", 1000.0}, {"wing_depth", 1000.0}, {"height_limit", 1e6}, {"ground", -1e4}}) {
    const PortDefinition& port = *footprint.find_port(id);
    EXPECT_EQ(value_text(Value(value), port, port.unit), "none") << id;
    EXPECT_NE(facts_of(port, port.unit).find("default  none"), std::string::npos) << id;
  }
  for (const char* id : {"border_distance", "setback", "aspect", "cellar_height"}) {
    const PortDefinition& port = *footprint.find_port(id);
    EXPECT_NE(value_text(port.default_value, port, port.unit), "none") << id;
  }
  EXPECT_NE(catalogue_page(footprint, full_registry()).find("| none, `1000` | from 3 to 1000 |"),
            std::string::npos);
}

TEST(Quantities, LongTimesAreSaidInMinutesAndHours) {
  const std::string blank = "\xC2\xA0";
  EXPECT_EQ(reading::quantity(90, Unit::second), "90.0" + blank + "s");
  EXPECT_EQ(reading::quantity(150, Unit::second), "2.50" + blank + "min");
  EXPECT_EQ(reading::quantity(-33138, Unit::second),
            "\xE2\x88\x92"
            "9.21" +
                blank + "h");
  EXPECT_EQ(reading::quantity(33138, Unit::metre),
            "33"
            "\xE2\x80\xAF"
            "138" +
                blank + "m");
  EXPECT_EQ(shown_number(30600, Unit::second), "8.5" + blank + "h");
  EXPECT_EQ(shown_number(35621, Unit::second), "9.895" + blank + "h");
  EXPECT_EQ(shown_number(60, Unit::second), "60" + blank + "s");
  EXPECT_EQ(typed_form(30600, Unit::second), "30600 s");
}

TEST(Inspector, ANumberWithTheWrongUnitIsRefusedWithAReason) {
  PanelDesktop desktop(kInspectedQuarter);
  desktop.choose("library");
  const std::string before = desktop.scene_text();
  desktop.type_into("smart_volume.demand", "0.4 ha");
  EXPECT_EQ(desktop.scene_text(), before);
  EXPECT_NE(desktop.complaint().find("square metres"), std::string::npos) << desktop.complaint();
  EXPECT_NE(desktop.complaint().find("cubic metres"), std::string::npos) << desktop.complaint();
  desktop.type_into("smart_volume.demand", "7200 m3");
  EXPECT_EQ(desktop.number("library", "smart_volume", "demand"), 7200);
  EXPECT_EQ(desktop.complaint(), "");
}

TEST(Inspector, NumbersTakeArithmeticAndUnits) {
  PanelDesktop desktop(kInspectedQuarter);
  desktop.choose("library");
  const auto now = [&] { return desktop.number("library", "smart_volume", "demand"); };
  desktop.type_into("smart_volume.demand", "1200*1.5");
  EXPECT_EQ(now(), 1800);
  desktop.type_into("smart_volume.demand", "+10%");
  EXPECT_DOUBLE_EQ(now(), 1980);
  desktop.type_into("smart_volume.demand", "0.4 ha * 3.2 m");
  EXPECT_DOUBLE_EQ(now(), 12800);
  desktop.type_into("smart_volume.demand", "/2");
  EXPECT_DOUBLE_EQ(now(), 6400);
  desktop.type_into("smart_volume.demand", "-5");
  EXPECT_DOUBLE_EQ(now(), 6400);
  EXPECT_NE(desktop.complaint().find("between 0 and"), std::string::npos) << desktop.complaint();
}

TEST(Inspector, EscapeKeepsTheOldValueAndTabGoesToTheNext) {
  PanelDesktop desktop(kInspectedQuarter);
  desktop.choose("library");
  const std::string before = desktop.scene_text();
  desktop.type_into("smart_volume.demand", "5", GLFW_KEY_ESCAPE);
  EXPECT_EQ(desktop.scene_text(), before);
  desktop.type_into("smart_volume.demand", "3000", GLFW_KEY_TAB);
  EXPECT_EQ(desktop.number("library", "smart_volume", "demand"), 3000);
  EXPECT_EQ(memory_of(desktop.editor()).typing.key, "smart_volume.demand_limit");
  desktop.frames(3);
  desktop.key(GLFW_KEY_A, true);
  desktop.type("5000");
  desktop.key(GLFW_KEY_ENTER);
  desktop.frames(2);
  EXPECT_EQ(desktop.number("library", "smart_volume", "demand_limit"), 5000);
}

TEST(Inspector, WhatIsTypedGoesWhereItWasMeantToWhenAnotherNodeIsChosen) {
  PanelDesktop desktop(kInspectedQuarter);
  desktop.choose("library");
  desktop.press_on("smart_volume.demand");
  desktop.frames(3);
  desktop.key(GLFW_KEY_A, true);
  desktop.type("4321");
  desktop.editor().picks.only_node("cafe");
  desktop.click({5, 5});
  desktop.frames(3);
  EXPECT_EQ(desktop.number("library", "smart_volume", "demand"), 4321);
  EXPECT_EQ(desktop.number("cafe", "smart_volume", "demand"), 1000);
}

TEST(Inspector, AScrubIsOneStep) {
  PanelDesktop desktop(kInspectedQuarter);
  desktop.choose("library");
  const std::string before = desktop.scene_text();
  const ImVec2 at = desktop.middle("smart_volume.demand");
  desktop.drag(at, {at.x + 40, at.y}, 0, 10);
  EXPECT_GT(desktop.number("library", "smart_volume", "demand"), 1000);
  EXPECT_EQ(desktop.steps(), 1u);
  desktop.editor().undo();
  EXPECT_EQ(desktop.scene_text(), before);
}

TEST(Inspector, EscapeEndsAScrubWithoutATrace) {
  PanelDesktop desktop(kInspectedQuarter);
  desktop.choose("library");
  const std::string before = desktop.scene_text();
  for (const char* field : {"smart_volume.demand", "node.position/x"}) {
    const ImVec2 at = desktop.middle(field);
    desktop.move_to(at);
    desktop.press();
    for (const float by : {10.0f, 20.0f, 40.0f}) desktop.move_to({at.x + by, at.y});
    EXPECT_NE(desktop.scene_text(), before) << field;
    desktop.key(GLFW_KEY_ESCAPE);
    EXPECT_EQ(desktop.scene_text(), before) << field;
    desktop.move_to({at.x + 60, at.y});
    EXPECT_EQ(desktop.scene_text(), before) << "it is over, though the button is still held";
    desktop.release();
    desktop.frames(3);
    EXPECT_EQ(desktop.scene_text(), before);
    EXPECT_TRUE(memory_of(desktop.editor()).typing.key.empty()) << "letting go is no click";
    EXPECT_EQ(desktop.editor().picks.nodes, std::set<std::string>{"library"}) << "Esc ends the drag, and no more";
    EXPECT_EQ(desktop.editor().document->history().size(), 0u);
    desktop.key(GLFW_KEY_Y, true);
    EXPECT_EQ(desktop.scene_text(), before) << "there is nothing to redo";
  }
  // The next drag is a step as ever, and steps before an abandoned one are undone and redone as ever.
  const ImVec2 at = desktop.middle("smart_volume.demand");
  desktop.drag(at, {at.x + 40, at.y}, 0, 10);
  EXPECT_EQ(desktop.steps(), 1u);
  const std::string after = desktop.scene_text();
  desktop.move_to(at);
  desktop.press();
  desktop.move_to({at.x - 30, at.y});
  desktop.key(GLFW_KEY_ESCAPE);
  desktop.release();
  EXPECT_EQ(desktop.scene_text(), after);
  desktop.editor().undo();
  EXPECT_EQ(desktop.scene_text(), before);
  desktop.editor().redo();
  EXPECT_EQ(desktop.scene_text(), after);
  desktop.editor().redo();
  EXPECT_EQ(desktop.scene_text(), after);
}

TEST(Inspector, SeveralNodesAreEditedInOneStep) {
  PanelDesktop desktop(kInspectedQuarter);
  desktop.editor().picks.nodes = {"library", "cafe", "hotel"};
  desktop.frames(2);
  const std::string before = desktop.scene_text();
  desktop.type_into("smart_volume.demand", "2500");
  desktop.type_into("smart_volume.use", "mixed");
  EXPECT_EQ(desktop.steps(), 2u);
  for (const char* node : {"library", "cafe", "hotel"}) EXPECT_EQ(desktop.number(node, "smart_volume", "demand"), 2500) << node;
  ASSERT_TRUE(desktop.editor().submit(command<SetPort>({"cafe", {"smart_volume.demand"}, {"1000"}})));
  desktop.frames(2);
  desktop.type_into("smart_volume.demand", "*2");
  EXPECT_EQ(desktop.number("cafe", "smart_volume", "demand"), 2000);
  EXPECT_EQ(desktop.number("hotel", "smart_volume", "demand"), 5000);
  while (desktop.steps() > 0) desktop.editor().undo();
  EXPECT_EQ(desktop.scene_text(), before);
}

TEST(Inspector, AFactorThatOneOfSeveralNodesCannotTakeLeavesItAlone) {
  PanelDesktop desktop(kInspectedQuarter);
  ASSERT_TRUE(desktop.editor().submit(command<SetPort>({"cafe", {"node.position"}, {"[0, 1, 2]"}})));
  ASSERT_TRUE(desktop.editor().submit(command<SetPort>({"hotel", {"node.position"}, {"[10, 1, 2]"}})));
  desktop.editor().picks.nodes = {"cafe", "hotel"};
  desktop.frames(2);
  desktop.type_into("node.position/x", "*1e308");  // ten times that is no number any more
  EXPECT_EQ(std::get<Vector3>(desktop.setting("cafe", "node", "position")), (Vector3{0, 1, 2}));
  EXPECT_EQ(std::get<Vector3>(desktop.setting("hotel", "node", "position")), (Vector3{10, 1, 2}));
}

TEST(Inspector, ASlowHandMovesSeveralWholeNumbers) {
  NullDesktop desktop("scenes/nodes/smart_volume.json");  // its own inspector is not drawn below
  PortDefinition port;
  port.kind = ValueKind::integer;
  port.soft_minimum = 0;
  port.soft_maximum = 20;  // a tenth for each pixel
  const Subject subject{"count", &port, Unit::count, std::int64_t{3}, true, false, false};
  std::int64_t few = 3, many = 7;
  const auto frame = [&] {
    ImGui::NewFrame();
    ImGui::SetNextWindowPos({0, 0});
    ImGui::Begin("fields");
    if (const auto change = number_field(desktop.editor(), subject, 200)) {
      few = std::get<std::int64_t>(change->make(few));
      many = std::get<std::int64_t>(change->make(many));
    }
    ImGui::End();
    ImGui::Render();
  };
  frame();
  frame();
  const ImVec4 place = memory_of(desktop.editor()).places.at("count");
  ImGuiIO& io = ImGui::GetIO();
  io.MousePos = {(place.x + place.z) / 2, (place.y + place.w) / 2};
  frame();
  frame();
  io.MouseDown[0] = true;
  frame();
  for (int k = 0; k < 60; ++k) {
    io.MousePos.x += 1;
    frame();
  }
  EXPECT_GE(few, 8);
  EXPECT_LE(few, 9) << "sixty pixels are six";
  EXPECT_EQ(many, few + 4) << "they stay as far apart as they were";
}

TEST(Inspector, FieldsThatGoUnderTheHandDoNotHoldItStill) {
  PanelDesktop desktop(kInspectedQuarter);
  Workbench& editor = desktop.editor();
  for (const bool is_typing : {false, true}) {
    ASSERT_TRUE(editor.submit(command<AddNode>({"passing", {R"({"types": {"smart_volume": {}}})"}})));
    desktop.choose("passing");
    const ImVec2 at = desktop.middle("smart_volume.demand");
    if (is_typing) {
      desktop.press_on("smart_volume.demand");
      desktop.frames(3);
      desktop.type("4");
    } else {
      desktop.move_to(at);
      desktop.press();
      desktop.move_to({at.x + 20, at.y});
      editor.undo();
    }
    editor.undo();
    ASSERT_FALSE(editor.scene().nodes.contains("passing"));
    desktop.frames(2);
    desktop.release();
    desktop.choose("library");
    EXPECT_TRUE(desktop.has("smart_volume.demand")) << is_typing;
    EXPECT_EQ(memory_of(editor).shown.nodes, std::set<std::string>{"library"}) << is_typing;
  }
}

TEST(Quantities, ManyPartsAreNotDeep) {
  std::string sum = "1";
  for (int k = 1; k < 200; ++k) sum += k % 2 != 0 ? "+(1)" : "+1";
  EXPECT_EQ(typed_number(sum, Unit::none, 0).value(), 200);
  EXPECT_FALSE(typed_number(std::string(200, '(') + "1" + std::string(200, ')'), Unit::none, 0).ok());
}

TEST(Quantities, RatesAreByTheHourHoweverTheyComeAbout) {
  const auto rate = [](const char* text) { return typed_number(text, Unit::per_hour, 0).value(); };
  EXPECT_DOUBLE_EQ(rate("600"), 600);
  EXPECT_DOUBLE_EQ(rate("600 1/h"), 600);
  EXPECT_DOUBLE_EQ(rate("2 * 600 1/h / 3"), 400);
  EXPECT_DOUBLE_EQ(rate("600 / (1 h)"), 600);
  EXPECT_DOUBLE_EQ(rate("1 / (6 s) + 20 1/h"), 620);
  EXPECT_DOUBLE_EQ(rate("10 m/s / (5 m)"), 7200);
  EXPECT_DOUBLE_EQ(typed_number("600 1/h * 2 h", Unit::count, 0).value(), 1200);
  EXPECT_DOUBLE_EQ(typed_number("1 / (600 1/h)", Unit::second, 0).value(), 6);
}

TEST(Inspector, ResetAndLock) {
  PanelDesktop desktop(kInspectedQuarter);
  desktop.choose("library");
  const std::string before = desktop.scene_text();
  desktop.type_into("smart_volume.demand", "2500");
  desktop.press_on("smart_volume.demand/reset");
  EXPECT_EQ(desktop.logic_text(), before);
  desktop.press_on("smart_volume.demand/lock");
  EXPECT_TRUE(desktop.editor().scene().nodes.at("library").locked.contains("smart_volume.demand"));
  desktop.press_on("smart_volume.demand/lock");
  EXPECT_EQ(desktop.logic_text(), before);
}

TEST(Inspector, TheTableOfTheBriefIsEditedByCell) {
  PanelDesktop desktop(kInspectedQuarter);
  desktop.choose("programme");
  desktop.press_on("programme.rows");
  desktop.frames(2);
  const auto rows = [&] { return *std::get<Shared<Table>>(desktop.setting("programme", "programme", "rows")); };
  desktop.type_into("programme.rows/0/floor_area", "0.5 ha");
  EXPECT_EQ(rows().number(0, "floor_area"), 5000);
  desktop.type_into("programme.rows/0/floor_area", "3 m");
  EXPECT_EQ(rows().number(0, "floor_area"), 5000);
  EXPECT_NE(desktop.complaint(), "");
  const std::size_t count = rows().rows.size();
  desktop.press_on("programme.rows/add");
  EXPECT_EQ(rows().rows.size(), count + 1);
  desktop.press_on("programme.rows/0/remove");
  EXPECT_EQ(rows().rows.size(), count);
  EXPECT_EQ(rows().text(0, "use"), "student housing");
}

TEST(Inspector, RenamesAndGivesAndTakesRoles) {
  PanelDesktop desktop(kInspectedQuarter);
  desktop.choose("library");
  const std::string before = desktop.scene_text();
  desktop.type_into("name", "Reading room");
  EXPECT_EQ(desktop.editor().name_of("library"), "Reading room");
  desktop.press_on("add role");
  desktop.frames(2);
  desktop.type("control");
  desktop.press_on("entry/Control");
  desktop.frames(2);
  EXPECT_TRUE(desktop.editor().scene().nodes.at("library").types.contains("control"));
  desktop.key(GLFW_KEY_ESCAPE);
  desktop.frames(2);
  desktop.press_on("section/control/remove");
  EXPECT_FALSE(desktop.editor().scene().nodes.at("library").types.contains("control"));
  while (desktop.steps() > 0) desktop.editor().undo();
  EXPECT_EQ(desktop.scene_text(), before);
}

TEST(Inspector, LinksStrengthEndsAndParameters) {
  PanelDesktop desktop(kInspectedQuarter);
  desktop.choose_link("library_cafe");
  const auto link = [&] { return desktop.editor().scene().links.at("library_cafe"); };
  desktop.type_into("strength", "40%");
  EXPECT_DOUBLE_EQ(link().strength, 0.4);
  desktop.type_into("strength", "2");
  EXPECT_DOUBLE_EQ(link().strength, 0.4);
  EXPECT_NE(desktop.complaint(), "");
  desktop.press_on("swap");
  EXPECT_EQ(link().from.ids, std::vector<std::string>{"cafe"});
  desktop.press_on("to");
  desktop.frames(2);
  desktop.type("hotel");
  desktop.press_on("entry/Hotel  hotel");
  desktop.frames(2);
  EXPECT_EQ(link().to.ids, (std::vector<std::string>{"hotel", "library"}));
  desktop.click({1300, 2390});  // beside the list closes it
  desktop.frames(2);
  desktop.type_into("parameter.rest", "30 m");
  EXPECT_EQ(as_number(link().parameters.at("rest")), 30);
  desktop.press_on("muted");
  EXPECT_TRUE(link().is_muted);
}

TEST(Inspector, SettingsOfTheScene) {
  PanelDesktop desktop(kInspectedQuarter);
  desktop.type_into("settings.title", "Another quarter");
  EXPECT_EQ(settings_of(desktop.editor().scene()).title, "Another quarter");
  desktop.type_into("settings.tolerance", "5%");
  EXPECT_DOUBLE_EQ(settings_of(desktop.editor().scene()).tolerance, 0.05);
}

TEST(Inspector, AnExpressionDrivesANumberInOneStep) {
  PanelDesktop desktop(kInspectedQuarter);
  desktop.choose("library");
  const std::string before = desktop.scene_text();
  desktop.move_to(desktop.middle("smart_volume.storey_height"));
  desktop.press_on("smart_volume.storey_height/drive");
  ASSERT_EQ(desktop.steps(), 1u);
  const std::string id = *desktop.editor().picks.nodes.begin();
  EXPECT_TRUE(desktop.editor().scene().nodes.at(id).types.contains("expression"));
  desktop.ticks(4);
  EXPECT_FALSE(has_failure(desktop.editor().state()));
  desktop.editor().undo();
  EXPECT_EQ(desktop.scene_text(), before);
}

}  // namespace
}  // namespace bl::desktop
