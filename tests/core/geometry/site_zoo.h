// Random and degenerate site sets for the laws of the cell engine and of the fit.
#pragma once

#include <cstdlib>
#include <string>
#include <vector>

#include "core/geometry/domain_makers.h"
#include "tests/core/geometry/geometry_support.h"
#include "tests/support/sanitized.h"

namespace bl::test {

/// How many rounds of a law are run: all of them, a twentieth under sanitizers; BL_LAW_SHARE (a number) says otherwise.
inline int rounds(int all) {
  double share = kIsSanitized ? 0.05 : 1;
  if (const char* given = std::getenv("BL_LAW_SHARE")) share = std::atof(given);
  return std::max(1, static_cast<int>(all * share));
}

struct SiteSet {
  std::string name;
  geometry::Domain domain;
  std::vector<geometry::PowerSite> sites;
};

inline constexpr int kZooKinds = 20;

/// Domains of about unit size: a cube, a box of odd proportions, a slab, a hull without symmetry, an L with a hole.
inline const geometry::Domain& zoo_domain(int kind) {
  static const std::vector<geometry::Domain> domains = [] {
    std::vector<geometry::Domain> made{unit_cube(), box({0, 0, 0}, {1, 0.7, 1.3}), box({0, 0, 0}, {1, 1, 0.05})};
    made.emplace_back(
        geometry::convex_hull(
            std::vector<Point3>{
                {0, 0, 0}, {1, 0.1, 0}, {1.1, 1, 0.1}, {0, 0.9, -0.1}, {0.2, 0.1, 1}, {0.9, 0.8, 1.2}, {0.1, 1, 0.9}})
            .value());
    const std::vector<Point3> plan{{0, 0, 0}, {1, 0, 0}, {1, 0.5, 0}, {0.6, 0.5, 0}, {0.6, 1, 0}, {0, 1, 0}};
    const std::vector<std::vector<Point3>> holes{{{0.2, 0.2, 0}, {0.2, 0.4, 0}, {0.4, 0.4, 0}, {0.4, 0.2, 0}}};
    made.push_back(geometry::extrude_plan(plan, holes, 0, 0.8).value());
    return made;
  }();
  return domains[static_cast<std::size_t>(kind) % domains.size()];
}

/// Sites of one kind of trouble, about `count` of them, in the unit cube (mostly).
inline SiteSet zoo_set(int kind, std::size_t count, std::uint64_t seed) {
  Random random(seed, static_cast<std::uint64_t>(kind));
  SiteSet set{"", zoo_domain(static_cast<int>(random.below(5))), {}};
  const auto anywhere = [&] { return random_point(random, {0, 0, 0}, {1, 1, 1}); };
  // A radius from small beside the spacing to large beside it.
  const double spacing = 1 / std::cbrt(static_cast<double>(count));
  const double mean = spacing * spacing * std::pow(2.0, random.uniform(-4, 2));
  const auto any_weight = [&] { return mean * random.uniform(0.2, 1.8); };
  const auto add = [&](const Point3& p, double weight) { set.sites.push_back({p, weight}); };
  const auto add_any = [&] {
    const Point3 p = anywhere();
    add(p, any_weight());
  };
  const auto fill = [&](auto&& place, auto&& weight) {
    for (std::size_t i = 0; i < count; ++i) {
      const Point3 p = place(i);  // one after the other: the same set with every compiler
      add(p, weight(i));
    }
  };
  const int steps = std::max(1, static_cast<int>(std::cbrt(static_cast<double>(count)) + 0.01));
  const auto lattice = [&](auto&& weight) {
    for (int x = 0; x < steps; ++x) {
      for (int y = 0; y < steps; ++y) {
        for (int z = 0; z < steps; ++z) add(Point3{x + 0.5, y + 0.5, z + 0.5} / steps, weight());
      }
    }
  };
  const auto direction = [&] {
    Vector3 v;
    do v = random_point(random, {-1, -1, -1}, {1, 1, 1});
    while (squared_norm(v) > 1 || squared_norm(v) < 1e-3);
    return v / norm(v);
  };
  const auto weights = [&](std::size_t) { return any_weight(); };
  switch (kind) {
    case 0:
      set.name = "random";
      fill([&](std::size_t) { return anywhere(); }, weights);
      break;
    case 1:
      set.name = "random, equal weights";
      fill([&](std::size_t) { return anywhere(); }, [&](std::size_t) { return mean; });
      break;
    case 2:
      set.name = "lattice, equal weights";
      lattice([&] { return mean; });
      break;
    case 3:
      set.name = "lattice, random weights";
      lattice(any_weight);
      break;
    case 4: {
      set.name = "lattice, balls through corners";
      const double radius = 0.5 / steps * std::sqrt(static_cast<double>(1 + random.below(3)));
      lattice([&] { return radius * radius; });
      break;
    }
    case 5: {
      set.name = "cospherical";
      fill([&](std::size_t) { return Point3{0.5, 0.5, 0.5} + 0.4 * direction(); }, [&](std::size_t) { return mean; });
      break;
    }
    case 6:
      set.name = "coplanar";
      fill(
          [&](std::size_t) {
            const Point3 p = anywhere();
            return Point3{p.x, p.y, 0.25};
          },
          weights);
      break;
    case 7:
      set.name = "collinear";
      fill(
          [&](std::size_t) {
            const double t = random.uniform();
            return Point3{t, 0.5, 0.5};
          },
          weights);
      break;
    case 8: {
      set.name = "coincident";
      fill([&](std::size_t i) { return i % 3 == 2 ? set.sites[random.below(i)].position : anywhere(); }, weights);
      break;
    }
    case 9:
      set.name = "many hidden";
      fill([&](std::size_t) { return anywhere(); }, [&](std::size_t i) { return i % 3 ? -mean : 4 * mean; });
      break;
    case 10:
      set.name = "outside";
      fill([&](std::size_t) { return 3 * anywhere() - Vector3{1, 1, 1}; }, [&](std::size_t) { return 9 * any_weight(); });
      break;
    case 11: {
      set.name = "tiny and huge weights";
      fill([&](std::size_t) { return anywhere(); }, [&](std::size_t) { return std::pow(10.0, random.uniform(-14, 3)); });
      break;
    }
    case 12: {
      set.name = "huge weights, nearly equal";
      fill([&](std::size_t) { return anywhere(); }, [&](std::size_t) { return 1e6 + any_weight(); });
      break;
    }
    case 13: {
      set.name = "clusters";
      std::vector<Point3> centres{anywhere(), anywhere(), anywhere()};
      fill([&](std::size_t i) { return centres[i % 3] + 0.001 * anywhere(); },
           [&](std::size_t) { return 1e-6 * random.uniform() + 0.01 * static_cast<double>(random.below(2)); });
      break;
    }
    case 14:
      set.name = "one";
      add_any();
      break;
    case 15:
      set.name = "two";
      add_any();
      add_any();
      break;
    case 16: {
      set.name = "on faces, edges and corners";
      fill(
          [&](std::size_t) {
            const auto end = [&] { return random.below(2) ? random.uniform() : static_cast<double>(random.below(2)); };
            const double x = end(), y = end();
            return Point3{x, y, end()};
          },
          weights);
      break;
    }
    case 17: {
      set.name = "face-centred lattice";
      for (int x = 0; x < 2 * steps; ++x) {
        for (int y = 0; y < 2 * steps; ++y) {
          for (int z = 0; z < 2 * steps; ++z) {
            if ((x + y + z) % 2 == 0 && set.sites.size() < 2 * count) add(Point3{x + 0.5, y + 0.5, z + 0.5} / (2 * steps), mean);
          }
        }
      }
      break;
    }
    case 18: {
      set.name = "close pairs";
      fill([&](std::size_t i) { return i % 2 ? set.sites[i - 1].position + 2e-5 * direction() : anywhere(); }, weights);
      break;
    }
    default: {
      set.name = "no ball, or a negative one, among others";
      fill([&](std::size_t) { return anywhere(); },
           [&](std::size_t i) { return i % 4 == 0   ? 0
                                       : i % 5 == 0 ? -any_weight()
                                                    : any_weight(); });
      break;
    }
  }
  set.name += ", seed " + std::to_string(seed);
  return set;
}

}  // namespace bl::test
