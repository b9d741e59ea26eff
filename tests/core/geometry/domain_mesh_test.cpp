// Closed meshes as unions of convex pieces: handles, cavities, several shells, any order and turning, and what is refused.
#include <functional>
#include <numeric>

#include "tests/core/geometry/domain_laws.h"

namespace bl::test {
namespace {

using Filled = std::function<bool(int, int, int)>;

struct Blocks {
  Mesh mesh;
  double volume = 0, surface = 0;
};

// The surface of a set of unit cubes, each open side two triangles.
Blocks blocks(int n, const Filled& is_filled) {
  Blocks result;
  const auto filled = [&](int x, int y, int z) {
    return x >= 0 && y >= 0 && z >= 0 && x < n && y < n && z < n && is_filled(x, y, z);
  };
  const auto vertex = [&](const std::array<int, 3>& p) {
    result.mesh.vertices.push_back({static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])});
    return static_cast<std::uint32_t>(result.mesh.vertices.size() - 1);
  };
  for (int x = 0; x < n; ++x)
    for (int y = 0; y < n; ++y)
      for (int z = 0; z < n; ++z) {
        if (!filled(x, y, z)) continue;
        result.volume += 1;
        for (std::size_t axis = 0; axis < 3; ++axis)
          for (int end = 0; end < 2; ++end) {
            std::array<int, 3> beside{x, y, z}, corner{x, y, z}, u{0, 0, 0}, v{0, 0, 0};
            beside[axis] += end == 1 ? 1 : -1;
            if (filled(beside[0], beside[1], beside[2])) continue;
            result.surface += 1;
            corner[axis] += end;
            u[(axis + (end == 1 ? 1u : 2u)) % 3] = 1;
            v[(axis + (end == 1 ? 2u : 1u)) % 3] = 1;
            const auto at = [&](int a, int b) {
              return vertex({corner[0] + a * u[0] + b * v[0], corner[1] + a * u[1] + b * v[1], corner[2] + a * u[2] + b * v[2]});
            };
            const std::uint32_t p = at(0, 0), q = at(1, 0), r = at(1, 1), s = at(0, 1);
            result.mesh.triangles.push_back({p, q, r});
            result.mesh.triangles.push_back({p, r, s});
          }
      }
  return result;
}

void turn(Mesh& mesh, double scale) {
  const Vector3 a{2.0 / 3, -2.0 / 3, 1.0 / 3}, b{1.0 / 3, 2.0 / 3, 2.0 / 3}, c{-2.0 / 3, -1.0 / 3, 2.0 / 3};
  for (Point3& v : mesh.vertices) v = Vector3{100, -50, 7} + scale * Vector3{dot(a, v), dot(b, v), dot(c, v)};
}

geometry::Domain expect_blocks(const Blocks& given, std::size_t most) {
  const auto domain = geometry::from_closed_mesh(given.mesh);
  EXPECT_TRUE(domain.ok()) << domain.error().text();
  if (!domain) return {};
  expect_sound(*domain, given.volume, given.surface);
  EXPECT_LE(domain->pieces.size(), most);
  Blocks turned = given;
  turn(turned.mesh, 3);
  const auto tilted = geometry::from_closed_mesh(turned.mesh);
  EXPECT_TRUE(tilted.ok()) << tilted.error().text();
  if (tilted) expect_sound(*tilted, 27 * given.volume, 9 * given.surface);
  return *domain;
}

Mesh torus(std::size_t around, std::size_t across) {
  Mesh mesh;
  const double step = 2 * std::numbers::pi;
  for (std::size_t i = 0; i < around; ++i)
    for (std::size_t j = 0; j < across; ++j) {
      const double a = step * static_cast<double>(i) / static_cast<double>(around),
                   b = step * (static_cast<double>(j) + 0.5) / static_cast<double>(across);
      const double radius = 10 + 3 * std::cos(b);
      mesh.vertices.push_back({radius * std::cos(a), radius * std::sin(a), 3 * std::sin(b)});
      const auto at = [&](std::size_t k, std::size_t l) { return static_cast<std::uint32_t>(k % around * across + l % across); };
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}

double surface_of(const Mesh& mesh) {
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    area += 0.5 * norm(cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]));
  return area;
}

TEST(DomainMesh, AConvexMeshIsOnePiece) {
  const Mesh mesh = to_mesh(box({1, 2, 3}, {4, 6, 8}));
  const auto domain = geometry::from_closed_mesh(mesh);
  ASSERT_TRUE(domain.ok());
  EXPECT_EQ(*domain, geometry::Domain(geometry::from_mesh(mesh).value()));
}

TEST(DomainMesh, AnEll) {
  const geometry::Domain domain = expect_blocks(blocks(2, [](int x, int y, int) { return x == 0 || y == 0; }), 3);
  EXPECT_EQ(domain.side_count, 8u);
}

TEST(DomainMesh, ARingHasAHandle) {
  const geometry::Domain domain = expect_blocks(blocks(3, [](int x, int y, int z) { return z == 0 && (x != 1 || y != 1); }), 8);
  EXPECT_EQ(domain.side_count, 10u);
}

