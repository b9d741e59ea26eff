// Footprints against the plans of boundaries; the shares decide, and the sites' tables of exclusions grow.
#include "core/making/site_buildings.h"

#include <algorithm>
#include <cmath>

#include "core/base/plural.h"
#include "core/base/text.h"
#include "core/geometry/domain_table.h"
#include "core/import/box_grid.h"
#include "core/import/plan_cover.h"
#include "core/making/site_grounds.h"
#include "core/making/tidy_length.h"

namespace bl::making {

namespace {

// Lines of maps and of plots differ by some decimetres: what reaches in by no more than this stands beside the site.
constexpr double kInexactArea = 1;      // [m²]
constexpr double kInexactShare = 0.01;  // [ratio] of the footprint
// Of a building of which less lies inside, the site is not the place.
constexpr double kOwnShare = 0.5;  // [ratio]
// An area of the map that covers more of a site is what the site lies in, not something in it.
constexpr double kMostLeftOut = 0.9;  // [ratio]

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

importing::PlanShape shape_of(const std::vector<geometry::Ring>& rings) {
  importing::PlanShape shape;
  for (const geometry::Ring& ring : rings) shape.push_back(&ring);
  return shape;
}

importing::PlanShape shape_of(const importing::ContextBuilding& building) {
  importing::PlanShape shape{&building.outer};
  for (const geometry::Ring& hole : building.holes) shape.push_back(&hole);
  return shape;
}

double footprint_of(const importing::ContextBuilding& building) {
  double area = std::abs(geometry::signed_area(building.outer));
  for (const geometry::Ring& hole : building.holes) area -= std::abs(geometry::signed_area(hole));
  return area;
}

std::string share_text(double share) { return fixed(std::min(100.0, 100 * share), 0) + " %"; }

// A ring of exclusions, one corner per row.
void add_exclusion(Table& rows, const std::string& name, const std::string& use, const geometry::Ring& ring, double bottom,
                   double top) {
  for (const Point3& corner : ring) {
    TableRow& row = rows.rows.emplace_back();
    for (const std::string& column : rows.columns)
      if (column == "name" || column == "use") row.emplace_back(column == "name" ? name : use);
      else
        row.emplace_back(column == "x"     ? tidy_length(corner.x)
                         : column == "y"   ? tidy_length(corner.y)
                         : column == "top" ? top
                                           : bottom);
  }
}

}  // namespace

SiteBuildings::SiteBuildings(const Scene& scene, const Registry& registry, InsideChoice choice, AskToClear ask)
    : choice_(choice), ask_(std::move(ask)) {
  const TypificationDefinition* type = registry.typification("boundary");
  const PortDefinition* table = type == nullptr ? nullptr : type->find_port("exclusions");
  if (table == nullptr) return;
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
    sites_.push_back(std::move(site));
  }
}

// What of a building lies inside of a site [m²], where it stands in its heights at all.
double SiteBuildings::inside(const Site& site, const importing::ContextBuilding& building) const {
  if (building.base >= site.top || building.base + building.height <= site.bottom) return 0;
  const importing::PlanBox box = importing::plan_box(building.outer);
  double area = 0;
  for (const std::vector<geometry::Ring>& ground : site.grounds) {
    const importing::PlanBox other = importing::plan_box(ground.front());
    if (box.west >= other.east || box.east <= other.west || box.south >= other.north || box.north <= other.south) continue;
    area = std::max(area, importing::common_area(shape_of(building), shape_of(ground)));
  }
  return area;
}

bool SiteBuildings::clears(std::size_t buildings, const std::string& site) {
  if (choice_ == InsideChoice::unsaid) {
    is_assumed_ = !ask_;
    choice_ = ask_ && ask_(buildings, site) ? InsideChoice::clear : InsideChoice::keep;
  }
  return choice_ == InsideChoice::clear;
}

