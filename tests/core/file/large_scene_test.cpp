// Large scenes take time in proportion to their size, to read, to write, and to say no to.
#include <algorithm>

#include <gtest/gtest.h>

#include "core/session/ledger.h"
#include "tests/support/processor_time.h"
#include "tests/support/world.h"

namespace bl {
namespace {

std::string nodes_of(int count) {
  std::string text = R"({"format": "behaviourlinks", "version": 1, "nodes": [)";
  std::string state;
  for (int n = 0; n < count; ++n) {
    const std::string number = std::to_string(n);
    text += (n > 0 ? ",\n" : "\n") +
            (R"({"id": "n)" + number + R"(", "position": [)" + number + R"(, 2, 3], "types": {"control": {"value": 0.5}}})");
    state += (n > 0 ? ",\n" : "\n") + (R"("n)" + number + R"(": {"control.output": 0.5})");
  }
  return text + R"(], "links": [], "state": {"tick": 1, "calm": 0, "nodes": {)" + state + "}}}";
}

std::string layer_of(int points) {
  std::string rows;
  for (int p = 0; p < points; ++p)
    rows += (p > 0 ? ",\n" : "\n") + (R"({"x": )" + std::to_string(p) + R"(, "y": 2, "value": 3.5})");
  return R"({"format": "behaviourlinks", "version": 1, "nodes": [{"id": "layer", "types": {"data_layer": {"values": [)" + rows +
         "]}}}]}";
}

// Four times as much may take a little more than four times as long; the square would be sixteen times.
constexpr double kMostGrowth = 9;

TEST(LargeScene, IsReadAndWrittenInProportionToItsNodes) {
  const std::string small = nodes_of(5000), large = nodes_of(20000);
  for (const std::string* text : {&small, &large}) ASSERT_TRUE(read_scene(*text, full_registry()).is_usable());
  const auto read = [](const std::string& text) {
    return test::processor_time([&] { (void)read_scene(text, full_registry()); });
  };
  EXPECT_LT(read(large), kMostGrowth * read(small));
  const auto write = [](const std::string& text) {
    const SceneReading reading = read_scene(text, full_registry());
    return test::processor_time([&] { (void)write_scene(reading.scene, full_registry(), &*reading.state); });
  };
  EXPECT_LT(write(large), kMostGrowth * write(small));
}

TEST(LargeScene, ALayerIsReadInProportionToItsPoints) {
  const std::string small = layer_of(5000), large = layer_of(20000);
  const SceneReading reading = read_scene(large, full_registry());
  ASSERT_TRUE(reading.is_usable()) << reading.first_error().text();
  const auto read = [](const std::string& text) {
    return test::processor_time([&] { (void)read_scene(text, full_registry()); });
  };
  EXPECT_LT(read(large), kMostGrowth * read(small));
}

// Links that name nobody, each with its guess.
TEST(LargeScene, ManyMistakesAreToldInProportionToTheirNumber) {
  const auto broken = [](int count) {
    std::string text = R"({"format": "behaviourlinks", "version": 1, "nodes": [)", links;
    for (int n = 0; n < count; ++n) {
      const std::string number = std::to_string(n);
      text += (n > 0 ? "," : "") + (R"({"id": "node)" + number + "\"}");
      links += (n > 0 ? "," : "") + (R"({"id": "l)" + number + R"(", "kind": "attract", "from": "node)" + number +
                                     R"(", "to": "nodes)" + number + "\"}");
    }
    return text + R"(], "links": [)" + links + "]}";
  };
  const std::string small = broken(1000), large = broken(4000);
  EXPECT_EQ(read_scene(small, full_registry()).problems.size(), 1000u);
  const auto read = [](const std::string& text) {
    return test::processor_time([&] { (void)read_scene(text, full_registry()); });
  };
  EXPECT_LT(read(large), kMostGrowth * read(small));
}

// Nobody may read the sentence: a sensor whose node is gone is refused with every reading.
TEST(LargeScene, ARefusalCostsNoMoreThanInASmallOne) {
  const auto refusals = [](int count) {
    const SceneReading reading = read_scene(nodes_of(count), full_registry());
    Ledger ledger(full_registry(), reading.scene);
    const Command misspelt = command<RenameNode>({"n17x", "Seventeen"});
    EXPECT_EQ(ledger.submit(misspelt, "test", 0).error().message, "there is no node `n17x`, did you mean `n17`?") << count;
    return test::processor_time([&] {
      for (int k = 0; k < 500; ++k) (void)ledger.submit(misspelt, "test", 0);
    });
  };
  const double small = refusals(60);
  EXPECT_LT(refusals(10000), 4 * small);
}

}  // namespace
}  // namespace bl
