// Chooses the geometry of each object, checks its solid, and finds its outline; every object has its row in the report.
#include "core/import/cityjson_context.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>

#include "core/base/plural.h"
#include "core/base/text.h"
#include "core/import/box_grid.h"
#include "core/import/cityjson_model.h"
#include "core/import/context_shape.h"
#include "core/import/osm_tags.h"

namespace bl::importing {

namespace {

// Some twenty seconds for the large faces of a file; those of real city models take none of it.
constexpr double kMostEffort = 4e9;

bool is_building(const std::string& type) { return type == "Building" || type == "BuildingPart"; }

bool is_ground(const std::string& type) {
  return type == "Road" || type == "Railway" || type == "TransportSquare" || type == "Waterway" || type == "LandUse" ||
         type == "PlantCover" || type == "WaterBody";
}

std::string attribute(const CityObject& object, std::initializer_list<const char*> names) {
  for (const char* name : names)
    for (const auto& [key, value] : object.attributes)
      if (key == name) return value;
  return {};
}

void note_of_building(std::string& text, const std::string& more) {
  if (!more.empty()) text += (text.empty() ? "" : ", ") + more;
}

class CityImporter {
 public:
  CityImporter(const CityModel& model, const ContextOptions& options, const LocalFrame& frame, double height_unit,
               Context& context)
      : model_(model), options_(options), context_(context) {
    for (const auto& list : model.vertices) {
      auto& local = vertices_.emplace_back();
      local.reserve(list.size());
      for (const Point3& p : list) {
        Point3 place = frame.to_local(p.x, p.y);
        place.z = p.z * height_unit;
        local.push_back(place);
      }
    }
    for (const CityObject& object : model.objects) by_id_.emplace(object.id, &object);
  }

  void run() {
    for (std::size_t i = 0; i < model_.objects.size(); ++i) {
      const CityObject& object = model_.objects[i];
      if (i % 64 == 0 && !goes_on(options_.watch, "city objects", i, model_.objects.size())) return;
      if (is_building(object.type)) building(object);
      else if (is_ground(object.type)) ground(object);
      else context_.report.skip(object.type, object.id, "objects of this type are not read");
      context_.report.locate(place(object));
    }
  }

 private:
  // The finest geometry that is not finer than asked for; of equal ones a solid, then the first.
  const CityGeometry* choose(const CityObject& object, std::string& faults) const {
    const CityGeometry* best = nullptr;
    for (const CityGeometry& geometry : object.geometries) {
      if (!geometry.fault.empty()) {
        note_of_building(faults, geometry.fault);
        continue;
      }
      if (geometry.level_of_detail > options_.level_of_detail) continue;
      const bool is_better = best == nullptr || geometry.level_of_detail > best->level_of_detail ||
                             (geometry.level_of_detail == best->level_of_detail && geometry.solids > 0 && best->solids == 0);
      if (is_better) best = &geometry;
    }
    return best;
  }

  bool has_drawn_parts(const CityObject& object) const {
    std::string none;
    return std::any_of(object.children.begin(), object.children.end(), [&](const std::string& id) {
      const auto child = by_id_.find(id);
      return child != by_id_.end() && child->second->type == "BuildingPart" && choose(*child->second, none) != nullptr;
    });
  }

  // Of whatever geometry it has, or its parts have.
  std::optional<std::array<double, 2>> place(const CityObject& object) const {
    std::vector<Point3> points;
    const auto add = [&](const CityObject& one) {
      for (const CityGeometry& geometry : one.geometries) {
        const std::vector<Point3> more = corners(one, geometry);
        points.insert(points.end(), more.begin(), more.end());
      }
    };
    add(object);
    for (const std::string& id : object.children)
      if (const auto child = by_id_.find(id); child != by_id_.end() && points.empty()) add(*child->second);
    return place_of(points);
  }

  // Each object has one row: the next one is that of the object which is being read.
  std::size_t next_row() const { return context_.report.rows().size(); }

  std::vector<Point3> corners(const CityObject& object, const CityGeometry& geometry) const {
    std::vector<Point3> points;
    for (const CitySurface& surface : geometry.surfaces)
      for (const auto& ring : surface.rings)
        for (const std::uint32_t index : ring) points.push_back(vertices_[object.vertices][index]);
    return points;
  }

  struct Outline {
    geometry::Ring outer;
    std::vector<geometry::Ring> holes;
    std::string mended, fault;
  };

