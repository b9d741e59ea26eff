// What the tests of the cell complex share: a diagram with its complex, and what has to hold of every complex.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "core/geometry/cell_complex.h"
#include "tests/core/geometry/geometry_support.h"

namespace bl::test {

using Kind = geometry::ElementKind;

inline geometry::ElementName named(const char* text) {
  const auto name = geometry::ElementName::parse(text);
  EXPECT_TRUE(name.ok()) << text;
  return name.ok() ? *name : geometry::ElementName{};
}

inline std::string joined(const std::vector<geometry::ElementName>& names) {
  std::string text;
  for (const geometry::ElementName& name : names) text += (text.empty() ? "" : " ") + name.text();
  return text;
}

inline geometry::CellOptions outlines() {
  geometry::CellOptions options;
  options.with_outlines = true;
  return options;
}

/// A diagram and the complex that follows it.
struct Live {
  geometry::PowerDiagram diagram;
  geometry::CellComplex complex;
  explicit Live(const geometry::Domain& domain) { EXPECT_TRUE(diagram.set_domain(domain).ok()); }
  void update(const std::vector<geometry::PowerSite>& sites) {
    const auto cells = diagram.update(sites, outlines());
    ASSERT_TRUE(cells.ok()) << cells.error().text();
    const auto done = complex.update(diagram, sites);
    ASSERT_TRUE(done.ok()) << done.error().text();
  }
};

inline std::string rebuilt(const geometry::Domain& domain, const std::vector<geometry::PowerSite>& sites,
                           const std::vector<std::uint32_t>& labels = {}) {
  Live fresh(domain);
  EXPECT_TRUE(fresh.complex.set_labels(labels).ok());
  fresh.update(sites);
  return fresh.complex.listing();
}

inline void expect_whole(const geometry::CellComplex& complex, const std::string& what) {
  for (const std::string& complaint : complex.verify()) ADD_FAILURE() << what << ": " << complaint;
}

/// Incidence asked from one side is what is answered from the other.
inline void expect_symmetric(const geometry::CellComplex& complex) {
  for (const Kind kind : {Kind::cell, Kind::facet, Kind::edge, Kind::vertex}) {
    for (const Kind other : {Kind::cell, Kind::facet, Kind::edge, Kind::vertex}) {
      if (kind == other) continue;
      std::size_t there = 0, back = 0;
      for (const geometry::ElementName& name : complex.names(kind)) {
        for (const geometry::ElementName& found : complex.incident({kind, name}, other)) {
          ++there;
          const auto answers = complex.incident({other, found}, kind);
          EXPECT_TRUE(std::binary_search(answers.begin(), answers.end(), name)) << name.text() << " " << found.text();
        }
      }
      for (const geometry::ElementName& name : complex.names(other)) back += complex.incident({other, name}, kind).size();
      EXPECT_EQ(there, back);
    }
  }
}

inline std::vector<geometry::PowerSite> lattice(int n, double weight = 0) {
  std::vector<geometry::PowerSite> sites;
  for (int i = 0; i < n * n * n; ++i) {
    const auto at = [&](int k) { return (k + 0.5) / n; };
    sites.push_back({{at(i % n), at(i / n % n), at(i / n / n)}, weight});
  }
  return sites;
}

}  // namespace bl::test
