// Slots with a little room to grow: a cell that gains a corner moves nobody else.
#include "ui/desktop/view/gl_volumes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "ui/desktop/view/cell_marks.h"

namespace bl::desktop {

namespace {

// Corners by their index in the slot: the face's centre and two of its corners.
struct Instance {
  std::uint16_t c = 0, a = 0, b = 0, volume = 0;
};
static_assert(sizeof(Instance) == 8);

constexpr std::size_t kCornerBytes = 16, kRecordBytes = 48, kFacadeBytes = 144;
constexpr std::uint32_t kStep = 8;

std::uint32_t centres_of(const MeshWrap& wrap) {
  std::size_t count = 0;
  for (const MeshWrap::Part& part : wrap.parts) count += 1 + part.seams.size();
  return static_cast<std::uint32_t>(count);
}

std::uint32_t corners_of(const Mesh& cell) { return static_cast<std::uint32_t>(cell.vertices.size()) + centres_of(*cell.wrap); }

std::uint32_t with_room(std::uint32_t count) { return (count + kStep / 2 + kStep - 1) / kStep * kStep; }

// Are the triangles the same, and do they move towards centres in the same places?
bool is_alike(const Mesh& a, const Mesh& b) {
  if (a.vertices.size() != b.vertices.size() || a.triangles != b.triangles || a.wrap->parts.size() != b.wrap->parts.size())
    return false;
  for (std::size_t p = 0; p < a.wrap->parts.size(); ++p)
    if (a.wrap->parts[p].triangles != b.wrap->parts[p].triangles ||
        a.wrap->parts[p].seams.size() != b.wrap->parts[p].seams.size())
      return false;
  return true;
}

bool has_no_rim(const Mesh& cell, std::uint32_t vertex) {
  return vertex < cell.wrap->seams.size() && (cell.wrap->seams[vertex] & kNoRim) != 0;
}

std::vector<float> corner_texels(const Mesh& cell) {
  std::vector<float> out;
  out.reserve(4 * corners_of(cell));
  const auto add = [&](const Point3& p, std::uint32_t mark) {
    const Vector3 at = p - cell.wrap->ball_centre;
    for (const double x : {at.x, at.y, at.z}) out.push_back(static_cast<float>(x));
    out.push_back(static_cast<float>(mark));
  };
  for (std::size_t v = 0; v < cell.vertices.size(); ++v)
    add(cell.vertices[v], v < cell.wrap->seams.size() ? cell.wrap->seams[v] : 0);
  std::size_t t = 0, centre = cell.vertices.size();
  for (const MeshWrap::Part& part : cell.wrap->parts) {
    for (std::uint32_t k = 0; k < part.triangles && t < cell.triangles.size(); ++k, ++t)
      // The centre's number, and a half where the triangle has no edge.
      out[4 * cell.triangles[t][0] + 3] = static_cast<float>(centre) + (has_no_rim(cell, cell.triangles[t][0]) ? 0.5f : 0.0f);
    centre += 1 + part.seams.size();
  }
  for (const MeshWrap::Part& part : cell.wrap->parts) {
    add(part.centre, 0);
    for (const Point3& seam : part.seams) add(seam, 0);
  }
  return out;
}

// `count` of them: those beyond the triangles have no extent.
std::vector<Instance> instances_of(const Mesh& cell, std::size_t volume, std::size_t count) {
  const auto number = static_cast<std::uint16_t>(volume);
  std::vector<Instance> out(count, Instance{0, 0, 0, number});
  for (std::size_t t = 0; t < std::min(count, cell.triangles.size()); ++t) {
    const auto& corners = cell.triangles[t];
    out[t] = {static_cast<std::uint16_t>(corners[0]), static_cast<std::uint16_t>(corners[1]),
              static_cast<std::uint16_t>(corners[2]), number};
  }
  return out;
}

// What the divided mesh of a closed cell would have taken: its vertices as three floats, its triangles where they are others.
std::uint64_t divided_bytes(const Mesh& cell, int depth, bool with_triangles) {
  const std::uint64_t triangles = cell.triangles.size() << (2 * static_cast<unsigned>(depth));
  return 12 * (triangles / 2 + 2) + (with_triangles ? 12 * triangles : 0);
}

}  // namespace

GlVolumes::GlVolumes() { make_grids(); }

GlVolumes::~GlVolumes() {
  glDeleteVertexArrays(1, &array_);
  glDeleteBuffers(1, &grid_vertices_);
  glDeleteBuffers(1, &grid_indices_);
}

// The weights of a divided triangle's points, and its triangles in the order of tessellate(): rows from the centre outwards.
void GlVolumes::make_grids() {
  std::vector<float> weights;
  std::vector<std::uint16_t> indices;
  for (std::size_t depth = 0; depth < grids_.size(); ++depth) {
    Grid& grid = grids_[depth];
    grid.base = static_cast<GLint>(weights.size() / 2);
    grid.offset = indices.size() * sizeof(std::uint16_t);
    const int parts = 1 << depth;
    const auto at = [](int row, int i) { return static_cast<std::uint16_t>(row * (row + 1) / 2 + i); };
    for (int row = 0; row <= parts; ++row)
      for (int i = 0; i <= row; ++i) {
        weights.push_back(static_cast<float>(row - i) / static_cast<float>(parts));
        weights.push_back(static_cast<float>(i) / static_cast<float>(parts));
      }
    for (int row = 1; row <= parts; ++row)
      for (int i = 0; i < row; ++i) {
        indices.insert(indices.end(), {at(row - 1, i), at(row, i), at(row, i + 1)});
        if (i + 1 < row) indices.insert(indices.end(), {at(row - 1, i), at(row, i + 1), at(row - 1, i + 1)});
      }
    grid.indices = static_cast<GLsizei>(indices.size() - grid.offset / sizeof(std::uint16_t));
  }
  glGenVertexArrays(1, &array_);
  glGenBuffers(1, &grid_vertices_);
  glGenBuffers(1, &grid_indices_);
  glBindVertexArray(array_);
  glBindBuffer(GL_ARRAY_BUFFER, grid_vertices_);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(weights.size() * sizeof(float)), weights.data(), GL_STATIC_DRAW);
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, 0, nullptr);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, grid_indices_);
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(std::uint16_t)), indices.data(),
               GL_STATIC_DRAW);
  glBindVertexArray(0);
}

