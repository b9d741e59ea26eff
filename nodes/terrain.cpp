// The ground: heights on a regular grid, kept as rows of text, with the figures that links and people need.
#include <algorithm>
#include <cmath>

#include "core/define/registry.h"
#include "core/define/typification_builder.h"
#include "core/geometry/height_grid.h"

namespace bl {

namespace {

struct Terrain {
  struct In {
    Shared<Table> rows;
    double west = 0, north = 0, cell = 10, lowest = 0, step = 0.01;
    std::string origin;
  };

  struct Out {
    std::int64_t columns = 0, row_count = 0, without_height = 0;
    double width = 0, depth = 0, minimum = 0, maximum = 0, mean = 0;
    MeshPointer mesh;
  };

  static void declare(TypificationBuilder<Terrain>& t) {
    t.id("terrain").label("Terrain");
    t.doc("The ground as heights on a regular grid. The coordinates of the grid place it; the node's position has no effect.");
    t.in(&In::rows, "rows")
        .column({.id = "heights",
                 .is_text = true,
                 .is_required = true,
                 .default_value = std::string(),
                 .doc = "One row of the grid from west to east: three characters for each height, digits of base 64 from `A` to "
                        "`/` that "
                        "count steps above the lowest height, or `...` where there is none."})
        .doc("The grid, with the northernmost row first. All rows have the same length. A million cells take three megabytes.");
    t.in(&In::west, "west")
        .unit(Unit::metre)
        .range(-1e7, 1e7)
        .doc("East coordinate of the centre of the first cell of each row.");
    t.in(&In::north, "north")
        .unit(Unit::metre)
        .range(-1e7, 1e7)
        .doc("North coordinate of the centres of the cells of the first row.");
    t.in(&In::cell, "cell")
        .unit(Unit::metre)
        .range(0.01, 1e5)
        .soft(1, 100)
        .doc("Distance between the centres of neighbouring cells.");
    t.in(&In::lowest, "lowest").unit(Unit::metre).range(-1e5, 1e5).doc("The height that `AAA` stands for.");
    t.in(&In::step, "step").unit(Unit::metre).range(1e-4, 10).soft(0.001, 1).doc("Height of one step of the numbers.");
    t.in(&In::origin, "origin").doc("Origin of the data: file, source and licence.");
    t.out(&Out::columns, "columns").unit(Unit::count).doc("Cells from west to east.");
    t.out(&Out::row_count, "row_count").unit(Unit::count).doc("Cells from north to south.");
    t.out(&Out::without_height, "without_height").unit(Unit::count).doc("Cells that have no height.");
    t.out(&Out::width, "width").unit(Unit::metre).doc("Distance between the centres of the westernmost and easternmost cells.");
    t.out(&Out::depth, "depth").unit(Unit::metre).doc("Distance between the centres of the northernmost and southernmost cells.");
    t.out(&Out::minimum, "minimum").unit(Unit::metre).doc("Height of the lowest cell; 0 where there is none.");
    t.out(&Out::maximum, "maximum").unit(Unit::metre).doc("Height of the highest cell; 0 where there is none.");
    t.out(&Out::mean, "mean").unit(Unit::metre).doc("Mean height of all cells that have one.");
    t.out(&Out::mesh, "mesh").doc("The ground as an open mesh of at most some ten thousand cells, for display and export.");
  }

  static Result<geometry::HeightGrid> grid_of(const In& in) {
    geometry::HeightGrid grid{in.west, in.north, in.cell, in.lowest, in.step, {}};
    for (std::size_t row = 0; row < in.rows->rows.size(); ++row) {
      const std::string& text = in.rows->text(row, "heights");
      const std::string place = "rows/" + std::to_string(row) + "/heights";
      if (text.size() % 3 != 0 || text.size() != in.rows->text(0, "heights").size() || text.empty())
        return Error{ErrorCode::parse, place,
                     "a row needs three characters for each cell, and as many cells as the first row: import the grid again"};
      if (const std::size_t wrong = geometry::first_wrong_character(text); wrong < text.size())
        return Error{ErrorCode::parse, place,
                     "character " + std::to_string(wrong + 1) + " is no digit of base 64: import the grid again"};
      grid.rows.push_back(text);
    }
    return grid;
  }

  // Every k-th cell, so that the mesh stays small; quads without all four heights are left open.
  static Mesh mesh_of(const geometry::HeightGrid& grid) {
    constexpr std::size_t kMostAcross = 128;
    const std::size_t k = 1 + std::max(grid.columns(), grid.rows.size()) / (kMostAcross + 1);
    Mesh mesh;
    std::vector<std::int64_t> index;
    std::size_t across = 0;
    for (std::size_t row = 0; row < grid.rows.size(); row += k) {
      across = 0;
      for (std::size_t column = 0; column < grid.columns(); column += k, ++across) {
        const auto height = grid.at(row, column);
        index.push_back(height ? static_cast<std::int64_t>(mesh.vertices.size()) : -1);
        if (height)
          mesh.vertices.push_back(
              {grid.west + grid.cell * static_cast<double>(column), grid.north - grid.cell * static_cast<double>(row), *height});
      }
    }
    for (std::size_t i = 0; across > 1 && i + across < index.size(); ++i) {
      if (i % across + 1 == across) continue;
      const std::int64_t a = index[i], b = index[i + 1], c = index[i + across], d = index[i + across + 1];
      if (a < 0 || b < 0 || c < 0 || d < 0) continue;
      const auto at = [](std::int64_t number) { return static_cast<std::uint32_t>(number); };
      mesh.triangles.push_back({at(a), at(c), at(b)});
      mesh.triangles.push_back({at(b), at(c), at(d)});
    }
    return mesh;
  }

  static Result<Out> evaluate(const In& in, const Tick&) {
    const auto grid = grid_of(in);
    if (!grid) return grid.error();
    Out out;
    out.columns = static_cast<std::int64_t>(grid->columns());
    out.row_count = static_cast<std::int64_t>(grid->rows.size());
    std::int64_t count = 0;
    double sum = 0;
    for (std::size_t row = 0; row < grid->rows.size(); ++row)
      for (std::size_t column = 0; column < grid->columns(); ++column) {
        const auto height = grid->at(row, column);
        if (!height) continue;
        out.minimum = count == 0 ? *height : std::min(out.minimum, *height);
        out.maximum = count == 0 ? *height : std::max(out.maximum, *height);
        sum += *height;
        ++count;
      }
    out.without_height = out.columns * out.row_count - count;
    if (count > 0) out.mean = sum / static_cast<double>(count);
    out.width = in.cell * static_cast<double>(std::max<std::int64_t>(0, out.columns - 1));
    out.depth = in.cell * static_cast<double>(std::max<std::int64_t>(0, out.row_count - 1));
    out.mesh = std::make_shared<const Mesh>(mesh_of(*grid));
    return out;
  }
};

}  // namespace

}  // namespace bl

BL_TYPIFICATION(terrain, Terrain)
