// Buildings and areas of OpenStreetMap: rings of relations put together from ways, and buildings replaced by their parts.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <span>

#include "core/base/plural.h"
#include "core/base/text.h"
#include "core/import/box_grid.h"
#include "core/import/osm_import.h"
#include "core/import/osm_tags.h"
#include "core/import/plan_cover.h"

namespace bl::importing {

namespace {

constexpr double kCovered = 0.9;          // [ratio] of a building: parts that cover less do not replace it
constexpr double kSameAreaHeight = 0.01;  // [m]

// An outline with its holes, and where its row stands.
struct Shape {
  geometry::Ring outer;
  std::vector<geometry::Ring> holes;
  ImportRow* row = nullptr;
  std::string id, mended;
  const OsmTags* tags = nullptr;
};

struct Candidate {
  ContextBuilding building;
  ImportRow* row = nullptr;
  bool is_dropped = false;
};

void note(std::string& text, const std::string& more) {
  if (!more.empty()) text += (text.empty() ? "" : ", ") + more;
}

void settle(ImportRow& row, const std::string& reason, const std::string& mended) {
  const bool is_repaired = !mended.empty() || row.outcome == ImportOutcome::repaired;
  std::string detail = row.detail;
  note(detail, mended);
  decide(row, is_repaired ? ImportOutcome::repaired : ImportOutcome::taken, reason, detail);
}

// Ways joined end to end. Each way is used once, in the order of the members.
struct Joined {
  std::vector<std::vector<std::int64_t>> rings;
  std::size_t open = 0;  // chains that do not close
};

Joined join(std::vector<const OsmWay*> ways) {
  Joined joined;
  struct End {
    std::vector<std::size_t> ways;
    std::size_t next = 0;  // those before it are used
  };
  std::map<std::int64_t, End> ends;
  std::vector<bool> is_used(ways.size(), false);
  for (std::size_t i = 0; i < ways.size(); ++i)
    if (ways[i]->nodes.size() >= 2) {
      ends[ways[i]->nodes.front()].ways.push_back(i);
      ends[ways[i]->nodes.back()].ways.push_back(i);
    }
  for (std::size_t i = 0; i < ways.size(); ++i) {
    if (is_used[i] || ways[i]->nodes.size() < 2) continue;
    is_used[i] = true;
    std::vector<std::int64_t> chain = ways[i]->nodes;
    while (chain.front() != chain.back()) {
      End& end = ends.at(chain.back());
      while (end.next < end.ways.size() && is_used[end.ways[end.next]]) ++end.next;
      if (end.next == end.ways.size()) break;
      is_used[end.ways[end.next]] = true;
      std::vector<std::int64_t> more = ways[end.ways[end.next]]->nodes;
      if (more.front() != chain.back()) std::reverse(more.begin(), more.end());
      chain.insert(chain.end(), more.begin() + 1, more.end());
    }
    if (chain.front() == chain.back() && chain.size() > 3) joined.rings.push_back(std::move(chain));
    else ++joined.open;
  }
  return joined;
}

double ground_area(const ContextBuilding& building) {
  double area = geometry::signed_area(building.outer);
  for (const geometry::Ring& hole : building.holes) area += geometry::signed_area(hole);
  return area;
}

class Areas {
 public:
  explicit Areas(OsmImport& import) : in_(import) {}

  void run() {
    const std::size_t relations = in_.store->relations.size(), ways = in_.store->ways.size();
    for (std::size_t i = 0; i < relations && in_.goes_on("outlines of relations", i, relations); ++i)
      read_relation(in_.store->relations[i], in_.relations[i]);
    for (std::size_t i = 0; i < ways && in_.goes_on("outlines of ways", i, ways); ++i) read_way(in_.store->ways[i]);
    replace_by_parts();
    for (Candidate& candidate : wholes_)
      if (!candidate.is_dropped) in_.context->buildings.push_back(std::move(candidate.building));
    for (Candidate& candidate : parts_)
      if (!candidate.is_dropped) in_.context->buildings.push_back(std::move(candidate.building));
  }

