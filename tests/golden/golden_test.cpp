// Runs every shipped scene and compares its trace with the one kept beside this file; BL_UPDATE_GOLDEN=1 rewrites them.
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include <gtest/gtest.h>

#include "core/base/text.h"
#include "core/file/file_io.h"
#include "tests/support/place/source_folder.h"
#include "tests/support/scene_files.h"
#include "tests/support/world.h"

namespace bl {
namespace {

std::string golden_path(const std::string& scene) {
  std::string name = scene.substr(std::string("scenes/").size());
  for (char& c : name)
    if (c == '/') c = '-';
  return test::source_folder() + "/tests/golden/" + name.substr(0, name.size() - 5) + ".trace";
}

// One line for some of the first ticks: what moves, what is missing, and the hash of everything.
std::string trace_of(const std::string& scene) {
  World world = World::from_file(scene);
  std::string trace = "tick largest_residual largest_move hash\n";
  const int last = scene.starts_with("scenes/studies/") ? 10 : 100;
  for (int tick = 1; tick <= last; ++tick) {
    world.tick();
    if (tick != 1 && tick != 2 && tick != 5 && tick % 10 != 0) continue;
    const State& state = world.state();
    trace += std::to_string(state.tick) + " " + shortest(state.largest_residual) + " " + shortest(state.largest_move) + " " +
             hex_digits(state.hash) + "\n";
  }
  return trace;
}

class Golden : public testing::TestWithParam<std::string> {};

TEST_P(Golden, TraceIsAsKept) {
  const std::string path = golden_path(GetParam()), trace = trace_of(GetParam());
  if (std::getenv("BL_UPDATE_GOLDEN") != nullptr) {
    ASSERT_TRUE(write_file(path, trace).ok());
    return;
  }
  const auto kept = read_file(path);
  ASSERT_TRUE(kept.ok()) << kept.error().text() << "; write it with BL_UPDATE_GOLDEN=1 and look at the difference";
  EXPECT_EQ(trace, *kept);
}

std::string test_name(const testing::TestParamInfo<std::string>& test) {
  std::string name = test.param;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Scenes, Golden, testing::ValuesIn(shipped_scenes()), test_name);

}  // namespace
}  // namespace bl
