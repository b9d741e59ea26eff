// Law: the JSON Schema accepts exactly the files whose form the reader accepts, judged by an independent validator.
#include <cstdio>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/random.h"
#include "core/define/schema.h"
#include "core/file/file_io.h"
#include "tests/support/place/source_folder.h"
#include "tests/support/scene_files.h"
#include "tests/support/world.h"

namespace bl {
namespace {

// Values that are wrong nearly everywhere, right somewhere.
Json odd_value(Random& random) {
  static const std::vector<Json> kOdd = {nullptr,
                                         true,
                                         0,
                                         -1,
                                         3.5,
                                         1e14,
                                         "",
                                         "housing",
                                         "a.b",
                                         Json::array(),
                                         Json::object(),
                                         Json::array({1, 2, 3}),
                                         Json::array({"a", "b"}),
                                         {{"tag", "x"}},
                                         {{"typification", ""}},
                                         {{"surprise", 1}}};
  return kOdd[random.below(kOdd.size())];
}

// Walks down at random and changes one thing.
void mutate(Json& json, Random& random) {
  if (!json.is_structured() || json.empty() || random.below(6) == 0) {
    json = odd_value(random);
    return;
  }
  auto it = json.begin();
  std::advance(it, static_cast<std::ptrdiff_t>(random.below(json.size())));
  switch (json.is_object() ? random.below(8) : 9) {
    case 0: json.erase(it); return;
    case 1: json["surprise"] = odd_value(random); return;
    case 2: json[it.key() + "x"] = odd_value(random); return;
    default: mutate(*it, random);
  }
}

// What a schema cannot know: the rest of the scene, and other revisions of types.
bool needs_the_scene(ErrorCode code) {
  return code == ErrorCode::duplicate || code == ErrorCode::not_found || code == ErrorCode::version;
}

TEST(SchemaLaws, TheSchemaAcceptsWhatTheReaderAccepts) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / ("bl_schema_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  const std::string schema = (folder / "schema.json").string(), documents = (folder / "documents.jsonl").string();
  ASSERT_TRUE(write_file(schema, write_json(scene_schema(full_registry(), settings_type(), kSceneVersion))).ok());
  std::string lines;
  std::vector<std::pair<bool, std::string>> expected;
  Random random(31);
  for (const std::string& path : small_scenes()) {
    const Json good = *parse_json(project_file(path));
    if (good.contains("state")) continue;
    for (int i = 0; i < 60; ++i) {
      Json json = good;
      for (int edits = i == 0 ? 0 : 1 + i % 2; edits > 0; --edits) mutate(json, random);
      const std::string text = write_json_line(json);
      const SceneReading reading = read_scene(text, full_registry());
      // Problems of the whole scene are only looked for in a well-formed one.
      if (!reading.is_usable() && needs_the_scene(reading.first_error().code)) continue;
      if (!reading.is_usable() && reading.first_error().code == ErrorCode::wrong_unit) continue;
      lines += text + "\n";
      expected.emplace_back(reading.is_usable(), reading.is_usable() ? path : path + ": " + reading.first_error().text());
    }
  }
  ASSERT_TRUE(write_file(documents, lines).ok());
  const std::string command =
      "/usr/bin/python3 '" + test::source_folder() + "/tests/laws/schema_check.py' '" + schema + "' '" + documents + "'";
  std::FILE* pipe = ::popen(command.c_str(), "r");
  ASSERT_NE(pipe, nullptr);
  char verdict[64];
  std::size_t at = 0, accepted = 0;
  std::vector<std::string> all;
  for (std::size_t begin = 0; begin < lines.size(); begin = lines.find('\n', begin) + 1)
    all.push_back(lines.substr(begin, lines.find('\n', begin) - begin));
  for (; std::fgets(verdict, sizeof verdict, pipe) != nullptr && at < expected.size(); ++at) {
    const bool is_valid = std::string_view(verdict) == "valid\n";
    accepted += is_valid ? 1 : 0;
    EXPECT_EQ(is_valid, expected[at].first) << expected[at].second << "\n" << all[at].substr(0, 3000);
  }
  EXPECT_EQ(::pclose(pipe), 0) << "the package python3-jsonschema is needed";
  EXPECT_EQ(at, expected.size());
  EXPECT_GT(accepted, 50u);
  EXPECT_LT(accepted, expected.size() - 100);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace bl
