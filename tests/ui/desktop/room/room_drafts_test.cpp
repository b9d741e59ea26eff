// Drafts in the window: begun, worked in, left, entered again and proposed; and the plan of a proposal for whoever leads.
#include <nlohmann/json.hpp>

#include "tests/ui/desktop/room/room_window.h"
#include "ui/desktop/panels/plan_picture.h"

namespace bl::desktop {
namespace {

std::string name_at(const Scene& scene, const std::string& node) { return scene.nodes.find(node)->second.name; }

TEST(RoomDrafts, AreBegunWorkedInLeftAndProposed) {
  const Deadline deadline(300, "a draft in the window");
  serve::RunningServer server;
  RoomWindow lead(address_of(server, "facilitator"), {2000, 1600}), anna(address_of(server, "designer"), {2000, 1600});
  ASSERT_TRUE(frames_until({&lead, &anna}, [&] {
    return lead.room().standing().has_scene && anna.room().standing().has_scene && agenda_of(lead.room()).is_known;
  }));
  lead.room().say_event("set_phase", JsonValue::of({{"name", "Look"}, {"activities", {"comment"}}}));
  for (RoomWindow* window : {&lead, &anna}) {
    window->editor().person.bottom_height = 1100;
    open_tab(*window);
  }
  ASSERT_TRUE(frames_until({&lead, &anna}, [&] { return agenda_of(anna.room()).phase == "Look"; }));
  press(anna, "roompanel/draft/begin");
  EXPECT_EQ(anna.room().draft(), nullptr) << "not in this phase";
  lead.room().say_event("set_phase", JsonValue::of({{"name", "Work"}, {"activities", {"draft"}}}));
  ASSERT_TRUE(frames_until({&lead, &anna}, [&] { return agenda_of(anna.room()).may.contains("draft"); }));
  memory_of(anna.editor()).room_texts["roompanel/draft/new"] = "Larger";
  press(anna, "roompanel/draft/begin");
  ASSERT_NE(anna.room().draft(), nullptr);
  const std::string draft = anna.room().draft()->id();
  const std::string before = name_at(anna.editor().scene(), "cafe");
  ASSERT_TRUE(anna.editor().submit(command<RenameNode>({"cafe", "Anna's"})));
  const JsonValue demand = JsonValue::of(9000);
  ASSERT_TRUE(anna.editor().submit(command<SetPort>({"cafe", {"smart_volume.demand"}, demand})));
  anna->frames(2);
  EXPECT_TRUE(has_place(anna, "view/draft")) << "the view says that this is a draft";
  EXPECT_EQ(name_at(anna.editor().scene(), "cafe"), "Anna's");
  ASSERT_TRUE(frames_until({&lead, &anna}, [&] {
    const Agenda agenda = agenda_of(anna.room());
    return agenda.drafts.size() == 1 && agenda.drafts[0].steps.size() == 2;
  })) << notices_of(anna.editor());
  EXPECT_EQ(name_at(lead.editor().scene(), "cafe"), before) << "nobody else sees it";
  press(anna, "roompanel/draft/leave");
  EXPECT_EQ(anna.room().draft(), nullptr);
  EXPECT_EQ(name_at(anna.editor().scene(), "cafe"), before);
  anna->frames(2);
  EXPECT_FALSE(has_place(anna, "view/draft"));
  press(anna, "roompanel/draft/" + draft + "/enter");
  ASSERT_NE(anna.room().draft(), nullptr);
  EXPECT_EQ(name_at(anna.editor().scene(), "cafe"), "Anna's");
  memory_of(anna.editor()).room_texts["roompanel/draft/" + draft + "/why"] = "It is too small";
  press(anna, "roompanel/draft/" + draft + "/propose");
  EXPECT_EQ(anna.room().draft(), nullptr);
  // Whoever leads sees it with its plan.
  ASSERT_TRUE(frames_until({&lead, &anna}, [&] { return has_place(lead, "roompanel/plan_of/" + draft); }));
  const Agenda agenda = agenda_of(lead.room());
  ASSERT_EQ(agenda.proposals.size(), 1u);
  EXPECT_EQ(agenda.proposals[0].title, "Larger");
  EXPECT_EQ(agenda.proposals[0].why, "It is too small");
  EXPECT_TRUE(frames_until({&lead, &anna}, [&] {
    const PlanPicture now = plan_in(lead.room().plan(), ""), with = plan_in(lead.room().view("draft_plans"), draft + "/");
    return differing_volumes(now, with).contains("cafe");
  })) << "a larger demand gives a larger outline";
}

TEST(RoomDrafts, OneIsDiscardedAfterAQuestion) {
  const Deadline deadline(300, "a draft that is discarded");
  serve::RunningServer server;
  RoomWindow lead(address_of(server, "facilitator"), {2000, 1600});
  ASSERT_TRUE(frames_until({&lead}, [&] { return lead.room().standing().has_scene && agenda_of(lead.room()).is_known; }));
  lead.editor().person.bottom_height = 1100;
  open_tab(lead);
  press(lead, "roompanel/draft/begin");
  ASSERT_NE(lead.room().draft(), nullptr) << "whoever leads may draft in every phase";
  const std::string key = "roompanel/draft/" + lead.room().draft()->id() + "/discard";
  ASSERT_TRUE(frames_until({&lead}, [&] { return agenda_of(lead.room()).drafts.size() == 1; }));
  press(lead, key);
  EXPECT_NE(lead.room().draft(), nullptr) << "it is asked before";
  press(lead, key + "/yes");
  EXPECT_EQ(lead.room().draft(), nullptr);
  EXPECT_TRUE(frames_until({&lead}, [&] { return agenda_of(lead.room()).drafts.empty(); }));
}

TEST(PlanPictures, PathsAreReadAsRoomsWriteThem) {
  const auto lines = lines_of_path("M1 2l3 0l-0.5 4zM10 -10l1 1");
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].points, (std::vector<PlanPoint>{{1, 2}, {4, 2}, {3.5, 6}}));
  EXPECT_TRUE(lines[0].is_closed);
  EXPECT_EQ(lines[1].points, (std::vector<PlanPoint>{{10, -10}, {11, -9}}));
  EXPECT_FALSE(lines[1].is_closed);
}