  // The largest ring with the holes in it; the hull of all corners where the surfaces give no simple ring.
  std::vector<Outline> outlines(const CityObject& object, const CityGeometry& geometry, const std::vector<Point3>& points) const {
    std::vector<Outline> outers = simple_outlines(object, geometry, points);
    for (Outline& outline : outers) {
      if (is_building(object.type) && outline.fault.empty())
        outline.fault = limit_corners(outline.outer, outline.holes, outline.mended);
      if (outline.fault.empty()) sort_holes(outline.outer, outline.holes, outline.mended);
    }
    return outers;
  }

  std::vector<Outline> simple_outlines(const CityObject& object, const CityGeometry& geometry,
                                       const std::vector<Point3>& points) const {
    std::vector<Outline> outers;
    std::vector<geometry::Ring> holes;
    std::string fault;
    for (const geometry::Ring& ring : city_outlines(vertices_[object.vertices], geometry.surfaces)) {
      const bool is_hole = geometry::signed_area(ring) < 0;
      SoundRing sound = sound_ring(ring, !is_hole);
      if (!sound.fault.empty()) {
        fault = sound.fault;
        continue;
      }
      if (is_hole) holes.push_back(std::move(sound.ring));
      else outers.push_back({std::move(sound.ring), {}, sound.mended, ""});
    }
    if (outers.empty()) {
      SoundRing hull = sound_ring(geometry::hull_of_plan(points), true);
      outers.push_back(
          {std::move(hull.ring), {}, hull.fault.empty() ? "its outline is the hull of its corners" : "", hull.fault});
      return outers;
    }
    if (!fault.empty()) note_of_building(outers.front().mended, "a ring left out: " + fault);
    std::sort(outers.begin(), outers.end(),
              [](const Outline& a, const Outline& b) { return geometry::signed_area(a.outer) > geometry::signed_area(b.outer); });
    const BoxGrid grid = BoxGrid::of(outers, [](const Outline& outline) -> const geometry::Ring& { return outline.outer; });
    for (geometry::Ring& hole : holes)
      for (const std::size_t home : grid.meeting(plan_box(std::span(&hole.front(), 1))))
        if (geometry::ring_contains(outers[home].outer, hole.front())) {
          outers[home].holes.push_back(std::move(hole));
          break;
        }
    return outers;
  }

  // Nothing where it is too far away or has no sound outline; its row says so then.
  std::vector<Outline> outlines_in_reach(const CityObject& object, const CityGeometry& geometry,
                                         const std::vector<Point3>& points) {
    std::vector<Outline> found;
    std::string fault = out_of_reach(options_, points);
    if (fault.empty()) {
      found = outlines(object, geometry, points);
      fault = found.front().fault;
    }
    if (fault.empty()) return found;
    context_.report.skip(object.type, object.id, fault);
    return {};
  }

  void building(const CityObject& object) {
    std::string faults, mended;
    const CityGeometry* geometry = choose(object, faults);
    const bool is_drawn_by_parts = has_drawn_parts(object);
    // Its own outline in level 0 says nothing that the parts do not say.
    if (is_drawn_by_parts && (geometry == nullptr || geometry->level_of_detail < 1))
      return context_.report.take(object.type, object.id, "drawn by its parts", how_many(object.children.size(), "part"));
    if (geometry == nullptr) return context_.report.skip(object.type, object.id, "no geometry that can be read", faults);
    const std::vector<Point3> points = corners(object, *geometry);
    std::vector<Outline> found = outlines_in_reach(object, *geometry, points);
    if (found.empty()) return;
    note_of_building(mended, found.front().mended);
    ContextBuilding made;
    made.id = object.id;
    made.row = next_row();
    made.is_above_sea = true;
    made.outer = std::move(found.front().outer);
    made.holes = std::move(found.front().holes);
    describe(object, made);
    measure(object, *geometry, points, made, mended);
    if (const std::string beyond = out_of_heights(made.base, made.height); !beyond.empty())
      return context_.report.skip(object.type, object.id, beyond, "from " + shortest(made.base) + " m");
    if (found.size() > 1)
      note_of_building(mended, how_many(found.size() - 1, made.solid ? "more outline" : "smaller outline") +
                                   (made.solid ? " only in its solid" : " left out"));
    const std::string reason = made.solid ? "building with a solid" : "building as an extrusion";
    if (mended.empty()) context_.report.take(object.type, object.id, reason);
    else context_.report.repair(object.type, object.id, reason, mended);
    context_.buildings.push_back(std::move(made));
  }

  void describe(const CityObject& object, ContextBuilding& made) const {
    const CityObject* whole = &object;
    if (!object.parents.empty())
      if (const auto parent = by_id_.find(object.parents.front()); parent != by_id_.end()) {
        whole = parent->second;
        made.whole = whole->id;
        made.is_part = object.type == "BuildingPart";
      }
    for (const CityObject* from : {&object, whole}) {
      if (made.name.empty()) made.name = attribute(*from, {"name", "Name"});
      if (made.use.empty()) made.use = attribute(*from, {"function", "usage", "use", "class"});
    }
  }

