// Vertices and planes: several at a time are judged as one by one, and the reaches of a shape never promise too much.
#include <random>

#include "core/geometry/inside/plane_side.h"
#include "tests/core/geometry/geometry_support.h"

namespace bl::test {
namespace {

struct Cloud {
  std::vector<double> x, y, z;
  geometry::VertexLanes lanes() const { return {x.data(), y.data(), z.data(), count}; }
  Vector3 at(std::uint32_t v) const { return {x[v], y[v], z[v]}; }
  std::uint32_t count;
};

Cloud cloud_of(std::uint32_t count, std::mt19937_64& random) {
  // Whole numbers now and then, so that products are equal and signs are zero.
  std::uniform_real_distribution<double> anywhere(-9, 9);
  const bool is_lattice = random() % 3 == 0;
  const auto coordinates = [&] {
    std::vector<double> values(geometry::padded_to_lanes(count));
    for (std::uint32_t v = 0; v < count; ++v) values[v] = is_lattice ? std::round(anywhere(random) / 3) : anywhere(random);
    std::fill(values.begin() + count, values.end(), values[count - 1]);
    return values;
  };
  auto x = coordinates(), y = coordinates(), z = coordinates();
  return {std::move(x), std::move(y), std::move(z), count};
}

Vector3 direction_of(std::mt19937_64& random) {
  std::uniform_real_distribution<double> anywhere(-1, 1);
  Vector3 along{anywhere(random), anywhere(random), anywhere(random)};
  // Coordinates that are nothing or equal are where the 26 directions meet.
  if (random() % 4 == 0) along.x = 0;
  if (random() % 4 == 0) along.y = along.x;
  if (random() % 4 == 0) along.z = -along.y;
  return along;
}

TEST(PlaneSide, AllWaysGiveTheBitsOfOneByOne) {
  std::mt19937_64 random(7);
  for (int round = 0; round < 2000; ++round) {
    const Cloud cloud = cloud_of(1 + static_cast<std::uint32_t>(random() % 150), random);
    const Vector3 normal = direction_of(random);
    const double offset = round % 2 == 0 ? dot(normal, cloud.at(0)) : 0.25, tolerance = 1e-3;
    double nearest = 1e300;
    for (std::uint32_t v = 0; v < cloud.count; ++v)
      nearest = std::min(nearest, std::abs(cloud.x[v] * normal.x + cloud.y[v] * normal.y + cloud.z[v] * normal.z - offset));
    for (const bool may_use_fours : {false, true}) {
      std::vector<double> beyond(cloud.x.size());
      std::vector<std::uint64_t> taken(cloud.count / 64 + 1);
      const auto sides = find_plane_sides(cloud.lanes(), normal, offset, tolerance, beyond.data(), taken.data(), may_use_fours);
      bool is_any = false;
      for (std::uint32_t v = 0; v < cloud.count; ++v) {
        const double distance = cloud.x[v] * normal.x + cloud.y[v] * normal.y + cloud.z[v] * normal.z - offset;
        EXPECT_EQ(beyond[v], distance);
        EXPECT_EQ((taken[v / 64] >> (v % 64) & 1u) != 0, distance > tolerance);
        is_any = is_any || distance > tolerance;
      }
      EXPECT_EQ(sides.is_any_beyond, is_any);
      EXPECT_EQ(sides.nearest, nearest);
      EXPECT_EQ(cloud.count % 64 == 0 ? 0u : taken[cloud.count / 64] >> (cloud.count % 64), 0u) << "copies do not count";
    }
    EXPECT_EQ(geometry::largest_of_lanes(cloud.x.data(), cloud.count),
              std::max(0.0, *std::max_element(cloud.x.begin(), cloud.x.begin() + cloud.count)));
  }
}

TEST(PlaneSide, ReachesAreBoundsAndTightAlongTheirOwnDirections) {
  std::mt19937_64 random(11);
  for (int round = 0; round < 500; ++round) {
    const Cloud cloud = cloud_of(4 + static_cast<std::uint32_t>(random() % 40), random);
    geometry::Reaches reaches;
    reaches.measure(cloud.lanes());
    const auto farthest = [&](const Vector3& along) {
      double most = -1e300;
      for (std::uint32_t v = 0; v < cloud.count; ++v) most = std::max(most, dot(cloud.at(v), along));
      return most;
    };
    for (int turn = 0; turn < 50; ++turn) {
      const Vector3 along = direction_of(random);
      EXPECT_GE(reaches.bound(along), farthest(along) - 1e-12);
    }
    for (int x = -1; x <= 1; ++x) {
      for (int y = -1; y <= 1; ++y) {
        for (int z = -1; z <= 1; ++z) {
          const Vector3 along{double(x), double(y), double(z)};
          EXPECT_NEAR(reaches.bound(along), x == 0 && y == 0 && z == 0 ? 0 : farthest(along), 1e-12);
        }
      }
    }
  }
}

}  // namespace
}  // namespace bl::test