 private:
  static bool is_area(const OsmTags& tags) { return is_osm_building(tags) || is_osm_part(tags) || !osm_ground(tags).empty(); }

  static std::string word_for(const OsmTags& tags) {
    return is_osm_building(tags) ? "building" : is_osm_part(tags) ? "building part" : "area of ground";
  }

  // The ring of a chain of nodes, or an empty one with the reason in `fault`.
  geometry::Ring ring_of(const std::vector<std::int64_t>& nodes, bool counter_clockwise, std::string& mended,
                         std::string& fault) const {
    std::size_t missing = 0;
    const std::vector<Point3> places = in_.places(nodes, missing);
    if (missing > 0) {
      fault = "corners are not in the file";
      note(mended, std::to_string(missing) + " of " + how_many(nodes.size(), "node") + " missing");
      return {};
    }
    if (const std::string far = out_of_reach(*in_.options, places); !far.empty()) {
      fault = far;
      return {};
    }
    SoundRing sound = sound_ring(places, counter_clockwise);
    fault = sound.fault;
    note(mended, sound.mended);
    return std::move(sound.ring);
  }

  // The tags of a multipolygon: its own, or, as was the custom once, those of its outer ways.
  const OsmTags* tags_of(const OsmRelation& relation, const std::vector<const OsmWay*>& outer) const {
    if (is_area(relation.tags)) return &relation.tags;
    if (relation.tags.size() > 1) return nullptr;
    for (const OsmWay* way : outer)
      if (is_area(way->tags)) return &way->tags;
    return nullptr;
  }

  void read_relation(const OsmRelation& relation, ImportRow& row) {
    const std::string& type = tag_of(relation.tags, "type");
    if (type == "restriction") return;  // the streets' concern
    if (type != "multipolygon")
      return decide(row, ImportOutcome::skipped,
                    type == "building" ? "groups a building and its parts, which are read by themselves"
                                       : "relations of this type are not read",
                    "type=" + type);
    std::vector<const OsmWay*> outer, inner;
    std::size_t missing = 0, repeated = 0;
    std::set<std::int64_t> known;
    for (const OsmMember& member : relation.members) {
      if (member.kind != 'w') continue;
      const OsmWay* way = in_.store->way(member.id);
      if (!known.insert(member.id).second) ++repeated;
      else if (way == nullptr) ++missing;
      else (member.role == "inner" ? inner : outer).push_back(way);
    }
    const OsmTags* tags = tags_of(relation, outer);
    if (tags == nullptr) return decide(row, ImportOutcome::skipped, "no building, street or area of ground");
    const std::string word = word_for(*tags);
    const bool is_body = is_osm_building(*tags) || is_osm_part(*tags);
    std::string mended, fault;
    if (missing > 0) note(mended, how_many(missing, "member way") + by_number(missing, " is", " are") + " not in the file");
    if (repeated > 0)
      note(mended, how_many(repeated, "member way") + by_number(repeated, " that is", " that are") + " listed again left out");
    const Joined outlines = join(outer), courts = join(inner);
    if (outlines.open > 0) note(mended, how_many(outlines.open, "open outer ring") + " left out");
    if (courts.open > 0) note(mended, how_many(courts.open, "open inner ring") + " left out");
    std::vector<Shape> shapes = shapes_of(outlines, is_body, fault, mended);
    if (shapes.empty()) {
      if (fault.empty()) fault = "its outer ring is open";
      return decide(row, ImportOutcome::skipped, word + ": " + fault, mended);
    }
    deal_courts(courts, shapes, is_body, mended);
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      shapes[i].id = "r" + std::to_string(relation.id) + (shapes.size() > 1 ? "/" + std::to_string(i + 1) : "");
      shapes[i].row = &row;
      shapes[i].tags = tags;
      take(shapes[i]);
    }
    settle(row, word, mended);
    for (const OsmWay* way : outer)
      if (tags == &way->tags || way->tags.empty() || word_for(way->tags) == word) {
        ImportRow& used = in_.row_of(*way);
        if (!used.reason.empty() || !tag_of(way->tags, "highway").empty()) continue;
        decide(used, ImportOutcome::taken, "outline of a multipolygon", "relation " + std::to_string(relation.id));
        in_.followers.emplace_back(in_.index_of(used), in_.index_of(row));
      }
  }

