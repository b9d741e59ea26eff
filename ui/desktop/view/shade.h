// What the sun that is shown casts: bodies of shade and outlines on the ground, made anew only for shapes that have changed.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "ui/desktop/view/urban_facts.h"

namespace bl::desktop {

/// The air that a caster keeps from the sun.
struct ShadeBody {
  std::uint32_t node = 0;
  std::string id;
  MeshPointer walls;            ///< its sides: where it begins it is the caster itself, where it ends the ground
  std::vector<Point3> outline;  ///< on the ground
};

class ShadeStore {
 public:
  /// Of the casters that are wanted, in their order; none where the sun is not above the horizon. `toward` points to it.
  std::vector<ShadeBody> bodies(const std::vector<CasterFacts>& casters, const Vector3& toward);
  /// Only the outlines: of all casters they cost little.
  std::vector<RingFacts> outlines(const std::vector<CasterFacts>& casters, const Vector3& toward);
  void clear() { made_.clear(); }

 private:
  struct Made {
    MeshPointer of;
    Vector3 toward;
    double ground = 0;
    MeshPointer walls;  ///< none before somebody wants them
    std::vector<Point3> outline;
  };
  Made& made_for(const CasterFacts& caster, const Vector3& toward);

  std::map<std::string, Made> made_;  ///< by id
};

}  // namespace bl::desktop