void GlVolumes::lay_out(const ViewVolumes& volumes, std::size_t count) {
  slots_.assign(count, {});
  corner_room_ = triangle_room_ = 0;
  for (std::size_t k = 0; k < count; ++k) {
    Slot& slot = slots_[k];
    slot.first_corner = static_cast<std::uint32_t>(corner_room_);
    slot.first_triangle = static_cast<std::uint32_t>(triangle_room_);
    slot.corner_room = with_room(corners_of(*volumes[k].cell));
    slot.triangle_room = with_room(static_cast<std::uint32_t>(volumes[k].cell->triangles.size()));
    corner_room_ += slot.corner_room;
    triangle_room_ += slot.triangle_room;
  }
  corners_.reserve(corner_room_ * kCornerBytes);
  records_.reserve(count * kRecordBytes);
  facades_.reserve(count * kFacadeBytes);
  if (instances_.reserve(triangle_room_ * sizeof(Instance))) {
    glBindVertexArray(array_);
    glBindBuffer(GL_ARRAY_BUFFER, instances_.id());
    glEnableVertexAttribArray(1);
    glVertexAttribIPointer(1, 4, GL_UNSIGNED_SHORT, sizeof(Instance), nullptr);
    glVertexAttribDivisor(1, 1);
    glBindVertexArray(0);
  }
}

void GlVolumes::send_cell(std::size_t k, const ViewVolume& volume, bool is_laid_out, int depth, Traffic& traffic) {
  Slot& slot = slots_[k];
  if (slot.cell == volume.cell) return;
  const bool has_new_triangles = is_laid_out || !slot.cell || !is_alike(*slot.cell, *volume.cell);
  if (has_new_triangles) {
    // What a longer list has left behind is cleared with it.
    const std::size_t before = is_laid_out || !slot.cell ? slot.triangle_room : slot.cell->triangles.size();
    const auto instances = instances_of(*volume.cell, k, std::max(before, volume.cell->triangles.size()));
    instances_.write(slot.first_triangle * sizeof(Instance), instances.data(), instances.size() * sizeof(Instance), traffic);
  }
  const std::vector<float> texels = corner_texels(*volume.cell);
  corners_.write(slot.first_corner * kCornerBytes, texels.data(), texels.size() * sizeof(float), traffic);
  traffic.spared += divided_bytes(*volume.cell, depth, has_new_triangles);
  slot.cell = volume.cell;
}

