// Every element of a cell complex with its name, its measure and what bounds it.
#include "ui/cli/complex_json.h"

#include <nlohmann/json.hpp>

#include "core/geometry/cell_complex.h"

namespace bl::cli {

namespace {

Json corner_json(const Point3& p) { return {p.x, p.y, p.z}; }

Json names_json(const std::vector<geometry::ElementName>& names) {
  Json list = Json::array();
  for (const geometry::ElementName& name : names) list.push_back(name.text());
  return list;
}

Json polygons_json(const std::vector<std::vector<Point3>>& polygons) {
  Json list = Json::array();
  for (const auto& polygon : polygons) {
    Json points = Json::array();
    for (const Point3& p : polygon) points.push_back(corner_json(p));
    list.push_back(std::move(points));
  }
  return list;
}

}  // namespace

Result<Json> complex_json(const geometry::PowerDiagram& diagram, std::span<const geometry::PowerSite> sites) {
  geometry::CellComplex complex;
  if (auto built = complex.update(diagram, sites); !built) return built.error();
  Json vertices = Json::array(), edges = Json::array(), facets = Json::array();
  for (const geometry::ElementName& name : complex.names(geometry::ElementKind::vertex)) {
    vertices.push_back({{"name", name.text()}, {"position", corner_json(*complex.position(name))}});
  }
  for (const geometry::ElementName& name : complex.names(geometry::ElementKind::edge)) {
    edges.push_back(
        {{"name", name.text()},
         {"length", complex.length(name)},
         {"vertices", names_json(complex.incident({geometry::ElementKind::edge, name}, geometry::ElementKind::vertex))}});
  }
  for (const geometry::ElementName& name : complex.names(geometry::ElementKind::facet)) {
    facets.push_back({{"name", name.text()},
                      {"area", complex.area(name)},
                      {"edges", names_json(complex.incident({geometry::ElementKind::facet, name}, geometry::ElementKind::edge))},
                      {"polygons", polygons_json(complex.polygons(name))}});
  }
  return Json{{"vertices", std::move(vertices)}, {"edges", std::move(edges)}, {"facets", std::move(facets)}};
}

}  // namespace bl::cli
