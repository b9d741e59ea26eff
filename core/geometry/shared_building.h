// Volumes that share one footprint, storey by storey: who has which part of which plate.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/plates.h"

namespace bl::geometry {

/// One of the volumes of a building, in the order from the ground up.
struct BuildingShare {
  std::uint32_t site = 0;    ///< by which others name it in their walls
  double area = 0;           ///< of floor, asked for [m²]
  double storey_height = 3;  ///< [m]
  bool operator==(const BuildingShare&) const = default;
};

/// The mean height of `storeys` equal plates on which the shares lie one after the other: that of a storey that several have is
/// the largest of theirs [m].
double mean_storey_height(std::span<const BuildingShare> shares, int storeys);

/// A building with the heights that its storeys get from those who have them, and what each of them has. All get the same share
/// of what they asked for. They fill the plates from the lowest up, in their order; a plate that two have is cut straight across
/// its longer direction.
struct SharedBuilding {
  StandingBody whole;
  std::vector<StandingBody> parts;  ///< one for each share; without stacks where it has nothing
  std::vector<double> roofs;        ///< area of the roof of each share, with nothing of the building above it [m²]
};
/// `body`: all storeys as if they were of one volume. `angle` [rad]: of the building, along or across which plates are cut.
SharedBuilding share_out(const StandingBody& body, std::span<const BuildingShare> shares, double angle);

}  // namespace bl::geometry
