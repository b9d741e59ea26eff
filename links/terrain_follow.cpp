// Keeps nodes at a height above the ground, and volumes that stand on it.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include "core/base/text.h"
#include "core/define/link_builder.h"
#include "core/define/registry.h"
#include "core/geometry/height_grid.h"
#include "core/geometry/plates_table.h"

namespace bl {

namespace {

struct TerrainFollow {
  struct In {
    double offset = 0, stiffness = 0.5;
    bool needs_ground = true;
  };
  struct Ends {
    Shared<Table> rows;
    double west = 0, north = 0, cell = 1, lowest = 0, step = 1;
    Point3 position;
    std::optional<double> footing;
    std::optional<Shared<Table>> plates;
  };
  struct Out {
    std::optional<Vector3> move;
    std::optional<double> footing;
  };

  static void declare(LinkBuilder<TerrainFollow>& l) {
    l.id("terrain_follow")
        .label("Terrain follow")
        .doc(
            "Moves nodes vertically to a height above the ground, a share in every tick. Their position in plan does not "
            "change. A volume that stands gets its lowest floor at once at the lowest ground around its footprint, so that it "
            "reaches into a slope.");
    l.family(LinkFamily::ground);
    l.param(&In::offset, "offset").unit(Unit::metre).soft(-5, 50).doc("Wanted height of the position above the ground.");
    l.param(&In::stiffness, "stiffness")
        .unit(Unit::ratio)
        .range(0, 1)
        .doc("The share of the deviation that is corrected in one tick.");
    l.param(&In::needs_ground, "needs_ground")
        .doc("When on, a node beside the ground is an error; when off, such a node is left alone.");
    l.reads(&Ends::rows, End::from, "terrain.rows");
    l.reads(&Ends::west, End::from, "terrain.west", Unit::metre).reads(&Ends::north, End::from, "terrain.north", Unit::metre);
    l.reads(&Ends::cell, End::from, "terrain.cell", Unit::metre).reads(&Ends::lowest, End::from, "terrain.lowest", Unit::metre);
    l.reads(&Ends::step, End::from, "terrain.step", Unit::metre);
    l.reads(&Ends::position, End::to, "node.position", Unit::metre);
    l.reads_if_there(&Ends::footing, End::to, "footprint.ground", Unit::metre);
    l.reads_if_there(&Ends::plates, End::to, "footprint.plates");
    l.proposes(&Out::move, End::to, "node.position", Unit::metre);
    l.proposes_if_there(&Out::footing, End::to, "footprint.ground", Unit::metre);
  }

  static constexpr double kChords = 0.1;  // [m] between arcs of plates and their chords

  // The grid is kept for the other nodes of the link in the same tick. Each terrain has a table of its own.
  struct Cache {
    std::optional<Shared<Table>> table;
    std::vector<std::string_view> rows;  // of that table
  };

  static void find_rows(const Ends& ends, Cache& kept) {
    if (kept.table && &**kept.table == &*ends.rows) return;
    kept.table = ends.rows;
    kept.rows.clear();
    const std::size_t column = ends.rows->column("heights");
    for (const auto& row : ends.rows->rows)
      if (const std::string* text = column < row.size() ? std::get_if<std::string>(&row[column]) : nullptr)
        kept.rows.push_back(*text);
  }

  // The lowest ground around the lowest plate; nothing where there is no plate yet.
  static std::optional<double> below(const Table& plates, const geometry::HeightGrid& grid) {
    const geometry::StandingBody body = geometry::read_body(plates);
    if (body.stacks.empty()) return std::nullopt;
    std::optional<double> lowest;
    for (const geometry::PlateRing& outline : body.stacks.front().outlines)
      if (const auto height = grid.lowest_along(geometry::chords_of(outline, body.centre, kChords)))
        lowest = std::min(lowest.value_or(*height), *height);
    return lowest;
  }

  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick& tick) {
    Cache own;
    Cache& kept = tick.memo != nullptr ? tick.memo->of<Cache>() : own;
    geometry::HeightGrid grid{ends.west, ends.north, ends.cell, ends.lowest, ends.step, {}};
    find_rows(ends, kept);
    grid.rows.swap(kept.rows);  // swapped in for the query
    auto ground = grid.sample(ends.position.x, ends.position.y);
    if (ground && ends.plates) ground = below(**ends.plates, grid).value_or(*ground);
    grid.rows.swap(kept.rows);
    if (!ground && in.needs_ground)
      return Error{ErrorCode::not_found, "to",
                   "there is no ground at (" + fixed(ends.position.x, 1) + ", " + fixed(ends.position.y, 1) +
                       "): move the node onto the terrain, or turn `needs_ground` off"};
    if (!ground) return Out{};
    if (ends.footing) return Out{std::nullopt, *ground + in.offset};
    const double error = *ground + in.offset - ends.position.z;
    if (std::abs(error) < 1e-6) return Out{};
    return Out{Vector3{0, 0, in.stiffness * error}, std::nullopt};
  }
};

}  // namespace

}  // namespace bl

BL_LINK(terrain_follow, TerrainFollow)