  // Base, height and solid from the geometry; from attributes where it is flat.
  void measure(const CityObject& object, const CityGeometry& geometry, const std::vector<Point3>& points, ContextBuilding& made,
               std::string& mended) {
    const auto [low, high] =
        std::minmax_element(points.begin(), points.end(), [](const Point3& a, const Point3& b) { return a.z < b.z; });
    made.base = low->z;
    if (geometry.level_of_detail >= 1 && high->z - low->z > 0.01) {
      made.height = high->z - low->z;
      made.height_source = HeightSource::geometry;
      effort_ += triangles_effort(geometry.surfaces);
      if (effort_ > kMostEffort) return note_of_building(mended, "its faces have too many corners: drawn as an extrusion");
      CitySolid solid = city_solid(vertices_[object.vertices], geometry.surfaces);
      if (solid.is_closed && solid.volume > 0) {
        if (solid.had_no_floor) note_of_building(mended, "its solid had no floor, which was added");
        if (solid.was_turned) note_of_building(mended, "surfaces that looked inward were turned");
        made.solid = std::make_shared<const Mesh>(std::move(solid.mesh));
      } else if (geometry.solids > 0) {
        note_of_building(mended,
                         "its solid is not closed (" + how_many(solid.open_edges, "open edge") + "): drawn as an extrusion");
      }
      return;
    }
    if (const auto height = osm_length(attribute(object, {"measuredHeight", "height"})); height && *height > 0) {
      made.height = *height;
      made.height_source = HeightSource::tag;
    } else if (const auto levels = osm_number(attribute(object, {"storeysAboveGround", "b3_bouwlagen"})); levels && *levels > 0) {
      made.height = *levels * options_.storey_height;
      made.height_source = HeightSource::levels;
    }
  }

  void ground(const CityObject& object) {
    std::string faults, mended;
    const CityGeometry* geometry = choose(object, faults);
    if (geometry == nullptr) return context_.report.skip(object.type, object.id, "no geometry that can be read", faults);
    std::vector<Outline> found = outlines_in_reach(object, *geometry, corners(object, *geometry));
    if (found.empty()) return;
    for (std::size_t i = 0; i < found.size(); ++i) {
      note_of_building(mended, found[i].mended);
      const std::string id = found.size() > 1 ? object.id + "/" + std::to_string(i + 1) : object.id;
      const std::string use = attribute(object, {"function", "class", "usage"});
      context_.areas.push_back({id, attribute(object, {"name"}), use.empty() ? object.type : object.type + "=" + use,
                                std::move(found[i].outer), std::move(found[i].holes), false, next_row()});
    }
    if (mended.empty()) context_.report.take(object.type, object.id, "area of ground");
    else context_.report.repair(object.type, object.id, "area of ground", mended);
  }

  const CityModel& model_;
  const ContextOptions& options_;
  Context& context_;
  double effort_ = 0;  // steps spent on triangles of large faces
  std::vector<std::vector<Point3>> vertices_;
  std::map<std::string, const CityObject*, std::less<>> by_id_;
};

}  // namespace

Result<Context> read_cityjson_context(std::string_view bytes, const ContextOptions& options) {
  auto model = read_cityjson(bytes);
  if (!model) return model.error();
  std::vector<std::array<double, 2>> points;
  for (const auto& list : model->vertices)
    for (const Point3& p : list) points.push_back({p.x, p.y});
  const auto middle = middle_of(std::move(points));
  if (!middle || model->objects.empty())
    return Error{ErrorCode::missing, "CityObjects", "The file holds no objects with vertices: there is nothing to import."};
  // A frame is flat: of a CRS with heights the part in plan counts.
  const std::string crs = horizontal_crs(context_crs(options, model->crs), options.proj_database);
  ContextOptions flat = options;
  flat.crs = crs;
  auto frame = context_frame(flat, crs, *middle);
  if (!frame) return frame.error();
  Context context;
  context.source_crs = crs;
  context.reference = frame->reference();
  context.notes = frame->notes();
  context.notes.insert(context.notes.end(), model->notes.begin(), model->notes.end());
  const double unit = context_height_unit(options, 0, model->crs, context.notes);
  CityImporter(*model, options, *frame, unit, context).run();
  if (options.watch != nullptr && options.watch->is_stopped) return stopped_error();
  assume_heights(options, context);
  return context;
}

}  // namespace bl::importing