void SiteBuildings::judge(const importing::Context& context) {
  stays_.clear();
  for (std::size_t s = 0; s < sites_.size(); ++s) {
    // Parts share the fate of their building.
    struct Whole {
      std::vector<std::size_t> buildings;
      double inside = 0, footprint = 0;
    };
    std::map<std::string, Whole> wholes;
    std::map<std::size_t, double> areas;
    for (std::size_t b = 0; b < context.buildings.size(); ++b) {
      const importing::ContextBuilding& building = context.buildings[b];
      const double area = inside(sites_[s], building);
      if (area > 0) areas[b] = area;
      if (area <= 0 && building.whole.empty()) continue;
      Whole& whole = wholes[building.whole.empty() ? "building " + std::to_string(b) : "whole " + building.whole];
      whole.buildings.push_back(b);
      whole.inside += area;
      whole.footprint += footprint_of(building);
    }
    std::erase_if(wholes, [](const auto& entry) {
      return entry.second.inside <= kInexactArea && entry.second.inside <= kInexactShare * entry.second.footprint;
    });
    const auto own = static_cast<std::size_t>(std::count_if(wholes.begin(), wholes.end(), [](const auto& entry) {
      return entry.second.inside >= kOwnShare * entry.second.footprint;
    }));
    const bool is_clearing = own > 0 && clears(own, sites_[s].id);
    for (const auto& [name, whole] : wholes) {
      const double share = whole.inside / whole.footprint;
      const bool is_own = share >= kOwnShare, is_cleared = is_own && is_clearing;
      const std::size_t number = ++judged_;
      sites_[s].cleared += is_cleared ? 1 : 0;
      for (const std::size_t b : whole.buildings)
        if (is_cleared || areas.contains(b)) stays_[b].push_back({s, share, number, is_own, is_cleared});
    }
  }
}

bool SiteBuildings::is_cleared(std::size_t building) const {
  const auto stays = stays_.find(building);
  return stays != stays_.end() &&
         std::any_of(stays->second.begin(), stays->second.end(), [](const Stay& stay) { return stay.is_cleared; });
}

// The parts of the ground that lie in the site replace those of the same name that were left out before.
bool SiteBuildings::leave_out(Site& site, const std::string& name, const std::string& use,
                              const std::vector<geometry::Ring>& rings) {
  std::vector<const geometry::Ring*> inside;
  double area = 0, whole = 0;
  for (const std::vector<geometry::Ring>& ground : site.grounds) {
    whole += std::abs(geometry::signed_area(ground.front()));
    for (const geometry::Ring& ring : rings) {
      const importing::PlanBox box = importing::plan_box(ring), other = importing::plan_box(ground.front());
      if (box.west >= other.east || box.east <= other.west || box.south >= other.north || box.north <= other.south) continue;
      const double common = importing::common_area({&ring}, shape_of(ground));
      area += common;
      if (common > kInexactArea && std::find(inside.begin(), inside.end(), &ring) == inside.end()) inside.push_back(&ring);
    }
  }
  if (inside.empty()) return false;
  if (area > kMostLeftOut * whole) {
    ground_notes_.push_back("`" + name + "` covers " + share_text(area / whole) + " of the site `" + site.id +
                            "`, and the site keeps that ground: nothing would be left to build on.");
    return false;
  }
  const std::size_t column = site.rows.column("name");
  std::erase_if(site.rows.rows, [&](const TableRow& row) {
    const std::string& other = std::get<std::string>(row[column]);
    return other == name || other.starts_with(name + " part ");
  });
  for (std::size_t i = 0; i < inside.size(); ++i) {
    const std::string part = inside.size() == 1 ? name : name + " part " + std::to_string(i + 1);
    add_exclusion(site.rows, part, use, *inside[i], tidy_length(site.bottom), tidy_length(site.top));
  }
  return true;
}

void SiteBuildings::clear_grounds(const importing::Context& context, const std::set<std::string>& kinds, bool takes_all_streets) {
  left_out_.clear();
  if (kinds.empty()) return;
  if (sites_.empty()) {
    ground_notes_.push_back("The scene has no site, so that nothing is kept clear: add one, and import again.");
    return;
  }
  for (Site& site : sites_) {
    if (kinds.contains("streets"))
      for (const importing::ContextStreet& street : context.streets)
        if ((street.for_cars || takes_all_streets) && leave_out(site, "street " + street.id, "", street_ground(street)))
          ++site.grounds_left_out["streets"];
    for (const importing::ContextArea& area : context.areas) {
      const std::string kind(ground_kind(area.use));
      if (area.is_plot || !kinds.contains(kind) || !leave_out(site, kind + " " + area.id, open_use_of(area.use), {area.outer}))
        continue;
      ++site.grounds_left_out[kind];
      left_out_[area.id] = site.id;
    }
  }
}

