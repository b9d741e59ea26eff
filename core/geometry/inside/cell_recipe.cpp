// Trims a cell that reaches far beyond its ball, once for both meshes.
#include "core/geometry/inside/cell_recipe.h"

#include <utility>

#include "core/geometry/cell_mesh.h"
#include "core/geometry/inside/cell_trim.h"

namespace bl::geometry {

CellRecipe::CellRecipe(std::shared_ptr<const std::vector<Polyhedron>> parts, std::span<const ShapeMeasure> shapes,
                       const PowerSite& site, const Point3& centroid, const CellOptions& options)
    : parts_(std::move(parts)),
      site_(site),
      centroid_(centroid),
      depth_(options.tessellation_depth),
      with_coarse_(options.with_coarse_mesh && options.with_shape) {
  shapes_.resize(shapes.size());
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    shapes_[k].volume = shapes[k].volume;
    shapes_[k].centroid = shapes[k].centroid;
    shapes_[k].is_empty = shapes[k].is_empty;
  }
  // Every vertex is the sum of something and this: where this has no zero with a sign, no sum is one.
  site_.position += Vector3{0, 0, 0};
}

std::span<const Polyhedron> CellRecipe::near() {
  if (!is_near_) trimmed_ = trimmed_parts(*parts_, shapes_, site_, centroid_);
  is_near_ = true;
  return trimmed_ ? *trimmed_ : *parts_;
}

std::vector<OpenPart> CellRecipe::open(std::span<const Polyhedron> parts) const {
  return parts.size() > 1 ? open_parts(parts, shapes_, site_.weight) : std::vector<OpenPart>{};
}

std::shared_ptr<const Mesh> CellRecipe::make_coarse() {
  if (!with_coarse_) return nullptr;
  const std::span<const Polyhedron> parts = near();
  Mesh coarse = make_coarse_mesh(parts, shapes_, open(parts), site_, centroid_);
  // Façades are measured on whole faces, which two neighbours have in common.
  if (trimmed_) coarse.whole = std::make_shared<const Mesh>(make_coarse_mesh(*parts_, shapes_, open(*parts_), site_, centroid_));
  auto made = std::make_shared<const Mesh>(std::move(coarse));
  if (trimmed_) parts_.reset();
  return made;
}

Mesh CellRecipe::make() {
  const std::span<const Polyhedron> parts = near();
  return make_mesh(parts, shapes_, open(parts), site_, depth_, centroid_);
}

}  // namespace bl::geometry
