// Cells against reference values that were computed by quadrature, without any polyhedron clipper.
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/geometry/demand_fit.h"
#include "tests/core/geometry/geometry_support.h"

namespace bl::test {
namespace {

double value_of(const nlohmann::json& j) { return j.is_string() ? parse_number(j.get<std::string>()).value() : j.get<double>(); }

Result<geometry::ConvexDomain> domain_of(const nlohmann::json& boundary) {
  std::vector<geometry::Plane> planes;
  for (const auto& p : boundary.at("planes")) planes.push_back({{p[0], p[1], p[2]}, p[3]});
  return from_planes(planes);
}

std::vector<geometry::PowerSite> sites_of(const nlohmann::json& scene) {
  std::vector<geometry::PowerSite> sites;
  for (std::size_t i = 0; i < scene.at("sites").size(); ++i) {
    const auto& p = scene["sites"][i];
    sites.push_back({{p[0], p[1], p[2]}, scene["weights"][i]});
  }
  return sites;
}

double facet_area(const geometry::CellMeasure& cell, const std::string& name) {
  const auto colon = name.find(':');
  const auto kind = name.substr(0, colon) == "plane" ? geometry::FacetArea::Kind::plane : geometry::FacetArea::Kind::site;
  const auto index = static_cast<std::uint32_t>(std::stoul(name.substr(colon + 1)));
  for (const geometry::FacetArea& facet : cell.facets) {
    if (facet.kind == kind && facet.index == index) return facet.area;
  }
  return 0;
}

struct Worst {
  double volume = 0, facet = 0, sphere = 0;
};

double relative(double got, double wanted) { return std::abs(got - wanted) / std::abs(wanted); }

void compare(const nlohmann::json& wanted, const geometry::CellMeasure& cell, Worst& worst) {
  const auto check = [&](double got, double expected, double& largest, const std::string& what) {
    if (expected == 0) {
      EXPECT_NEAR(got, 0, 1e-13) << what;
      return;
    }
    largest = std::max(largest, relative(got, expected));
    EXPECT_LE(relative(got, expected), 1e-11) << what << ": " << shortest(got) << " instead of " << shortest(expected);
  };
  check(cell.volume, value_of(wanted.at("volume")), worst.volume, "volume");
  check(cell.spherical_area, value_of(wanted.at("spherical_area")), worst.sphere, "spherical area");
  double facets = 0;
  for (const auto& [name, area] : wanted.at("facet_areas").items()) {
    check(facet_area(cell, name), value_of(area), worst.facet, name);
    facets += value_of(area);
  }
  double got = 0;
  for (const geometry::FacetArea& facet : cell.facets) got += facet.area;
  EXPECT_NEAR(got, facets, 1e-11 * std::max(1e-2, facets)) << "a facet too many or too few";
}

// The cases of all files of reference values.
nlohmann::json reference_cases(const std::string& name) {
  auto cases = nlohmann::json::array();
  for (const auto& path : reference_files(name)) {
    const auto all = nlohmann::json::parse(std::ifstream(path));
    cases.insert(cases.end(), all.at("cases").begin(), all.at("cases").end());
  }
  return cases;
}

TEST(Oracle, EveryCellMatchesTheQuadrature) {
  Worst worst;
  int cells_checked = 0;
  for (const auto& scene : reference_cases("cells")) {
    SCOPED_TRACE(scene.at("name").get<std::string>());
    const auto domain = domain_of(scene.at("boundary"));
    ASSERT_TRUE(domain.ok()) << domain.error().text();
    const auto cells = cells_of(*domain, sites_of(scene));
    for (const auto& wanted : scene.at("cells")) {
      const auto site = wanted.at("site").get<std::size_t>();
      SCOPED_TRACE("site " + std::to_string(site));
      compare(wanted, cells.at(site), worst);
      ++cells_checked;
    }
  }
  EXPECT_GE(cells_checked, 39);  // those of our own file
  RecordProperty("cells", cells_checked);
  std::printf("%d cells; worst relative error: volume %.1e, facet %.1e, spherical %.1e\n", cells_checked, worst.volume,
              worst.facet, worst.sphere);
}

TEST(Oracle, FittedWeightsGiveTheDemandedVolumes) {
  double worst = 0;
  for (const auto& scene : reference_cases("fits")) {
    SCOPED_TRACE(scene.at("name").get<std::string>());
    const auto domain = domain_of(scene.at("boundary"));
    ASSERT_TRUE(domain.ok()) << domain.error().text();
    const auto sites = sites_of(scene);
    const auto cells = cells_of(*domain, sites);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const double demand = scene.at("demands")[i];
      worst = std::max(worst, relative(cells[i].volume, demand));
      EXPECT_LE(relative(cells[i].volume, demand), 1e-9) << i;
    }
  }
  std::printf("worst relative error of the demands: %.1e\n", worst);
}

// Neighbour cells of sphere packings, ids as in the file; without the ball.
struct Packing {
  std::vector<geometry::PowerSite> sites;
  std::vector<int> ids;
};

Packing read_packing(const std::filesystem::path& path) {
  Packing packing;
  std::ifstream file(path);
  int id = 0;
  double x = 0, y = 0, z = 0, r = 0;
  while (file >> id >> x >> y >> z >> r) {
    packing.sites.push_back({{x, y, z}, r * r});
    packing.ids.push_back(id);
  }
  return packing;
}

void expect_volumes(const std::filesystem::path& path, const std::filesystem::path& table) {
  const Packing packing = read_packing(path);
  ASSERT_EQ(packing.sites.size(), 159u);
  const geometry::ConvexDomain domain = box({-3, -3, 0}, {3, 3, 6});
  const auto all = cells_of(domain, packing.sites);
  EXPECT_EQ(totals_of(all).outside, 3u);
  EXPECT_EQ(totals_of(all).alive, 156u);
  EXPECT_NEAR(totals_of(all).cell_volume, 216, 1e-10);
  // The table was made without the three that lie outside.
  std::vector<geometry::PowerSite> inside;
  std::vector<int> ids;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].state == geometry::SiteState::outside) continue;
    inside.push_back(packing.sites[i]);
    ids.push_back(packing.ids[i]);
  }
  const auto cells = cells_of(domain, inside);
  EXPECT_NEAR(totals_of(cells).cell_volume, 216, 1e-10);
  std::ifstream file(table);
  std::string line;
  std::getline(file, line);
  int rows = 0;
  while (std::getline(file, line)) {
    const int id = std::stoi(line);
    const auto text = line.substr(line.find(',') + 1);
    const double wanted = parse_number(text.substr(0, text.find(','))).value();
    const auto at = std::find(ids.begin(), ids.end(), id);
    ASSERT_NE(at, ids.end());
    EXPECT_NEAR(cells[static_cast<std::size_t>(at - ids.begin())].cell_volume, wanted, 2e-12) << "id " << id;
    ++rows;
  }
  EXPECT_EQ(rows, 156);
}

