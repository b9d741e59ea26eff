// The boundaries of a scene as sites: their grounds in plan, and the tables of what they leave out.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "core/define/registry.h"
#include "core/geometry/plan_ring.h"
#include "core/graph/scene.h"
#include "core/import/plan_cover.h"

namespace bl::making {

/// A polygon that is cut out of a boundary between two heights [m].
struct Exclusion {
  std::string name;
  std::string use;  ///< of ground that is kept open; empty: none
  geometry::Ring ring;
  double bottom = 0, top = 0;
};

struct Site {
  std::string id;                                    ///< of the node
  std::vector<std::vector<geometry::Ring>> grounds;  ///< each an outline with its holes; steps of a plan may overlap it
  double bottom = 0, top = 0;                        ///< [m]
  Table rows, rows_before;                           ///< its exclusions; as they were in the scene

  /// Puts these in place of all whose name is an old one. Were there any?
  bool replace(const std::function<bool(const std::string&)>& is_old, const std::vector<Exclusion>& exclusions);
  bool replace(const std::string& name, const std::vector<Exclusion>& exclusions = {});
  bool leaves_out(const std::string& name) const;
  /// Puts these behind the last one whose name belongs with theirs, else behind all.
  void extend(const std::function<bool(const std::string&)>& belongs, const std::vector<Exclusion>& exclusions);

 private:
  void insert(std::ptrdiff_t place, const std::vector<Exclusion>& exclusions);
};

/// All boundaries whose outline is known, with whatever form: of a hull or a mesh the ground is all that lies under it.
std::vector<Site> sites_of(const Scene& scene, const Registry& registry);

/// Does a place lie on the ground of a site, whatever its height is?
bool is_on(const Site& site, const Point3& place);

/// What of the shape lies on a ground [m²].
double area_on(const std::vector<geometry::Ring>& ground, const importing::PlanShape& shape);

}  // namespace bl::making