TEST(PlanPictures, VolumesAreFilledAroundTheirCourtyards) {
  const auto area_of = [](const std::vector<PlanPoint>& corners) {
    double area = 0;
    for (std::size_t k = 0; k + 2 < corners.size(); k += 3)
      area += std::abs((corners[k + 1].x - corners[k].x) * (corners[k + 2].y - corners[k].y) -
                       (corners[k + 2].x - corners[k].x) * (corners[k + 1].y - corners[k].y)) /
              2;
    return area;
  };
  // A block with a courtyard, an L beside it, and a street, which is no area.
  const std::string block = "M0 0l0 -10l10 0l0 10zM2 -2l6 0l0 -6l-6 0z", ell = "M20 0l0 -10l4 0l0 6l6 0l0 4z";
  EXPECT_NEAR(area_of(filled(lines_of_path(block))), 64, 1e-9);
  EXPECT_NEAR(area_of(filled(lines_of_path(block + ell))), 64 + 64, 1e-9);
  EXPECT_TRUE(filled(lines_of_path("M0 0l10 0l0 5")).empty());
}

TEST(PlanPictures, FaultsEndAPathAndHarmNothing) {
  for (const char* path : {"", "z", "l1 2", "M", "M1", "Mx y", "M1 nan", "M1 1e999", "?", "MMMM", "M 1"})
    EXPECT_TRUE(lines_of_path(path).empty()) << path;
  const auto lines = lines_of_path("M1 2l3 4l5");
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].points.size(), 2u) << "what was read before stays";
}

TEST(PlanPictures, VolumesDifferThatAreGoneOrNewOrElsewhere) {
  const auto plan = [](const std::map<std::string, std::string>& outlines) {
    std::map<std::string, JsonValue> view;
    for (const auto& [id, d] : outlines)
      view.emplace("d/n/" + id, JsonValue::of({{"kind", id.starts_with("plot") ? "plot" : "volume"}, {"d", d}}));
    view.emplace("e/n/other", JsonValue::of({{"kind", "volume"}, {"d", "M0 0l1 1z"}}));
    return plan_in(view, "d/");
  };
  const PlanPicture one = plan({{"a", "M0 0l1 0l0 1z"}, {"b", "M0 0l1 0l0 1z"}, {"plot", "M0 0l9 0l0 9z"}});
  const PlanPicture other =
      plan({{"a", "M0 0l1 0l0 1z"}, {"b", "M0 0l2 0l0 1z"}, {"c", "M5 5l1 0l0 1z"}, {"plot", "M0 0l8 0l0 9z"}});
  EXPECT_EQ(one.size(), 3u) << "of this draft only";
  EXPECT_TRUE(differing_volumes(one, one).empty());
  EXPECT_EQ(differing_volumes(one, other), (std::set<std::string>{"b", "c"}));
  EXPECT_EQ(differing_volumes(one, other), differing_volumes(other, one));
}

}  // namespace
}  // namespace bl::desktop
