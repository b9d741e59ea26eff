// What scenes and plans are said to take in memory is near to what they take, and what they share is left out.
#include "core/graph/held_bytes.h"

#include <malloc.h>

#include <gtest/gtest.h>

#include "core/file/scene_file.h"
#include "core/graph/amend.h"
#include "tests/support/sanitized.h"
#include "tests/support/scene_files.h"
#include "tests/support/world.h"

namespace bl {
namespace {

Scene scene_of(const std::string& path) { return read_scene(project_file(path), full_registry()).scene; }

const std::string& first_volume(const Scene& scene) {
  auto node = scene.nodes.begin();
  while (!node->second.types.contains("smart_volume")) ++node;
  return node->first;
}

// By everything together.
std::size_t heap_now() { return mallinfo2().uordblks; }

TEST(HeldBytes, AreNearToWhatIsTaken) {
  if (test::kIsSanitized) GTEST_SKIP() << "a sanitizer has a heap of its own";
  for (const char* path : {"scenes/studies/thousand_volumes.json", "scenes/studies/urban_mode.json", "scenes/studies/braess.json",
                           "scenes/studies/scripted_terraces.json"}) {
    SCOPED_TRACE(path);
    (void)compile(scene_of(path), full_registry());  // what is made once, by whoever is first
    const std::size_t empty = heap_now();
    const Scene scene = scene_of(path);
    const std::size_t with_scene = heap_now();
    const auto plan = compile(scene, full_registry());
    const std::size_t with_plan = heap_now();
    const auto of_scene = static_cast<double>(with_scene - empty), of_plan = static_cast<double>(with_plan - with_scene);
    // Of a small scene the leaves that hold few records weigh more than these.
    const double most = scene.nodes.size() > 100 ? 1.5 : 3;
    EXPECT_GT(static_cast<double>(held_bytes(scene, nullptr)), 0.7 * of_scene) << of_scene;
    EXPECT_LT(static_cast<double>(held_bytes(scene, nullptr)), most * of_scene) << of_scene;
    EXPECT_GT(static_cast<double>(held_bytes(*plan, nullptr)), 0.7 * of_plan) << of_plan;
    EXPECT_LT(static_cast<double>(held_bytes(*plan, nullptr)), most * of_plan) << of_plan;
  }
}

TEST(HeldBytes, WhatIsSharedIsNotCounted) {
  const Scene scene = scene_of("scenes/studies/thousand_volumes.json");
  const auto plan = compile(scene, full_registry());
  const std::size_t whole_scene = held_bytes(scene, nullptr), whole_plan = held_bytes(*plan, nullptr);
  Scene edited = scene;
  const std::string first = first_volume(scene);
  edited.nodes.edit(first).types["smart_volume"]["demand"] = 123.0;
  const auto amended = amend(*plan, edited, full_registry());
  ASSERT_TRUE(amended.has_value());
  EXPECT_LT(held_bytes(edited, &scene), whole_scene / 20);
  EXPECT_LT(held_bytes(*amended->plan, plan.get()), whole_plan / 20);
  EXPECT_GT(held_bytes(edited, &scene), sizeof(NodeRecord));
  EXPECT_GT(held_bytes(*amended->plan, plan.get()), sizeof(NodePlan));
  // A node that comes pushes the others on, which stay the same.
  Scene more = scene;
  more.nodes.emplace("0", scene.nodes.at(first));
  const auto moved = amend(*plan, more, full_registry());
  ASSERT_TRUE(moved.has_value());
  EXPECT_LT(held_bytes(more, &scene), whole_scene / 20);
  EXPECT_LT(held_bytes(*moved->plan, plan.get()), whole_plan / 2) << "links say other numbers, nodes do not";
  // The same content in another place takes its memory again.
  const Scene again = scene_of("scenes/studies/thousand_volumes.json");
  EXPECT_EQ(again, scene);
  EXPECT_GT(held_bytes(again, &scene), whole_scene * 9 / 10);
  EXPECT_GT(held_bytes(*compile(again, full_registry()), plan.get()), whole_plan * 9 / 10);
}

TEST(HeldBytes, ATableOfANodeThatMovesIsCountedOnce) {
  Scene scene = scene_of("scenes/studies/thousand_volumes.json");
  const std::string first = first_volume(scene);
  Table table{{"name", "floors"}, {}};
  for (int row = 0; row < 10000; ++row) table.rows.push_back({std::string("a row of a long table"), 1.0 * row});
  scene.nodes.edit(first).types["programme"]["rows"] = Shared(std::move(table));
  Scene moved = scene;
  moved.nodes.edit(first).types[std::string(kBaseNode)]["position"] = Vector3{1, 2, 3};
  EXPECT_GT(held_bytes(scene, nullptr), 10000u * 2 * sizeof(Scalar));
  EXPECT_LT(held_bytes(moved, &scene), 20000u);
  moved.nodes.edit(first).types["programme"]["rows"] =
      Shared(Table(*std::get<Shared<Table>>(scene.nodes.at(first).types.at("programme").at("rows"))));
  EXPECT_GT(held_bytes(moved, &scene), 10000u * 2 * sizeof(Scalar)) << "another table of the same content";
}

}  // namespace
}  // namespace bl
