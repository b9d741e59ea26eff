// Studies one after the other, of which each follows only the rays of receivers that may see something else than in the last one.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/sun/sun_study.h"

namespace bl::sun {

/// Casters and receivers are found again by their names, which are unique.
struct SunCaster {
  std::string name;
  MeshPointer mesh;  ///< nullptr: casts nothing
};
struct SunCase {
  std::string name;
  SunReceiver receiver;
};

/// What it hands out are the bits of sun_study(), whatever was asked before. A receiver is measured again where its rectangle or
/// the moments are others, or where a caster that has come, gone or changed could stand, or have stood, between it and the sun.
class SunStudyCache {
 public:
  Result<std::vector<SunRecord>> of(std::span<const SunCaster> casters, std::span<const SunMoment> moments,
                                    std::span<const SunCase> cases, ThreadPool* pool);
  /// How many receivers the last call has measured.
  std::size_t measured() const { return measured_; }

 private:
  using Shapes = std::map<std::string, MeshPointer>;  ///< of the casters that cast and count
  struct Entry {
    SunReceiver receiver;
    Shapes shapes;
    SunRecord record;                       ///< without its casters
    std::map<std::string, SunLoss> losses;  ///< of those in the way
  };
  bool is_current(const Entry& kept, const SunReceiver& now, const Shapes& shapes) const;
  Result<void> measure(std::span<const SunCaster> casters, std::span<const SunCase> cases, std::span<const Shapes> shapes,
                       ThreadPool* pool);

  std::vector<SunMoment> moments_;
  std::map<std::string, Entry> kept_;
  std::size_t measured_ = 0;
};

}  // namespace bl::sun