void GlVolumes::send_record(std::size_t k, const ViewVolume& volume, const Point3& origin, Traffic& traffic) {
  Slot& slot = slots_[k];
  const MeshWrap& wrap = *volume.cell->wrap;
  const Vector3 ball = wrap.ball_centre - origin;
  const auto channel = [&](int shift) { return static_cast<float>((volume.colour >> shift) & 0xff) / 255.0f; };
  const std::array<float, 12> record{static_cast<float>(ball.x),
                                     static_cast<float>(ball.y),
                                     static_cast<float>(ball.z),
                                     static_cast<float>(wrap.radius),
                                     channel(0),
                                     channel(8),
                                     channel(16),
                                     static_cast<float>(volume.flags),
                                     static_cast<float>(volume.bottom - origin.z),
                                     volume.storey,
                                     static_cast<float>(slot.first_corner),
                                     0};
  if (slot.has_record && record == slot.record) return;
  records_.write(k * kRecordBytes, record.data(), kRecordBytes, traffic);
  slot.record = record;
  slot.has_record = true;
}

void GlVolumes::send_facade(std::size_t k, const ViewFacade& facade, Traffic& traffic) {
  Slot& slot = slots_[k];
  const float turn = facade.north * std::numbers::pi_v<float> / 180;
  std::array<float, 36> texels{std::cos(turn), std::sin(turn), 0, 0};
  for (std::size_t s = 0; s < facade.sides.size(); ++s) {
    const ViewFacade::Side& side = facade.sides[s];
    const std::array<float, 4> row{side.width, side.module, side.sill, side.head};
    std::copy(row.begin(), row.end(), texels.begin() + static_cast<std::ptrdiff_t>(4 + 4 * s));
  }
  if (slot.has_facade && texels == slot.facade) return;
  facades_.write(k * kFacadeBytes, texels.data(), kFacadeBytes, traffic);
  slot.facade = texels;
  slot.has_facade = true;
}

bool GlVolumes::has_room_for(const ViewVolume& volume, std::size_t k) const {
  return corners_of(*volume.cell) <= slots_[k].corner_room && volume.cell->triangles.size() <= slots_[k].triangle_room;
}

void GlVolumes::update(const ViewScene& scene, int depth, Traffic& traffic) {
  // More than the numbers of the instances reach would need another layout; no scene of volumes comes near it.
  const std::size_t count = std::min<std::size_t>(scene.volumes.size(), 0xffff);
  const ViewVolumes& volumes = scene.volumes;
  bool is_laid_out = slots_.size() != count;
  // What the last picture had too is on the graphics processor already.
  std::vector<std::size_t> news;
  for (std::size_t k = 0; k < count; ++k) {
    if (k % ViewVolumes::kLeaf == 0 && origin_ == scene.origin && volumes.shares_leaf(sent_, k / ViewVolumes::kLeaf)) {
      k += ViewVolumes::kLeaf - 1;
      continue;
    }
    news.push_back(k);
    is_laid_out = is_laid_out || !has_room_for(volumes[k], k);
  }
  if (is_laid_out) {
    lay_out(volumes, count);
    news.resize(count);
    std::iota(news.begin(), news.end(), std::size_t{0});
  }
  for (const std::size_t k : news) {
    send_cell(k, volumes[k], is_laid_out, depth, traffic);
    send_record(k, volumes[k], scene.origin, traffic);
    if ((volumes[k].flags & ViewVolume::dressed) != 0) send_facade(k, volumes[k].facade, traffic);
  }
  sent_ = volumes;
  origin_ = scene.origin;
}

void GlVolumes::draw(const GlProgram& program, int depth) const {
  if (triangle_room_ == 0) return;
  corners_.bind(0);
  records_.bind(1);
  facades_.bind(4);
  program.set("facades", 4);
  program.set("corners", 0);
  program.set("records", 1);
  const Grid& grid = grids_[static_cast<std::size_t>(std::clamp(depth, 0, kDeepest))];
  glBindVertexArray(array_);
  glDrawElementsInstancedBaseVertex(GL_TRIANGLES, grid.indices, GL_UNSIGNED_SHORT, reinterpret_cast<const void*>(grid.offset),
                                    static_cast<GLsizei>(triangle_room_), grid.base);
  glBindVertexArray(0);
}

}  // namespace bl::desktop
