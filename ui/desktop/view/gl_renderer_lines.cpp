// Translucent surfaces and lines of the 3D view: sent when they are others than before, drawn over what is solid.
#include <algorithm>
#include <cstddef>

#include "ui/desktop/view/gl_renderer.h"

namespace bl::desktop {

namespace {

// Lines lie a hair nearer than the surfaces that they are drawn on.
constexpr float kLineBias = 2e-4f;

struct Item {
  float from[3], to[3];
  std::uint32_t colour;
  float width, hidden_share;
};

}  // namespace

void GlRenderer::send_surfaces(const ViewScene& scene) {
  const bool is_same = scene.origin == surface_origin_ &&
                       std::equal(scene.surfaces.begin(), scene.surfaces.end(), sent_surfaces_.begin(), sent_surfaces_.end(),
                                  [](const ViewSurface& a, const ViewSurface& b) { return a.mesh == b.mesh; });
  if (is_same) return;
  std::vector<float> places;
  for (const ViewSurface& surface : scene.surfaces)
    for (const auto& t : surface.mesh->triangles)
      for (const std::uint32_t v : t) {
        const Vector3 p = surface.mesh->vertices[v] - scene.origin;
        for (const double x : {p.x, p.y, p.z}) places.push_back(static_cast<float>(x));
      }
  surface_buffer_.reserve(places.size() * sizeof(float));
  surface_buffer_.write(0, places.data(), places.size() * sizeof(float), traffic_);
  glBindVertexArray(surface_array_);
  glBindBuffer(GL_ARRAY_BUFFER, surface_buffer_.id());
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
  sent_surfaces_ = scene.surfaces;
  surface_origin_ = scene.origin;
}

void GlRenderer::draw_surfaces(const ViewScene& scene) {
  if (scene.surfaces.empty()) return;
  send_surfaces(scene);
  programs_->surfaces.use();
  programs_->surfaces.set_matrix("matrix", matrix_.data());
  programs_->surfaces.set("section", section_of(scene));
  glBindVertexArray(surface_array_);
  GLint first = 0;
  for (const ViewSurface& surface : scene.surfaces) {
    const auto count = static_cast<GLsizei>(3 * surface.mesh->triangles.size());
    programs_->surfaces.set_colour("paint", surface.colour);
    glDrawArrays(GL_TRIANGLES, first, count);
    first += count;
  }
  glBindVertexArray(0);
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
                       line.hidden_share});
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
  sent_lines_ = scene.lines;
  line_origin_ = scene.origin;
}

void GlRenderer::draw_lines(const ViewScene& scene) {
  if (scene.lines.empty()) return;
  send_lines(scene);
  const GlProgram& program = programs_->lines;
  program.use();
  program.set_matrix("matrix", matrix_.data());
  program.set("size", static_cast<float>(picture_.width()), static_cast<float>(picture_.height()));
  program.set("pixel", pixel_);
  glBindVertexArray(line_array_);
  const bool has_hidden = std::any_of(scene.lines.begin(), scene.lines.end(), [](const ViewLine& l) { return l.hidden_share > 0; });
  for (int pass = 0; pass < (has_hidden ? 2 : 1); ++pass) {
    program.set("bias", pass == 0 ? kLineBias : 0.0f);
    glDepthFunc(pass == 0 ? GL_LEQUAL : GL_GREATER);
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(scene.lines.size()));
  }
  glDepthFunc(GL_LESS);
  glBindVertexArray(0);
}

}  // namespace bl::desktop