std::string SiteBuildings::site_without(const importing::ContextArea& area) const {
  const auto site = left_out_.find(area.id);
  return site == left_out_.end() ? "" : site->second;
}

bool SiteBuildings::has_cleared() const {
  return std::any_of(sites_.begin(), sites_.end(), [](const Site& site) { return site.cleared > 0; });
}

void SiteBuildings::keep(std::size_t building, const importing::ContextBuilding& made, const std::string& node, bool is_changed,
                         importing::ImportReport& report) {
  const auto stays = stays_.find(building);
  if (stays == stays_.end()) return;
  for (const Stay& stay : stays->second) {
    Site& site = sites_[stay.site];
    if (made.row != importing::kNoRow)
      report.remark(made.row, share_text(stay.share) + " of it inside the site `" + site.id + "`, which leaves its ground out");
    // Only now: another site may have cleared what this one would keep.
    (stay.is_own ? site.kept : site.reaching).insert(stay.whole);
    const std::size_t before = site.rows.row_of("name", node);
    if (!is_changed && before < site.rows.rows.size()) continue;
    if (before < site.rows.rows.size()) {
      const std::size_t name = site.rows.column("name");
      std::erase_if(site.rows.rows, [&](const TableRow& row) { return std::get<std::string>(row[name]) == node; });
    }
    // From the underside of the site: nothing is built below a building that stays.
    const double bottom = tidy_length(std::min(made.base, site.bottom)), top = tidy_length(made.base + made.height);
    add_exclusion(site.rows, node, "", made.outer, bottom, top);
  }
}

std::vector<std::pair<std::string, Table>> SiteBuildings::exclusions() const {
  std::vector<std::pair<std::string, Table>> changed;
  for (const Site& site : sites_)
    if (site.rows != site.rows_before) changed.emplace_back(site.id, site.rows);
  return changed;
}

std::vector<std::string> SiteBuildings::notes() const {
  std::vector<std::string> notes = ground_notes_;
  for (const Site& site : sites_) {
    std::string grounds;
    for (const auto& [kind, number] : site.grounds_left_out)
      grounds += (grounds.empty() ? "" : ", ") +
                 (kind == "streets" ? how_many(number, "piece") + " of street" : how_many(number, "area") + " of " + kind);
    if (!grounds.empty())
      notes.push_back("The site `" + site.id + "` leaves out the ground of " + grounds +
                      " (streets: in the width that the file gives, else by their lanes with a path on each side).");
    const std::string where = " inside the site `" + site.id + "`";
    if (site.cleared > 0)
      notes.push_back(how_many(site.cleared, "building") + by_number(site.cleared, " that stands", " that stand") + where +
                      by_number(site.cleared, " was left out.", " were left out."));
    if (const std::size_t kept = site.kept.size(); kept > 0)
      notes.push_back(how_many(kept, "building") + by_number(kept, " stands", " stand") + where +
                      by_number(kept, " and stays", " and stay") + ": the site leaves out the ground under " +
                      by_number(kept, "it", "them") + ", courts included, up to " + by_number(kept, "its roof.", "their roofs.") +
                      (is_assumed_ ? " That is what --keep does; --clear leaves such buildings out of the scene." : ""));
    if (const std::size_t reaching = site.reaching.size(); reaching > 0)
      notes.push_back(how_many(reaching, "building") + by_number(reaching, " reaches", " reach") + " into the site `" + site.id +
                      "` with less than half of " + by_number(reaching, "its", "their") + " ground and " +
                      by_number(reaching, "stays", "stay") + ": the site leaves that ground out.");
  }
  return notes;
}

}  // namespace bl::making
