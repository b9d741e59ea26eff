// Applies a style to a surveyed façade: glazed and opaque areas, panels and cost.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/facade/facade_survey.h"

namespace bl::facade {

/// The rules of a style for one orientation of one use.
struct FacadeRule {
  double glazing = 0.4;                         ///< glazed share of a storey's façade
  double module = 3;                            ///< width of one window with its pier [m]
  double sill = 0.9, band = 0.4;                ///< closed heights above the floor, and under the next one [m]
  double cost_glazed = 900, cost_opaque = 450;  ///< [€/m²]
  bool operator==(const FacadeRule&) const = default;
};
using FacadeRules = std::array<FacadeRule, kOrientations>;

/// The windows of a storey of that height; none where sill and band leave nothing.
WindowBand band_of(const FacadeRule& rule, double storey_height);

std::array<WindowBand, kOrientations> bands_of(const FacadeRules& rules, double storey_height);

/// The largest share of a whole storey that its band holds.
double most_glazing(const FacadeRule& rule, double storey_height);

/// The width of the windows in each module, as a share of it, that gives the wanted glazing.
double window_width(const FacadeRule& rule, double factor, double storey_height);

/// [m²] and [€], of one orientation or one storey, or of all.
struct DressedArea {
  double glazed = 0, opaque = 0, cost = 0;
  double panels = 0;  ///< modules, one storey high
  double area() const { return glazed + opaque; }
  DressedArea& operator+=(const DressedArea& other);
};

struct Dressing {
  DressedArea all;
  std::array<DressedArea, kOrientations> by_orientation;
  std::vector<DressedArea> by_storey;  ///< index = storey
  double missing = 0;                  ///< glazing that finds no room between sill and band even in a whole storey [m²]
};

/// `factor` multiplies every glazing ratio; no ratio goes beyond 1. Windows stand between sill and band only; a storey that
/// ends early has less room for them. Glazed and opaque add up to the façade.
Dressing dress(const FacadeSurvey& survey, const FacadeRules& rules, double factor, double storey_height);

/// Adds a sentence where glazing is missing.
void add_missing_text(const Dressing& dressing, std::string& message);

}  // namespace bl::facade
