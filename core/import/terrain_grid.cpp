// ASCII grids, and grids in local metres.
#include "core/import/terrain_grid.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>

#include "core/base/foreign_bytes.h"
#include "core/base/plural.h"
#include "core/base/stop_check.h"
#include "core/base/text.h"
#include "core/csv/csv_reader.h"
#include "core/import/context_shape.h"
#include "core/import/inflate.h"

namespace bl::importing {

namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

// Words of a text with the line that each stands in.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}
  std::string_view next() {
    while (at_ < text_.size() && is_space(text_[at_])) line_ += text_[at_++] == '\n' ? 1 : 0;
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
    return text_.substr(begin, at_ - begin);
  }
  std::string place() const { return "line " + std::to_string(line_); }

 private:
  static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
  std::string_view text_;
  std::size_t at_ = 0, line_ = 1;
};

std::optional<double> number_of(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  double value = 0;
  const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (fault == std::errc() && end == word.data() + word.size()) return value;
  if (word.find(',') == std::string_view::npos) return std::nullopt;
  std::string with_point(word);
  std::replace(with_point.begin(), with_point.end(), ',', '.');
  return parse_number(with_point);
}

Error no_grid(const std::string& place, const std::string& what) {
  return {ErrorCode::parse, place,
          what + " An ASCII grid begins with ncols, nrows, xllcorner, yllcorner, cellsize and NODATA_value."};
}

using GridHeader = std::map<std::string, double>;

Result<GridHeader> read_header(Words& words) {
  GridHeader header;
  const std::vector<std::string> known{"ncols",     "nrows",    "xllcorner", "yllcorner", "xllcenter",
                                       "yllcenter", "cellsize", "dx",        "dy",        "nodata_value"};
  while (true) {
    const Words before = words;
    const std::string name = lower_case(words.next().substr(0, 40));
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      if (header.empty()) return no_grid(words.place(), "The file does not begin with a line of a header.");
      words = before;
      break;
    }
    const auto value = number_of(words.next());
    if (!value || !std::isfinite(*value)) return no_grid(words.place(), "`" + name + "` has no number.");
    header[name] = *value;
  }
  return header;
}

// The grid without its cells, and the value that stands for none.
Result<std::pair<TerrainGrid, double>> grid_of(GridHeader header) {
  const auto has = [&header](const char* name) { return header.contains(name); };
  for (const char* name : {"ncols", "nrows"})
    if (!has(name) || !(header[name] >= 1) || header[name] != std::floor(header[name]))
      return no_grid("header", std::string("`") + name + "` must be a whole number, at least 1.");
  TerrainGrid grid;
  if (header["ncols"] * header["nrows"] > static_cast<double>(kMostGridCells))
    return Error{ErrorCode::out_of_range, "header",
                 "The grid has more than " + std::to_string(kMostGridCells) + " cells: cut out the part that you need."};
  grid.columns = static_cast<std::size_t>(header["ncols"]);
  grid.rows = static_cast<std::size_t>(header["nrows"]);
  grid.cell_x = has("dx") ? header["dx"] : has("cellsize") ? header["cellsize"] : 0;
  grid.cell_y = has("dy") ? header["dy"] : has("cellsize") ? header["cellsize"] : 0;
  if (!(grid.cell_x > 0) || !(grid.cell_y > 0)) return no_grid("header", "`cellsize` must be more than 0.");
  if (!(has("xllcorner") || has("xllcenter")) || !(has("yllcorner") || has("yllcenter")))
    return no_grid("header", "The place of the lower left corner is missing.");
  grid.west = has("xllcenter") ? header["xllcenter"] : header["xllcorner"] + grid.cell_x / 2;
  const double south = has("yllcenter") ? header["yllcenter"] : header["yllcorner"] + grid.cell_y / 2;
  grid.north = south + grid.cell_y * static_cast<double>(grid.rows - 1);
  const double nodata = has("nodata_value") ? header["nodata_value"] : -9999;
  return std::pair{std::move(grid), nodata};
}

