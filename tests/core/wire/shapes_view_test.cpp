// Shapes for pages: what is sent gives the meshes again, is small, and stays what it is while nothing moves.
#include "core/wire/shapes_view.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/geometry/cell_mesh.h"
#include "core/reading/report_model.h"
#include "core/wire/messages.h"
#include "core/wire/plan_view.h"
#include "tests/support/world.h"

namespace bl::wire {
namespace {

using Shapes = std::map<std::string, std::string>;

std::size_t bytes_of(const Shapes& shapes) {
  std::size_t bytes = 0;
  for (const auto& [key, content] : shapes) bytes += content.size();
  return bytes;
}

template <class M>
M read(const Shapes& shapes, const std::string& key) {
  const auto message = read_message<M>(*parse_json(shapes.at(key)));
  EXPECT_TRUE(message.ok()) << key;
  return message ? *message : M{};
}

// The coarse mesh that a cell was made from, as a page understands it.
Mesh mesh_of(const CellContent& cell, const Point3& origin) {
  const auto point = [](const Numbers& numbers, std::size_t at, const Point3& from) {
    return Point3{from.x + (*numbers)[at] / 100, from.y + (*numbers)[at + 1] / 100, from.z + (*numbers)[at + 2] / 100};
  };
  MeshWrap wrap;
  wrap.ball_centre = point(cell.ball, 0, origin);
  wrap.radius = (*cell.ball)[3] / 100;
  std::vector<Point3> corners;
  for (std::size_t k = 0; k + 2 < cell.points->size(); k += 3) corners.push_back(point(cell.points, k, wrap.ball_centre));
  Mesh mesh;
  std::size_t face = 0;
  for (std::size_t at = 0; at < cell.parts->size();) {
    const auto faces = static_cast<std::size_t>((*cell.parts)[at]), seams = static_cast<std::size_t>((*cell.parts)[at + 1]);
    MeshWrap::Part part{0, point(cell.parts, at + 2, wrap.ball_centre), {}};
    for (std::size_t s = 0; s < seams; ++s) part.seams.push_back(point(cell.parts, at + 5 + 3 * s, wrap.ball_centre));
    at += 5 + 3 * seams;
    // The corners of each part follow each other, as in the original.
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
    for (std::size_t c = 0; c < corners.size(); ++c)
      wrap.seams.push_back(cell.seams->empty() ? 0 : static_cast<std::uint32_t>((*cell.seams)[c]));
    for (std::size_t f = 0; f < faces; ++f) {
      const auto count = static_cast<std::size_t>((*cell.faces)[face++]);
      const auto corner = [&](std::size_t k) { return static_cast<std::uint32_t>((*cell.faces)[face + k % count]); };
      Point3 middle;
      for (std::size_t k = 0; k < count; ++k) middle += corners[corner(k)];
      const auto centre = static_cast<std::uint32_t>(mesh.vertices.size());
      mesh.vertices.push_back(middle / static_cast<double>(count));
      wrap.seams.push_back(0);
      for (std::size_t k = 0; k < count; ++k) mesh.triangles.push_back({centre, first + corner(k), first + corner(k + 1)});
      part.triangles += static_cast<std::uint32_t>(count);
      face += count;
    }
    wrap.parts.push_back(std::move(part));
  }
  mesh.wrap = std::make_shared<const MeshWrap>(std::move(wrap));
  return mesh;
}

double volume_at(std::shared_ptr<const Mesh> coarse) {
  auto mesh = std::make_shared<Mesh>();
  mesh->coarse = std::move(coarse);
  return enclosed_volume(*geometry::mesh_of_depth(MeshPointer(std::shared_ptr<const Mesh>(mesh)), 3));
}

TEST(ShapesView, GivesTheMeshesOfTheWindowToACentimetre) {
  for (const char* scene : {"scenes/start/quarter.json", "scenes/studies/urban_mode.json"}) {
    World world = World::from_file(scene);
    world.settle(60);
    const Shapes shapes = shapes_view(world.state());
    const Point3 origin = read<SpaceContent>(shapes, "space").origin;
    reading::ReportModel model;
    reading::read_model(world.state(), model);
    std::size_t cells = 0;
    for (const reading::VolumeRow& row : model.volumes) {
      if (!row.mesh) continue;
      ASSERT_TRUE(row.mesh.coarse() && row.mesh.coarse()->wrap) << row.id;
      const auto cell = std::make_shared<const Mesh>(mesh_of(read<CellContent>(shapes, "n/" + row.id), origin));
      EXPECT_EQ(cell->triangles.size(), row.mesh.coarse()->triangles.size()) << row.id;
      const double volume = volume_at(row.mesh.coarse());
      EXPECT_NEAR(volume_at(cell), volume, 0.005 * volume) << row.id;
      ++cells;
    }
    EXPECT_GE(cells, 3u) << scene;
  }
}

TEST(ShapesView, HasTheKeysOfThePlanAndIsSmall) {
  World world = World::from_file("scenes/start/quarter.json");
  world.settle();
  const Shapes shapes = shapes_view(world.state());
  for (const auto& [key, content] : plan_view(world.state())) EXPECT_TRUE(key == "box" || shapes.contains(key)) << key;
  EXPECT_LT(bytes_of(shapes), 20000u) << "of 60 kB compressed";
  EXPECT_FALSE(read<SpaceContent>(shapes, "space").is_coarse);
  // A scene has settled while it still moves by millimetres; then these go, too.
  Shapes before;
  bool is_at_rest = false;
  for (int k = 0; k < 100 && !is_at_rest; ++k) {
    world.tick(20);
    Shapes now = shapes_view(world.state());
    is_at_rest = now == before;
    before = std::move(now);
  }
  EXPECT_TRUE(is_at_rest) << "at rest nothing is sent";
}

TEST(ShapesView, ManyVolumesAreSimplerAndNoneIsLostSilently) {
  World world = World::from_file("scenes/studies/thousand_volumes.json");
  world.tick(3);
  const auto counted = [](const Shapes& shapes) {
    std::size_t prisms = 0;
    for (const auto& [key, content] : shapes) prisms += content.find("\"prism\"") != std::string::npos;
    return prisms;
  };
  const Shapes all = shapes_view(world.state());
  const std::size_t volumes = counted(all);
  EXPECT_GT(volumes, 900u);
  EXPECT_TRUE(read<SpaceContent>(all, "space").is_coarse);
  EXPECT_EQ(read<SpaceContent>(all, "space").left_out, 0);
  EXPECT_LT(bytes_of(all), kMostShapeBytes);
  const Shapes few = shapes_view(world.state(), 20000);
  EXPECT_LT(bytes_of(few), 20200u) << "but for `space`";
  EXPECT_EQ(all.size() - few.size(), static_cast<std::size_t>(read<SpaceContent>(few, "space").left_out));
  EXPECT_GT(counted(few), 80u);
}

TEST(ShapesView, TerrainIsAGridOfItsHeights) {
  World world = World::from_file("scenes/nodes/terrain.json");
  world.tick(2);
  const Shapes shapes = shapes_view(world.state());
  const auto terrain = read<TerrainContent>(shapes, "terrain/1");
  const double origin = read<SpaceContent>(shapes, "space").origin.z;
  reading::ReportModel model;
  reading::read_model(world.state(), model);
  ASSERT_EQ(model.surroundings.grounds.size(), 1u);
  double low = 1e9, high = -1e9;
  for (const Point3& vertex : model.surroundings.grounds[0]->vertices)
    low = std::min(low, vertex.z), high = std::max(high, vertex.z);
  std::size_t known = 0;
  for (const double height : *terrain.heights) {
    if (height == -1000000) continue;
    ++known;
    EXPECT_GE(height / 100 + origin, low - 0.006);
    EXPECT_LE(height / 100 + origin, high + 0.006);
  }
  EXPECT_GE(known, 4u);
  EXPECT_EQ(terrain.heights->size() % static_cast<std::size_t>((*terrain.grid)[3]), 0u);
}

TEST(ShapesView, TheSchemaHasEveryContent) {
  const Json schema = message_schema();
  for (const MessageDefinition* kind : shape_kinds()) {
    const Json& one = schema["$defs"]["shapes"][kind->id];
    ASSERT_TRUE(one.is_object()) << kind->id;
    for (const PortDefinition& port : kind->ports) EXPECT_FALSE(port.doc.empty()) << kind->id << " " << port.id;
  }
}

}  // namespace
}  // namespace bl::wire
