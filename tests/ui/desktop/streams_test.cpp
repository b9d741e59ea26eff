// Sensors and actuators show their last value with its age and quality, on the canvas and in the 3D view alike.
#include "core/live/commands.h"
#include "tests/ui/desktop/import_support.h"
#include "ui/desktop/panels/canvas/model.h"
#include "ui/desktop/panels/stream_text.h"
#include "ui/desktop/shell/live_scene.h"

namespace bl::desktop {
namespace {

class StreamTest : public ::testing::Test {
 protected:
  explicit StreamTest() : folder("streams") {
    folder.write("scene.json", R"({"format": "behaviourlinks", "version": 1, "nodes": [
      {"id": "lamp", "name": "Lamp", "position": [20, 0, 0], "types": {"actuator": {"value": 0.5, "address": "osc://127.0.0.1:39417/lamp", "interval": 0.02}}},
      {"id": "warmth", "name": "Warmth", "types": {"sensor": {"address": "mqtt://127.0.0.1/warmth", "unit": "°C", "scale": 0.1, "timeout": 3, "tick_length": 1}}}], "links": []})");
    EXPECT_TRUE(desktop.editor().open(folder.at("scene.json")));
    desktop.frames(2);
  }
  void submit(const Command& command, const std::string& author) {
    ASSERT_TRUE(desktop.editor().document->session().submit({.command = command, .author = {author, AuthorKind::device}}));
  }
  void receive(double value, const std::string& problem = "") {
    submit(command<live::Receive>({"warmth", value, "noon", problem, desktop.editor().state().tick + 1}),
           "mqtt://127.0.0.1/warmth");
  }
  StreamText of(const std::string& node) {
    const Workbench& editor = desktop.editor();
    const auto found = stream_of(editor, editor.state(), editor.index_of(node));
    EXPECT_TRUE(found) << node;
    return found.value_or(StreamText{});
  }
  Folder folder;
  ImportDesktop desktop;
};

TEST_F(StreamTest, AReadingAgesTickByTick) {
  desktop.ticks(1);
  EXPECT_EQ(of("warmth").standing, StreamStanding::silent);
  EXPECT_EQ(of("warmth").age, "no reading yet");
  receive(214);
  desktop.ticks(1);
  EXPECT_EQ(of("warmth").text(), "21.4 °C, just now");
  EXPECT_EQ(of("warmth").standing, StreamStanding::good);
  desktop.ticks(3);
  EXPECT_EQ(of("warmth").text(), "21.4 °C, 3 s old");
  EXPECT_EQ(of("warmth").standing, StreamStanding::good);
  desktop.ticks(1);
  EXPECT_EQ(of("warmth").text(), "21.4 °C, 4 s old, stale");
  EXPECT_EQ(of("warmth").standing, StreamStanding::stale);
}

TEST_F(StreamTest, WhatIsLostIsSaidInWords) {
  receive(214);
  desktop.ticks(1);
  submit(command<live::NoteConnection>({"warmth", "the broker does not answer"}), "mqtt://127.0.0.1/warmth");
  desktop.ticks(2);
  EXPECT_EQ(of("warmth").standing, StreamStanding::lost);
  EXPECT_EQ(of("warmth").quality, "line lost");
  EXPECT_NE(of("warmth").message.find("the broker does not answer"), std::string::npos);
  submit(command<live::NoteConnection>({"warmth", ""}), "mqtt://127.0.0.1/warmth");
  receive(0, "the message is no number");
  desktop.ticks(1);
  EXPECT_EQ(of("warmth").standing, StreamStanding::lost);
  EXPECT_EQ(of("warmth").quality, "invalid");
  EXPECT_EQ(of("warmth").value, "21.4 °C") << "the last good value stays";
}

TEST_F(StreamTest, AnActuatorSaysWhetherItIsHeard) {
  desktop.ticks(1);
  EXPECT_EQ(of("lamp").text(), "0.500, not connected");
  EXPECT_EQ(of("lamp").standing, StreamStanding::silent);
  LiveScene live(desktop.editor(), true);
  Workbench& editor = desktop.editor();
  editor.document->session().play(true);
  // OSC is sent without an answer; the connection's own thread sends it.
  for (int k = 0; k < 5000 && (editor.deliveries["lamp"].sent_at < 0); ++k) {
    desktop.frames(1);
    live.frame();
  }
  editor.document->session().play(false);
  desktop.frames(1);
  EXPECT_EQ(of("lamp").standing, StreamStanding::good);
  EXPECT_TRUE(of("lamp").age.starts_with("sent ")) << of("lamp").age;
  desktop.frames(60 * 5);
  EXPECT_EQ(of("lamp").age, "sent 5 s ago");
  ASSERT_TRUE(editor.submit(command<SetPort>({"lamp", {"actuator.is_on"}, {"false"}})));
  desktop.ticks(1);
  EXPECT_EQ(of("lamp").age, "off");
}

TEST_F(StreamTest, TheBoxHasALineForIt) {
  canvas::Model model;
  model.update(desktop.editor());
  for (const char* id : {"lamp", "warmth"}) {
    const canvas::NodeBox& box = model.boxes.at(model.find_box(id));
    ASSERT_EQ(box.sections.size(), 1u);
    EXPECT_TRUE(box.sections.front().is_stream);
    ASSERT_EQ(box.sections.front().rows.size(), 1u) << "what the wire has written stands in the line of the stream";
    EXPECT_EQ(box.sections.front().rows.front().label, "address");
  }
}

TEST(StreamAge, IsWrittenInTheUnitThatTells) {
  EXPECT_EQ(age_text(0), "0 s");
  EXPECT_EQ(age_text(3.9), "3 s");
  EXPECT_EQ(age_text(119), "119 s");
  EXPECT_EQ(age_text(600), "10 min");
  EXPECT_EQ(age_text(3 * 3600), "3 h");
  EXPECT_EQ(age_text(3 * 86400), "3 days");
}

}  // namespace
}  // namespace bl::desktop