  std::vector<Shape> shapes_of(const Joined& outlines, bool is_body, std::string& fault, std::string& mended) const {
    std::vector<Shape> shapes;
    for (const auto& nodes : outlines.rings) {
      std::string trouble, why;
      geometry::Ring ring = ring_of(nodes, true, trouble, why);
      if (std::vector<geometry::Ring> none; is_body && why.empty()) why = limit_corners(ring, none, trouble);
      note(mended, trouble);
      if (why.empty()) {
        shapes.emplace_back().outer = std::move(ring);
        continue;
      }
      if (fault.empty()) fault = why;
      if (outlines.rings.size() > 1) note(mended, "an outer ring left out: " + why);
    }
    return shapes;
  }

  // Each inner ring belongs to the outline that it lies in.
  void deal_courts(const Joined& courts, std::vector<Shape>& shapes, bool is_body, std::string& mended) const {
    const BoxGrid grid = BoxGrid::of(shapes, [](const Shape& shape) -> const geometry::Ring& { return shape.outer; });
    for (const auto& nodes : courts.rings) {
      std::string trouble, why;
      geometry::Ring hole = ring_of(nodes, false, trouble, why);
      note(mended, trouble);
      if (!why.empty()) {
        note(mended, "an inner ring left out: " + why);
        continue;
      }
      const Point3 inside = place_inside(hole);
      const std::vector<std::size_t> near = grid.meeting(plan_box(std::span(&inside, 1)));
      const auto home =
          std::find_if(near.begin(), near.end(), [&](std::size_t s) { return geometry::ring_contains(shapes[s].outer, inside); });
      if (home == near.end()) note(mended, "an inner ring outside of all outer ones left out");
      else shapes[*home].holes.push_back(std::move(hole));
    }
    for (Shape& shape : shapes) {
      if (is_body) limit_corners(shape.outer, shape.holes, mended);
      sort_holes(shape.outer, shape.holes, mended);
    }
  }

  void read_way(const OsmWay& way) {
    ImportRow& row = in_.row_of(way);
    if (!row.reason.empty()) return;
    const bool is_built = is_osm_building(way.tags) || is_osm_part(way.tags);
    if (!is_built && (!tag_of(way.tags, "highway").empty() || osm_ground(way.tags).empty())) return;
    const std::string word = word_for(way.tags);
    if (!way.is_closed()) {
      if (!is_built && tag_of(way.tags, "area") != "yes")
        return decide(row, ImportOutcome::skipped, "area of ground: its line is open", osm_ground(way.tags));
      return decide(row, ImportOutcome::skipped, word + ": its line is open", std::to_string(way.nodes.size()) + " nodes");
    }
    Shape shape;
    std::string fault;
    shape.outer = ring_of(way.nodes, true, shape.mended, fault);
    if (is_built && fault.empty()) fault = limit_corners(shape.outer, shape.holes, shape.mended);
    if (!fault.empty()) return decide(row, ImportOutcome::skipped, word + ": " + fault, shape.mended);
    shape.id = "w" + std::to_string(way.id);
    shape.row = &row;
    shape.tags = &way.tags;
    take(shape);
    settle(row, word, shape.mended);
  }

