// Messages: what is written is read again, what is wrong has its place, and the schema names every field.
#include "core/wire/messages.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/file/file_io.h"
#include "core/room/refusals.h"
#include "core/wire/operations.h"
#include "tests/support/place/source_folder.h"

namespace bl::wire {
namespace {

TEST(Messages, OperationsAreReadFromTheirFrames) {
  const auto read = [](const char* text) { return read_operation(*read_frame(text), "r"); };
  const room::Operation op = read(
      R"({"t": "op", "id": 3, "gesture": 2, "c": {"command": "x"}, "if": [{"key": "nodes/a/name", "was": "A"}], "draft": "d"})");
  EXPECT_EQ(op.id, 3);
  EXPECT_EQ(op.run, "r");
  EXPECT_EQ(op.gesture, 2);
  EXPECT_EQ(op.draft, "d");
  EXPECT_EQ(op.content.text(), R"({"command": "x"})");
  ASSERT_EQ(op.conditions.size(), 1u);
  EXPECT_EQ(op.conditions[0].was.text(), "\"A\"");
  EXPECT_EQ(read(R"({"t": "room", "id": 1, "e": {"event": "x"}})").kind, room::OperationKind::event);
  EXPECT_EQ(read(R"({"t": "undo", "id": 1, "of": 4})").content.text(), R"({"of": 4})");
  EXPECT_EQ(read(R"({"t": "rewind", "id": 1, "to": 4})").kind, room::OperationKind::rewind);
  EXPECT_EQ(read(R"({"t": "draft", "id": 1, "do": "drop", "draft": "d"})").kind, room::OperationKind::draft_drop);
}

TEST(Messages, WhatIsWrongKeepsItsNumberAndGetsAReason) {
  const auto why = [](const char* text) {
    const room::Operation read = read_operation(*read_frame(text), "r");
    return std::to_string(read.id) + " " + (read.unreadable ? read.unreadable->place + ": " + read.unreadable->text : "");
  };
  EXPECT_EQ(why(R"({"t": "op", "id": 4})"), "4 : `op` needs `c`");
  EXPECT_EQ(why(R"({"t": "op", "id": 4, "c": {}, "colour": 1})").substr(0, 9), "4 colour:");
  EXPECT_EQ(why(R"({"t": "op", "id": 4, "c": {}, "if": 3})"), "4 if: expects a list of {\"key\", \"was\"}");
  EXPECT_EQ(why(R"({"t": "rewind", "id": "x", "to": 1})").substr(0, 5), "0 id:");
  EXPECT_FALSE(read_frame("[1]").ok());
  EXPECT_FALSE(read_frame(R"({"t": 3})").ok());
  EXPECT_FALSE(read_frame("{\"t\": \"op\", \"c\": " + std::string(40, '[') + std::string(40, ']') + "}").ok());
}

TEST(Messages, AnswersAreWritten) {
  EXPECT_EQ(write_answer(3, room::Acknowledgement{17, 4}), R"({"t": "ack", "id": 3, "s": 17, "k": 4})");
  EXPECT_EQ(write_answer(3, room::refuse(room::Reason::area, "nodes/a", "no", {{"holder", "Bea"}})),
            R"({"t": "nack", "id": 3, "why": "area", "place": "nodes/a", "text": "no", "args": {"holder": "Bea"}})");
}

TEST(Messages, TheSchemaHasEveryMessageAndField) {
  const Json schema = message_schema();
  for (const MessageDefinition* kind : message_kinds()) {
    const Json& one = schema["$defs"][kind->is_from_page ? "from_page" : "from_server"][kind->id];
    ASSERT_TRUE(one.is_object()) << kind->id;
    EXPECT_FALSE(kind->doc.empty()) << kind->id;
    for (const PortDefinition& port : kind->ports) {
      EXPECT_TRUE(one["properties"].contains(port.id)) << kind->id << " " << port.id;
      EXPECT_FALSE(port.doc.empty()) << kind->id << " " << port.id;
    }
  }
}

TEST(Messages, ThePageHasTheTypesOfEveryMessage) {
  const std::string types = message_types();
  for (const MessageDefinition* kind : message_kinds()) {
    EXPECT_NE(types.find("    t: \"" + kind->id + "\";\n"), std::string::npos) << kind->id;
    for (const PortDefinition& port : kind->ports)
      EXPECT_NE(types.find("    " + port.id + (port.is_required ? ": " : "?: ")), std::string::npos)
          << kind->id << " " << port.id;
  }
  EXPECT_NE(types.find("    mains?: \"unknown\" | \"yes\" | \"no\";\n"), std::string::npos);
  EXPECT_NE(types.find("    views?: string[];\n"), std::string::npos);
  EXPECT_NE(types.find("    verdicts: unknown;\n"), std::string::npos);
  const auto kept = read_file(test::source_folder() + "/ui/web/src/messages.ts");
  ASSERT_TRUE(kept) << kept.error().text();
  EXPECT_EQ(types + "\n", *kept) << "make it anew: behaviourlinks schema --messages --typescript >ui/web/src/messages.ts";
}

}  // namespace
}  // namespace bl::wire
