// The closed meshes of a proposal for programs that print or show them: which bodies there are, and how they are placed.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "core/export/proposal_model.h"

namespace bl::exporting {

/// A body with a name and a material.
struct Solid {
  std::string name, material;
  drawing::Colour colour;
  std::shared_ptr<const Mesh> mesh;
  const Building* building = nullptr;  ///< none for surroundings
  bool is_cellar = false;              ///< the storeys of that building below the ground
};

/// The colour of what stands already.
inline constexpr drawing::Colour kExistingColour = {0.80, 0.80, 0.78};

/// The colour of the ground.
inline constexpr drawing::Colour kTerrainColour = {0.72, 0.70, 0.62};
/// The ground as surfaces, which are open: for programs that show, not for those that print.
std::vector<Solid> terrains_of(const Proposal& proposal);

/// One for each building, with one for its cellars behind it; then one for each building of the surroundings that has a mesh.
/// Cellars and surroundings only where they are wanted.
std::vector<Solid> solids_of(const Proposal& proposal, bool with_surroundings, bool with_cellars);
/// A sentence on the cellars of the proposal that are not wanted, none where nothing is left out.
std::vector<std::string> left_out_cellars(const Proposal& proposal, bool with_cellars);

/// The same for programs that print, which want bodies without a hole: of what stands already and has an open mesh they get an
/// upright body over its outline. `notes` names these.
std::vector<Solid> printable_solids_of(const Proposal& proposal, bool with_surroundings, bool with_cellars,
                                       std::vector<std::string>& notes);

/// A model at a scale in millimetres, with its lowest corner at (0, 0, 0): slicers expect it on the plate.
class ModelScale {
 public:
  /// `denominator` of 1:n.
  ModelScale(const std::vector<Solid>& solids, double denominator);
  Point3 millimetres(const Point3& metres) const { return factor_ * (metres - corner_); }
  double factor() const { return factor_; }         ///< [mm/m]
  const Point3& corner() const { return corner_; }  ///< [m]

 private:
  Point3 corner_;
  double factor_ = 1;
};

/// Does each side of a triangle meet exactly one other one in the opposite direction?
bool is_closed(const Mesh& mesh);

}  // namespace bl::exporting