Result<TerrainGrid> read_ascii(std::string_view text) {
  Words words(text);
  auto header = read_header(words);
  if (!header) return header.error();
  auto empty = grid_of(std::move(*header));
  if (!empty) return empty.error();
  auto& [grid, nodata] = *empty;
  const std::size_t count = grid.columns * grid.rows;
  // A cell takes two characters at least; a header that promises more than the file can hold is not believed.
  if (count > text.size())
    return Error{ErrorCode::parse, "header",
                 "The header promises " + how_many(count, "cell") + ", more than the file can hold: the ASCII grid is cut off."};
  grid.values.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (i % 65536 == 0 && is_stop_wished()) return stopped_error();
    const std::string_view word = words.next();
    if (word.empty())
      return Error{ErrorCode::parse, "end of the file",
                   "The grid ends after " + std::to_string(i) + " of " + std::to_string(count) +
                       " cells: the file is cut off. Fetch or export it again."};
    const auto value = number_of(word);
    if (!value && std::any_of(word.begin(), word.end(), [](char c) { return c <= ' ' || c > '~'; }))
      return Error{ErrorCode::parse, words.place(),
                   "Something stands here that is no number and no text: the ASCII grid is damaged."};
    if (!value)
      return Error{ErrorCode::parse, words.place(),
                   "`" + std::string(word.substr(0, 40)) + "` is no number: the ASCII grid is damaged or cut off."};
    grid.values.push_back(*value == nodata || !std::isfinite(*value) ? kNothing : *value);
  }
  if (!words.next().empty())
    grid.notes.push_back("What follows after the last cell, from " + words.place() + " on, was left out.");
  summarise(grid);
  return std::move(grid);
}

constexpr double kSmallestCell = 0.01;  // [m]

double between(double u, double limit) { return std::clamp(u, 0.0, limit); }

bool is_shift(const LocalFrame& frame, const TerrainGrid& grid) {
  const double east = grid.west + grid.cell_x * static_cast<double>(grid.columns - 1);
  const double south = grid.north - grid.cell_y * static_cast<double>(grid.rows - 1);
  const Point3 a = frame.to_local(grid.west, grid.north), b = frame.to_local(east, south);
  return std::abs(b.x - a.x - (east - grid.west)) < 1e-6 && std::abs(b.y - a.y - (south - grid.north)) < 1e-6 &&
         grid.cell_x == grid.cell_y;
}

struct Box {
  double west = INFINITY, east = -INFINITY, south = INFINITY, north = -INFINITY;
};

// The box of the grid in local metres, from points along its rim, cut back to the radius.
Box box_of(const LocalFrame& frame, const TerrainGrid& grid, double radius) {
  Box box;
  const auto take = [&](double column, double row) {
    const Point3 p = frame.to_local(grid.west + column * grid.cell_x, grid.north - row * grid.cell_y);
    box.west = std::min(box.west, p.x), box.east = std::max(box.east, p.x);
    box.south = std::min(box.south, p.y), box.north = std::max(box.north, p.y);
  };
  for (int i = 0; i <= 16; ++i) {
    const double column = static_cast<double>(grid.columns - 1) * i / 16, row = static_cast<double>(grid.rows - 1) * i / 16;
    take(column, 0), take(column, static_cast<double>(grid.rows - 1));
    take(0, row), take(static_cast<double>(grid.columns - 1), row);
  }
  if (radius > 0) {
    box.west = std::max(box.west, -radius), box.east = std::min(box.east, radius);
    box.south = std::max(box.south, -radius), box.north = std::min(box.north, radius);
  }
  return box;
}

}  // namespace

void summarise(TerrainGrid& grid) {
  grid.lowest = INFINITY;
  grid.highest = -INFINITY;
  for (const double value : grid.values) {
    if (!std::isfinite(value)) {
      ++grid.without_value;
      continue;
    }
    grid.lowest = std::min(grid.lowest, value);
    grid.highest = std::max(grid.highest, value);
  }
  if (!std::isfinite(grid.lowest)) grid.lowest = grid.highest = 0;
}