  void take(const Shape& shape) {
    const OsmTags& tags = *shape.tags;
    if (!is_osm_building(tags) && !is_osm_part(tags)) {
      in_.context->areas.push_back(
          {shape.id, tag_of(tags, "name"), osm_ground(tags), shape.outer, shape.holes, false, in_.index_of(*shape.row)});
      return;
    }
    Candidate candidate;
    ContextBuilding& building = candidate.building;
    const OsmHeight height = osm_height(tags, in_.options->storey_height);
    building.id = shape.id;
    building.name = tag_of(tags, "name");
    building.is_part = is_osm_part(tags) && !is_osm_building(tags);
    building.use = tag_of(tags, building.is_part ? "building:part" : "building");
    if (building.use == "yes") building.use = tag_of(tags, "building:use");
    building.outer = shape.outer;
    building.holes = shape.holes;
    building.base = height.base;
    building.height = height.height;
    building.height_source = height.is_from_levels ? HeightSource::levels : HeightSource::tag;
    if (!height.fault.empty()) {
      note(shape.row->detail, "not understood: " + height.fault);
      shape.row->outcome = ImportOutcome::repaired;
    }
    building.row = in_.index_of(*shape.row);
    candidate.row = shape.row;
    (building.is_part ? parts_ : wholes_).push_back(std::move(candidate));
  }

  // Parts that cover their building take its place; parts of others rise from it.
  void replace_by_parts() {
    std::map<std::size_t, std::vector<std::size_t>> parts_of;
    const BoxGrid grid =
        BoxGrid::of(wholes_, [](const Candidate& whole) -> const geometry::Ring& { return whole.building.outer; });
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      const Point3 inside = place_inside(parts_[p].building.outer);
      std::optional<std::size_t> home;
      for (const std::size_t w : grid.meeting(plan_box(std::span(&inside, 1))))
        if (geometry::ring_contains(wholes_[w].building.outer, inside) &&
            (!home || ground_area(wholes_[w].building) < ground_area(wholes_[*home].building)))
          home = w;
      if (home) parts_of[*home].push_back(p);
      else parts_[p].building.is_part = false;  // nobody's part: a building like any other
    }
    for (const auto& [w, list] : parts_of) {
      Candidate& whole = wholes_[w];
      double on_ground = 0;
      std::vector<PlanShape> grounded;
      for (const std::size_t p : list) {
        parts_[p].building.whole = whole.building.id;
        if (parts_[p].building.base < kSameAreaHeight) {
          on_ground += ground_area(parts_[p].building);
          grounded.push_back({&parts_[p].building.outer});
          for (const geometry::Ring& hole : parts_[p].building.holes) grounded.back().push_back(&hole);
        }
        if (parts_[p].building.use.empty()) parts_[p].building.use = whole.building.use;
        if (parts_[p].building.name.empty()) parts_[p].building.name = whole.building.name;
      }
      const double wanted = kCovered * ground_area(whole.building);
      // The lines along which the covered ground is measured are exact to a part in some hundred.
      if (on_ground >= wanted && covered_area(grounded) >= 0.99 * wanted) {
        whole.is_dropped = true;
        whole.row->reason = "building, drawn by its parts";
        note(whole.row->detail, how_many(list.size(), "part"));
        for (const std::size_t p : list)
          if (parts_[p].building.height == 0 && whole.building.height > 0) {
            parts_[p].building.height =
                std::max(kSameAreaHeight, whole.building.base + whole.building.height - parts_[p].building.base);
            parts_[p].building.height_source = whole.building.height_source;
          }
      } else {
        for (const std::size_t p : list) raise(parts_[p], whole);
      }
    }
  }

  void raise(Candidate& part, const Candidate& whole) {
    const double roof = whole.building.base + whole.building.height, top = part.building.base + part.building.height;
    if (whole.building.height > 0 && part.building.height > 0 && top > roof + kSameAreaHeight) {
      if (part.building.base >= roof - kSameAreaHeight) return;
      part.building.base = roof;
      part.building.height = top - roof;
      note(part.row->detail, "begins at the roof of its building, whose parts do not cover it");
      part.row->outcome = ImportOutcome::repaired;
      return;
    }
    part.is_dropped = true;
    decide(*part.row, ImportOutcome::skipped, "building part: within its building, whose parts do not cover it",
           part.building.whole);
  }

  OsmImport& in_;
  std::vector<Candidate> wholes_, parts_;
};

}  // namespace

void read_osm_areas(OsmImport& import) { Areas(import).run(); }

}  // namespace bl::importing