TEST(DomainMesh, ACavity) {
  const Blocks hollow = blocks(3, [](int x, int y, int z) { return x != 1 || y != 1 || z != 1; });
  const geometry::Domain domain = expect_blocks(hollow, 26);
  EXPECT_EQ(domain.side_count, 12u);
  EXPECT_FALSE(domain.contains({1.5, 1.5, 1.5}));
}

TEST(DomainMesh, ShellsBesideAndWithinEachOther) {
  // A block in the cavity of a block, and another block beside both, each turned at random.
  const Blocks set = blocks(7, [](int x, int y, int z) {
    if (x == 6) return y == 0 && z == 0;
    const int away = std::max({std::abs(x - 2), std::abs(y - 2), std::abs(z - 2)});
    return away == 0 || away == 2;
  });
  const geometry::Domain domain = expect_blocks(set, 30);
  Blocks other = set;
  for (auto& t : other.mesh.triangles) std::swap(t[0], t[1]);
  EXPECT_EQ(geometry::from_closed_mesh(other.mesh).value(), domain);
}

TEST(DomainMesh, RandomBlocks) {
  int taken = 0;
  std::size_t most = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Random random(seed);
    std::array<bool, 64> cells{};
    for (bool& cell : cells) cell = random.uniform() < 0.9;
    const Blocks set = blocks(4, [&](int x, int y, int z) { return cells[static_cast<std::size_t>(16 * x + 4 * y + z)]; });
    const auto domain = geometry::from_closed_mesh(set.mesh);
    if (!domain) {
      // Cubes that touch along an edge only.
      EXPECT_NE(domain.error().message.find("not closed"), std::string::npos) << domain.error().text();
      continue;
    }
    SCOPED_TRACE(seed);
    ++taken;
    expect_sound(*domain, set.volume, set.surface);
    most = std::max(most, domain->pieces.size());
  }
  EXPECT_GT(taken, 10);
  EXPECT_LE(most, 64u);
}

TEST(DomainMesh, ATorusOfTriangles) {
  const Mesh mesh = torus(12, 6);
  const auto domain = geometry::from_closed_mesh(mesh);
  ASSERT_TRUE(domain.ok()) << domain.error().text();
  expect_sound(*domain, enclosed_volume(mesh), surface_of(mesh));
  RecordProperty("pieces", static_cast<int>(domain->pieces.size()));
  EXPECT_LE(domain->pieces.size(), 400u);
  EXPECT_FALSE(domain->contains({0, 0, 0}));
  EXPECT_TRUE(domain->contains({10, 0, 0}));
}

TEST(DomainMesh, TheOrderOfTheMeshDoesNotMatter) {
  const Mesh mesh = torus(8, 5);
  const geometry::Domain domain = geometry::from_closed_mesh(mesh).value();
  Random random(4);
  std::vector<std::uint32_t> place(mesh.vertices.size());
  std::iota(place.begin(), place.end(), 0u);
  for (std::size_t i = place.size(); i > 1; --i) std::swap(place[i - 1], place[random.below(i)]);
  Mesh shuffled = mesh;
  for (std::size_t v = 0; v < place.size(); ++v) shuffled.vertices[place[v]] = mesh.vertices[v];
  for (auto& t : shuffled.triangles) t = {place[t[1]], place[t[2]], place[t[0]]};
  std::reverse(shuffled.triangles.begin(), shuffled.triangles.end());
  EXPECT_EQ(geometry::from_closed_mesh(shuffled).value(), domain);
  for (auto& t : shuffled.triangles) std::swap(t[0], t[1]);
  EXPECT_EQ(geometry::from_closed_mesh(shuffled).value(), domain);
}

TEST(DomainMesh, RefusesWithASentence) {
  const auto text = [](const Mesh& mesh) {
    const auto domain = geometry::from_closed_mesh(mesh);
    return domain ? std::string("taken") : domain.error().text();
  };
  Mesh open = torus(8, 5);
  open.triangles.pop_back();
  EXPECT_EQ(text(open), "the boundary mesh is not closed: each edge needs one triangle on either side, turned the same way");
  Mesh crossing = to_mesh(box({0, 0, 0}, {2, 2, 2}));
  const Mesh other = to_mesh(box({1, 1, 1}, {3, 3, 3}));
  for (const auto& t : other.triangles) crossing.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
  crossing.vertices.insert(crossing.vertices.end(), other.vertices.begin(), other.vertices.end());
  EXPECT_EQ(text(crossing).substr(0, 45), "the boundary mesh crosses or touches itself: ");
  Mesh touching = to_mesh(box({0, 0, 0}, {2, 2, 2}));
  const Mesh beside = to_mesh(box({2, 0.5, 0.5}, {3, 1.5, 1.5}));
  for (const auto& t : beside.triangles) touching.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
  touching.vertices.insert(touching.vertices.end(), beside.vertices.begin(), beside.vertices.end());
  EXPECT_EQ(text(touching).substr(0, 45), "the boundary mesh crosses or touches itself: ");
  Mesh wrong = torus(8, 5);
  wrong.triangles[3][1] = 4000;
  EXPECT_EQ(text(wrong), "a triangle of the boundary mesh names a vertex that is not there");
  EXPECT_FALSE(geometry::from_closed_mesh(Mesh{}).ok());
}

}  // namespace
}  // namespace bl::test