std::optional<double> TerrainGrid::sample(double x, double y) const {
  const double u = (x - west) / cell_x, v = (north - y) / cell_y;
  constexpr double kRim = 1e-6;  // [ratio] of a cell: rounding of projections at the outermost centres
  if (columns == 0 || !(u >= -kRim) || !(v >= -kRim) || !(u <= static_cast<double>(columns - 1) + kRim) ||
      !(v <= static_cast<double>(rows - 1) + kRim))
    return std::nullopt;
  const double inside_u = between(u, static_cast<double>(columns - 1)), inside_v = between(v, static_cast<double>(rows - 1));
  const double column = std::floor(inside_u), row = std::floor(inside_v);
  double sum = 0, weight = 0;
  for (const std::size_t i : {0u, 1u})
    for (const std::size_t k : {0u, 1u}) {
      const double w = (i == 0 ? 1 - (inside_v - row) : inside_v - row) * (k == 0 ? 1 - (inside_u - column) : inside_u - column);
      if (w <= 0) continue;
      const double value = values[(static_cast<std::size_t>(row) + i) * columns + static_cast<std::size_t>(column) + k];
      if (!std::isfinite(value)) continue;
      sum += w * value;
      weight += w;
    }
  if (weight < 0.5) return std::nullopt;
  return sum / weight;
}

Result<TerrainGrid> read_terrain_grid(std::string_view bytes) {
  auto text = unpacked(bytes);
  if (!text) return text.error();
  if (text->empty()) return Error{ErrorCode::missing, "byte 0", "The file is empty: an ASCII grid or a GeoTIFF is needed."};
  for (const std::string_view mark : {std::string_view("II*\0", 4), std::string_view("MM\0*", 4)})
    if (mark.starts_with(*text))
      return Error{ErrorCode::parse, "byte " + std::to_string(text->size()),
                   "The GeoTIFF ends in its first bytes: the file is cut off. Fetch it again."};
  const bool is_tiff = text->starts_with("II*") || text->starts_with(std::string_view("MM\0*", 4)) || text->starts_with("II+") ||
                       text->starts_with(std::string_view("MM\0+", 4));
  if (is_tiff) return read_geotiff(*text);
  if (auto foreign = foreign_bytes(*text, "GeoTIFF and no ASCII grid", "export it as one of the two")) return *foreign;
  return read_ascii(*text);
}

