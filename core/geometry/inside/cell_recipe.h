// The meshes of one cell, for those who may look at them later: what they are made from is kept, and nothing is made.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/geometry/inside/cell_seams.h"
#include "core/geometry/power_cells.h"

namespace bl::geometry {

class CellRecipe : public MeshRecipe {
 public:
  /// `shapes` of the parts, and the `centroid` of all, relative to the site. It keeps what it needs of them.
  CellRecipe(std::shared_ptr<const std::vector<Polyhedron>> parts, std::span<const ShapeMeasure> shapes, const PowerSite& site,
             const Point3& centroid, const CellOptions& options);

  std::shared_ptr<const Mesh> make_coarse() override;
  Mesh make() override;
  int depth() const override { return depth_; }

 private:
  std::span<const Polyhedron> near();
  std::vector<OpenPart> open(std::span<const Polyhedron> parts) const;

  std::shared_ptr<const std::vector<Polyhedron>> parts_;  // none once they are trimmed and nobody needs them whole
  std::vector<ShapeMeasure> shapes_;                      // without their areas
  PowerSite site_;
  Point3 centroid_;
  int depth_ = 0;
  bool with_coarse_ = false, is_near_ = false;
  std::optional<std::vector<Polyhedron>> trimmed_;
};

}  // namespace bl::geometry