void expect_swallowed(const std::filesystem::path& path) {
  Packing packing = read_packing(path);
  for (std::size_t i = 7; i < packing.sites.size(); i += 8) packing.sites[i].weight = 1.6 * 1.6;
  const auto cells = cells_of(box({-3, -3, 0}, {3, 3, 6}), packing.sites);
  const geometry::CellTotals totals = totals_of(cells);
  // 124 have a cell; of these 7 have one that their own ball does not reach, which the reference (no balls) does not ask.
  EXPECT_EQ(totals.alive + totals.starved, 124u);
  EXPECT_EQ(totals.starved, 7u);
  EXPECT_EQ(totals.hidden, 32u);
  EXPECT_EQ(totals.outside, 3u);
  EXPECT_NEAR(totals.cell_volume, 216, 1e-10);
  for (const geometry::CellMeasure& cell : cells) EXPECT_EQ(cell.reason.empty(), cell.state == geometry::SiteState::alive);
}

// Places along one line with weights of their own, and how long the cell of each is within (0, 1): by comparing all with all.
struct Row {
  std::vector<double> places, weights, lengths;
};

Row random_row(Random& random, std::size_t count, double largest_weight) {
  Row row;
  for (std::size_t i = 0; i < count; ++i) {
    row.places.push_back((static_cast<double>(i) + random.uniform(0.2, 0.8)) / static_cast<double>(count));
    row.weights.push_back(random.uniform(0, largest_weight));
  }
  for (std::size_t i = 0; i < count; ++i) {
    double low = 0, high = 1;
    for (std::size_t j = 0; j < count; ++j) {
      if (j == i) continue;
      const double apart = row.places[j] - row.places[i];
      const double border = 0.5 * (row.places[i] + row.places[j] + (row.weights[i] - row.weights[j]) / apart);
      if (apart < 0) low = std::max(low, border);
      else high = std::min(high, border);
    }
    row.lengths.push_back(std::max(0.0, high - low));
  }
  return row;
}

// Weights that are sums along the axes make boxes of all cells, and swallow whole layers of sites.
void expect_boxes(const Row& x, const Row& y, const Row& z, int& swallowed) {
  std::vector<geometry::PowerSite> sites;
  std::vector<double> volumes;
  for (std::size_t i = 0; i < x.places.size(); ++i) {
    for (std::size_t j = 0; j < y.places.size(); ++j) {
      for (std::size_t k = 0; k < z.places.size(); ++k) {
        sites.push_back({{x.places[i], y.places[j], z.places[k]}, x.weights[i] + y.weights[j] + z.weights[k]});
        volumes.push_back(x.lengths[i] * y.lengths[j] * z.lengths[k]);
      }
    }
  }
  const auto cells = cells_of(unit_cube(), sites);
  EXPECT_NEAR(totals_of(cells).cell_volume, 1, 1e-12);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    EXPECT_NEAR(cells[i].cell_volume, volumes[i], 1e-13) << i;
    EXPECT_EQ(cells[i].state == geometry::SiteState::hidden, volumes[i] == 0) << i << " " << name_of(cells[i].state);
    swallowed += volumes[i] == 0;
  }
}

TEST(Oracle, PackingsOfUnequalSpheres) {
  Random random(71);
  int swallowed = 0;
  for (int round = 0; round < 10; ++round) {
    const Row x = random_row(random, 6, 0.06), y = random_row(random, 5, 0.06), z = random_row(random, 5, 0.06);
    expect_boxes(x, y, z, swallowed);
  }
  EXPECT_GT(swallowed, 100);
  EXPECT_LT(swallowed, 1200);
  // A packing that others have measured, where the shared folder is.
  const auto path = shared_file("data/laguerre/voro_pack_six_cube_poly.txt");
  const auto table = shared_file("data/laguerre/voro_pack_six_cube_poly_volumes.csv");
  if (!path.empty() && !table.empty()) expect_volumes(path, table);
  if (!path.empty()) expect_swallowed(path);
}

}  // namespace
}  // namespace bl::test