Result<LocalTerrain> local_grid(const TerrainGrid& grid, const ContextOptions& options, std::size_t most_cells) {
  const std::array<double, 2> middle{grid.west + grid.cell_x * static_cast<double>(grid.columns - 1) / 2,
                                     grid.north - grid.cell_y * static_cast<double>(grid.rows - 1) / 2};
  ContextOptions flat = options;
  flat.crs = horizontal_crs(context_crs(options, grid.crs), options.proj_database);
  auto frame = context_frame(flat, flat.crs, middle);
  if (!frame) return frame.error();
  LocalTerrain local;
  local.reference = frame->reference();
  local.notes = frame->notes();
  const Box box = box_of(*frame, grid, options.radius);
  if (!(box.east >= box.west) || !(box.north >= box.south) || !std::isfinite(box.east - box.west) ||
      !std::isfinite(box.north - box.south))
    return Error{ErrorCode::out_of_range, "", "No cell of the grid lies within the radius of the origin, or its CRS is wrong."};
  if (std::max({std::abs(box.west), std::abs(box.east), std::abs(box.south), std::abs(box.north)}) > kContextExtent)
    return Error{ErrorCode::out_of_range, "",
                 "The grid reaches more than 100 km from the origin: cut out the part that you need, or give a radius."};
  const Point3 corner = frame->to_local(grid.west, grid.north);
  const bool keeps_cells = is_shift(*frame, grid);
  const Point3 near = frame->from_local(0, 0), beside = frame->from_local(1, 0), above = frame->from_local(0, 1);
  const double per_metre = std::max(distance(near, beside) / grid.cell_x, distance(near, above) / grid.cell_y);
  local.cell = keeps_cells ? grid.cell_x : std::max(kSmallestCell, std::round(100 / per_metre) / 100);
  if (!(local.cell >= kSmallestCell))
    return Error{ErrorCode::out_of_range, "header",
                 "The cells are " + shortest(local.cell) + " m wide, less than a centimetre: check their size and the CRS."};
  double step = 1;
  const auto cells = [&](double length) { return std::floor(length / local.cell + 1e-9) + 1; };
  while (cells(box.east - box.west) * cells(box.north - box.south) > static_cast<double>(most_cells)) local.cell *= 2, step *= 2;
  // On the cells of the file where they are kept.
  local.west = keeps_cells ? corner.x + std::ceil((box.west - corner.x) / grid.cell_x - 1e-9) * grid.cell_x : box.west;
  local.north = keeps_cells ? corner.y - std::ceil((corner.y - box.north) / grid.cell_x - 1e-9) * grid.cell_x : box.north;
  local.columns = static_cast<std::size_t>(std::max(1.0, cells(box.east - local.west)));
  local.rows = static_cast<std::size_t>(std::max(1.0, cells(local.north - box.south)));
  local.is_resampled = !keeps_cells || step > 1;
  std::size_t nothing = 0;
  local.values.reserve(local.columns * local.rows);
  for (std::size_t row = 0; row < local.rows; ++row) {
    if (!goes_on(options.watch, "rows of the grid", row, local.rows)) return stopped_error();
    for (std::size_t column = 0; column < local.columns; ++column) {
      const Point3 at = frame->from_local(local.west + local.cell * static_cast<double>(column),
                                          local.north - local.cell * static_cast<double>(row));
      const auto value = grid.sample(at.x, at.y);
      local.values.push_back(value.value_or(kNothing));
      nothing += value ? 0 : 1;
    }
  }
  local.report.take("cell", "", local.is_resampled ? "height sampled anew" : "height as in the file", "",
                    local.values.size() - nothing);
  if (nothing > 0) local.report.skip("cell", "", "no value, or outside the grid", "", nothing);
  const std::size_t given = grid.columns * grid.rows;
  if (!local.is_resampled && given > local.values.size())
    local.report.skip("cell", "", "it lies beyond the radius", "", given - local.values.size());
  if (local.is_resampled)
    local.notes.push_back("The grid was sampled anew: " + std::to_string(given) + " cells of the file became " +
                          std::to_string(local.values.size()) + " of " + shortest(local.cell) + " m.");
  return local;
}

Result<LocalTerrain> local_terrain(const TerrainGrid& grid, const ContextOptions& options, std::size_t most_cells) {
  std::vector<std::string> notes;
  const double unit = context_height_unit(options, grid.height_unit, grid.crs, notes);
  const auto is_absurd = [unit](double value) { return std::isfinite(value) && std::abs(value * unit) > kHighestTop; };
  const auto absurd = std::count_if(grid.values.begin(), grid.values.end(), is_absurd);
  if (absurd > 0)
    notes.push_back(how_many(static_cast<std::size_t>(absurd), "cell") +
                    by_number(static_cast<std::size_t>(absurd), " has a height", " have heights") + " beyond 100 km and " +
                    by_number(static_cast<std::size_t>(absurd), "counts", "count") +
                    " as without a value: does the file name its own?");
  if (absurd == 0 && unit == 1) return local_grid(grid, options, most_cells);
  TerrainGrid metres = grid;
  for (double& value : metres.values) value = is_absurd(value) ? kNothing : value * unit;
  auto local = local_grid(metres, options, most_cells);
  if (local) local->notes.insert(local->notes.end(), notes.begin(), notes.end());
  return local;
}

}  // namespace bl::importing
