// Translucent surfaces, bodies and lines of the 3D view: sent when they are others than before, drawn over what is solid.
#include <algorithm>
#include <cstddef>

#include "ui/desktop/view/gl_renderer.h"

namespace bl::desktop {

namespace {

// What the depth of clip space changes by where something comes nearer by the whole distance between eye and target.
float depth_per_distance(const ViewScene& scene) {
  const double near = scene.near_plane(), far = scene.far_plane();
  return static_cast<float>(2 * (scene.camera.is_parallel ? scene.camera.distance : far * near) / (far - near));
}

struct Item {
  float from[3], to[3];
  std::uint32_t colour;
  float width, hidden_share;
  float came[3], goes[3];
};

}  // namespace

void GlRenderer::send(Batch& batch, const std::vector<ViewSurface>& surfaces, const Point3& origin) {
  const bool is_same =
      origin == batch.origin && std::equal(surfaces.begin(), surfaces.end(), batch.sent.begin(), batch.sent.end(),
                                           [](const ViewSurface& a, const ViewSurface& b) { return a.mesh == b.mesh; });
  if (is_same) return;
  std::vector<float> places;
  for (const ViewSurface& surface : surfaces)
    for (const auto& t : surface.mesh->triangles)
      for (const std::uint32_t v : t) {
        const Vector3 p = surface.mesh->vertices[v] - origin;
        for (const double x : {p.x, p.y, p.z}) places.push_back(static_cast<float>(x));
      }
  batch.buffer.reserve(places.size() * sizeof(float));
  batch.buffer.write(0, places.data(), places.size() * sizeof(float), traffic_);
  glBindVertexArray(batch.array);
  glBindBuffer(GL_ARRAY_BUFFER, batch.buffer.id());
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
  batch.sent = surfaces;
  batch.origin = origin;
}

const GlProgram& GlRenderer::begin_surfaces(const ViewScene& scene, bool is_body) const {
  const GlProgram& program = programs_->surfaces;
  program.use();
  program.set_matrix("matrix", matrix_.data());
  program.set("section", section_of(scene));
  program.set("nearer", is_body ? 0.0f : 2e-4f);
  program.set("relief", is_body ? 1.0f : 0.0f);
  return program;
}

void GlRenderer::draw_batch(const GlProgram& program, const Batch& batch) {
  glBindVertexArray(batch.array);
  GLint first = 0;
  for (const ViewSurface& surface : batch.sent) {
    const auto count = static_cast<GLsizei>(3 * surface.mesh->triangles.size());
    program.set_colour("paint", surface.colour);
    glDrawArrays(GL_TRIANGLES, first, count);
    first += count;
  }
  glBindVertexArray(0);
}

void GlRenderer::draw_surfaces(const ViewScene& scene) {
  if (scene.surfaces.empty()) return;
  send(surfaces_, scene.surfaces, scene.origin);
  draw_batch(begin_surfaces(scene, false), surfaces_);
}

// Depth first, colour then: where bodies stand behind each other, or in each other, only the nearest side is seen, once. Lines
// are drawn already, and are seen through the shade; those that lie before it are drawn again, there only.
void GlRenderer::draw_bodies(const ViewScene& scene) {
  if (scene.bodies.empty()) return;
  send(bodies_, scene.bodies, scene.origin);
  const GlProgram& program = begin_surfaces(scene, true);
  glEnable(GL_STENCIL_TEST);
  glStencilFunc(GL_ALWAYS, 1, 0xff);
  glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
  for (const bool is_depth : {true, false}) {
    // Sides that fall together, as those of neighbours do, are still painted once.
    if (!is_depth) glStencilFunc(GL_EQUAL, 1, 0xff), glStencilOp(GL_KEEP, GL_KEEP, GL_INCR);
    glDepthMask(is_depth ? GL_TRUE : GL_FALSE);
    glDepthFunc(is_depth ? GL_LESS : GL_EQUAL);
    const GLboolean paints = is_depth ? GL_FALSE : GL_TRUE;
    glColorMaski(0, paints, paints, paints, paints);
    draw_batch(program, bodies_);
  }
  glStencilFunc(GL_EQUAL, 2, 0xff);
  glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
  if (!scene.lines.empty()) draw_line_quads(scene, false);
  glDisable(GL_STENCIL_TEST);
  glDepthFunc(GL_LESS);
}

void GlRenderer::send_lines(const ViewScene& scene) {
  if (scene.lines == sent_lines_ && scene.origin == line_origin_) return;
  std::vector<Item> items;
  items.reserve(scene.lines.size());
  for (const ViewLine& line : scene.lines) {
    const Vector3 a = line.from - scene.origin, b = line.to - scene.origin;
    items.push_back({{static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)},
                     {static_cast<float>(b.x), static_cast<float>(b.y), static_cast<float>(b.z)},
                     line.colour,
                     line.width,
                     line.hidden_share,
                     {static_cast<float>(line.came.x), static_cast<float>(line.came.y), static_cast<float>(line.came.z)},
                     {static_cast<float>(line.goes.x), static_cast<float>(line.goes.y), static_cast<float>(line.goes.z)}});
  }
  line_buffer_.reserve(items.size() * sizeof(Item));
  line_buffer_.write(0, items.data(), items.size() * sizeof(Item), traffic_);
  glBindVertexArray(line_array_);
  glBindBuffer(GL_ARRAY_BUFFER, line_buffer_.id());
  const auto attribute = [](GLuint index, GLint size, GLenum kind, GLboolean is_share, std::size_t offset) {
    glEnableVertexAttribArray(index);
    glVertexAttribPointer(index, size, kind, is_share, sizeof(Item), reinterpret_cast<const void*>(offset));
    glVertexAttribDivisor(index, 1);
  };
  attribute(0, 3, GL_FLOAT, GL_FALSE, offsetof(Item, from));
  attribute(1, 3, GL_FLOAT, GL_FALSE, offsetof(Item, to));
  attribute(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(Item, colour));
  attribute(3, 2, GL_FLOAT, GL_FALSE, offsetof(Item, width));
  attribute(4, 3, GL_FLOAT, GL_FALSE, offsetof(Item, came));
  attribute(5, 3, GL_FLOAT, GL_FALSE, offsetof(Item, goes));
  sent_lines_ = scene.lines;
  line_origin_ = scene.origin;
}

void GlRenderer::draw_lines(const ViewScene& scene) {
  if (scene.lines.empty()) return;
  send_lines(scene);
  draw_line_quads(scene, false);
  if (std::any_of(scene.lines.begin(), scene.lines.end(), [](const ViewLine& l) { return l.hidden_share > 0; }))
    draw_line_quads(scene, true);
  glDepthFunc(GL_LESS);
}

void GlRenderer::draw_line_quads(const ViewScene& scene, bool is_behind) const {
  const GlProgram& program = programs_->lines;
  program.use();
  program.set_matrix("matrix", matrix_.data());
  program.set("size", static_cast<float>(picture_.width()), static_cast<float>(picture_.height()));
  program.set("pixel", pixel_);
  program.set("bias", is_behind ? 0.0f : depth_per_distance(scene));
  glDepthFunc(is_behind ? GL_GREATER : GL_LEQUAL);
  glBindVertexArray(line_array_);
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(scene.lines.size()));
  glBindVertexArray(0);
}

}  // namespace bl::desktop
