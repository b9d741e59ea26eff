// Lists of numbers in files: ports and columns that hold them, the digits of older files, and what is refused.
#include "core/define/list_json.h"

#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/define/codec.h"
#include "core/define/schema.h"

namespace bl {
namespace {

PortDefinition list_port() {
  PortDefinition port;
  port.id = "list";
  port.kind = ValueKind::numbers;
  port.default_value = Numbers();
  return port;
}

PortDefinition table_port() {
  PortDefinition port;
  port.id = "table";
  port.kind = ValueKind::table;
  port.columns = {{.id = "links", .list = ListOf::indices, .default_value = Indices(), .doc = ""},
                  {.id = "flows", .list = ListOf::numbers, .default_value = Numbers(), .doc = ""}};
  port.default_value = Shared<Table>();
  return port;
}

std::string refusal(const PortDefinition& port, const char* json) {
  const auto value = value_from_json(port, *parse_json(json), port.id);
  return value ? "" : value.error().text();
}

TEST(ListJson, APortOfNumbersIsAnArray) {
  const PortDefinition port = list_port();
  const Value value = Numbers({1, 2.5, -3e14});
  EXPECT_EQ(write_json_line(value_to_json(value, port)), "[1, 2.5, -3e+14]");
  EXPECT_TRUE(*value_from_json(port, *parse_json("[1, 2.5, -3e14]"), "list") == value);
  EXPECT_TRUE(*value_from_json(port, *parse_json("[]"), "list") == port.default_value);
}

TEST(ListJson, WhatIsNoListIsRefusedAtItsPlace) {
  const PortDefinition port = list_port();
  EXPECT_EQ(refusal(port, "[1, true]"), "list: expects a list of numbers, found [1, true]");
  EXPECT_EQ(refusal(port, "3"), "list: expects a list of numbers, found 3");
  EXPECT_EQ(refusal(port, "[0, 2e15]"), "list/1: must be between -1e15 and 1e15, found 2e+15");
  EXPECT_EQ(refusal(port, "\"no digits\""), "list: expects a list of numbers, found \"no digits\"");
  EXPECT_EQ(refusal(table_port(), R"([{"links": [1, -1]}])"),
            "table/0/links: expects a list of whole numbers from 0 to 16777215, found [1, -1]");
  EXPECT_EQ(refusal(table_port(), R"([{"links": [16777216]}])"),
            "table/0/links: expects a list of whole numbers from 0 to 16777215, found [16777216]");
}

TEST(ListJson, DigitsOfOlderFilesAreTheSameListWithTheSameHash) {
  const std::vector<double> flows{0.5, 1.0 / 3, 1e9};
  const std::vector<std::uint32_t> links{7, 65, 90000};
  Json row = {{"links", digits_of(links)}, {"flows", digits_of(flows)}};
  const Value old = *running_value_from_json(table_port(), Json::array({row}), "table");
  const Value now = Shared<Table>(Table{{"links", "flows"}, {{Indices(links), Numbers(flows)}}});
  EXPECT_TRUE(old == now);
  Hash as_digits, as_list;
  add_to(as_digits, Shared<Table>(Table{{"links", "flows"}, {{digits_of(links), digits_of(flows)}}}));
  add_to(as_list, now);
  EXPECT_EQ(as_digits.value(), as_list.value());
  const Json written = value_to_json(now, table_port());
  EXPECT_TRUE(written[0]["links"].is_array() && written[0]["flows"].is_array());
  EXPECT_TRUE(*running_value_from_json(table_port(), written, "table") == now);
}

TEST(ListJson, SchemasNameTheirItems) {
  EXPECT_EQ(value_schema(list_port())["items"]["type"], "number");
  const Json columns = value_schema(table_port())["items"]["properties"];
  EXPECT_EQ(columns["links"]["items"]["type"], "integer");
  EXPECT_EQ(columns["flows"]["items"]["type"], "number");
}

TEST(ListJson, ListsThatAreNotFiniteAreNotTakenIn) {
  Value list = Numbers({1, std::numeric_limits<double>::infinity()});
  EXPECT_FALSE(make_storable(list));
  Value table = Shared<Table>(Table{{"flows"}, {{std::get<Numbers>(list)}}});
  EXPECT_FALSE(make_storable(table));
}

}  // namespace
}  // namespace bl
