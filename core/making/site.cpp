// Reads boundaries of all forms, and writes their exclusions, one corner per row.
#include "core/making/site.h"

#include <algorithm>
#include <iterator>

#include "core/geometry/domain_table.h"
#include "core/import/box_grid.h"
#include "core/making/tidy_length.h"

namespace bl::making {

namespace {

const Value& port_value(const Scene& scene, const NodeRecord& node, const TypificationDefinition& type, const char* port) {
  static const Value nothing;
  const PortDefinition* found = type.find_port(port);
  return found == nullptr ? nothing : set_value(scene, node, type, *found);
}

std::vector<Point3> points_in(const Value& value) {
  const auto* points = std::get_if<Shared<std::vector<Point3>>>(&value);
  return points == nullptr ? std::vector<Point3>() : **points;
}

std::vector<geometry::NamedRing> rings_in(const Value& value) {
  const auto* table = std::get_if<Shared<Table>>(&value);
  return table == nullptr ? std::vector<geometry::NamedRing>() : geometry::read_rings(**table);
}

void add_rows(const Exclusion& exclusion, const std::vector<std::string>& columns, std::vector<TableRow>& rows) {
  for (const Point3& corner : exclusion.ring) {
    TableRow& row = rows.emplace_back();
    for (const std::string& column : columns)
      if (column == "name" || column == "use") row.emplace_back(column == "name" ? exclusion.name : exclusion.use);
      else
        row.emplace_back(tidy_length(column == "x"     ? corner.x
                                     : column == "y"   ? corner.y
                                     : column == "top" ? exclusion.top
                                                       : exclusion.bottom));
  }
}

}  // namespace

std::vector<Site> sites_of(const Scene& scene, const Registry& registry) {
  std::vector<Site> sites;
  const TypificationDefinition* type = registry.typification("boundary");
  const PortDefinition* table = type == nullptr ? nullptr : type->find_port("exclusions");
  if (table == nullptr) return sites;
  for (const auto& [id, node] : scene.nodes) {
    if (!node.types.contains("boundary")) continue;
    const auto value = [&, &record = node](const char* port) -> const Value& { return port_value(scene, record, *type, port); };
    const std::string form = std::get<std::string>(value("form"));
    Site site;
    site.id = id;
    site.rows = *std::get<Shared<Table>>(value("exclusions"));
    site.rows.columns.clear();
    for (const ColumnDefinition& column : table->columns) site.rows.columns.push_back(column.id);
    site.rows_before = site.rows;
    std::vector<Point3> corners = points_in(value(form == "plan" ? "plan" : form == "hull" ? "points" : "vertices"));
    if (corners.size() < 3) continue;
    if (form == "plan") {
      std::vector<geometry::Ring> rings{corners};
      for (geometry::NamedRing& hole : rings_in(value("holes"))) rings.push_back(std::move(hole.corners));
      site.grounds.push_back(std::move(rings));
      site.bottom = as_number(value("bottom"));
      site.top = site.bottom + as_number(value("height"));
      for (geometry::NamedRing& step : rings_in(value("steps"))) {
        site.top = std::max(site.top, step.top);
        site.grounds.push_back({std::move(step.corners)});
      }
    } else {
      // Of a hull or a mesh all that lies under it: its corners' hull in plan.
      site.bottom = site.top = corners.front().z;
      for (const Point3& corner : corners) site.bottom = std::min(site.bottom, corner.z), site.top = std::max(site.top, corner.z);
      site.grounds.push_back({geometry::hull_of_plan(corners)});
    }
    std::erase_if(site.grounds, [](const std::vector<geometry::Ring>& rings) { return rings.front().size() < 3; });
    sites.push_back(std::move(site));
  }
  return sites;
}

bool is_on(const Site& site, const Point3& place) {
  return std::any_of(site.grounds.begin(), site.grounds.end(), [&](const std::vector<geometry::Ring>& rings) {
    std::size_t around = 0;
    for (const geometry::Ring& ring : rings) around += geometry::ring_contains(ring, place) ? 1 : 0;
    return around % 2 == 1;
  });
}

double area_on(const std::vector<geometry::Ring>& ground, const importing::PlanShape& shape) {
  const importing::PlanBox box = importing::plan_box(*shape.front()), other = importing::plan_box(ground.front());
  const bool is_apart = box.west >= other.east || box.east <= other.west || box.south >= other.north || box.north <= other.south;
  if (is_apart) return 0;
  importing::PlanShape rings;
  for (const geometry::Ring& ring : ground) rings.push_back(&ring);
  return importing::common_area(shape, rings);
}

bool Site::replace(const std::function<bool(const std::string&)>& is_old, const std::vector<Exclusion>& exclusions) {
  const std::size_t name = rows.column("name");
  const auto is_gone = [&](const TableRow& row) { return is_old(std::get<std::string>(row[name])); };
  const auto first = std::find_if(rows.rows.begin(), rows.rows.end(), is_gone);
  const bool had_some = first != rows.rows.end();
  const auto place = first - rows.rows.begin();
  rows.rows.erase(std::remove_if(first, rows.rows.end(), is_gone), rows.rows.end());
  insert(place, exclusions);
  return had_some;
}

void Site::extend(const std::function<bool(const std::string&)>& belongs, const std::vector<Exclusion>& exclusions) {
  const std::size_t name = rows.column("name");
  const auto last = std::find_if(rows.rows.rbegin(), rows.rows.rend(),
                                 [&](const TableRow& row) { return belongs(std::get<std::string>(row[name])); });
  insert(last == rows.rows.rend() ? rows.rows.end() - rows.rows.begin() : last.base() - rows.rows.begin(), exclusions);
}

void Site::insert(std::ptrdiff_t place, const std::vector<Exclusion>& exclusions) {
  std::vector<TableRow> made;
  for (const Exclusion& exclusion : exclusions) add_rows(exclusion, rows.columns, made);
  rows.rows.insert(rows.rows.begin() + place, std::make_move_iterator(made.begin()), std::make_move_iterator(made.end()));
}

bool Site::leaves_out(const std::string& name) const {
  for (std::size_t row = 0; row < rows.rows.size(); ++row)
    if (rows.text(row, "name") == name) return true;
  return false;
}

bool Site::replace(const std::string& name, const std::vector<Exclusion>& exclusions) {
  return replace([&](const std::string& other) { return other == name; }, exclusions);
}

}  // namespace bl::making
