// Surveys of many shapes, of which those that have not changed since the last tick are kept.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/base/parallel.h"
#include "core/facade/facade_survey.h"

namespace bl::facade {

/// One shape with the shapes that may cover it.
struct SurveyCase {
  std::string id;
  MeshPointer mesh;
  std::vector<MeshPointer> neighbours;
  SurveyOptions options;
  bool operator==(const SurveyCase&) const = default;
};

/// What it hands out depends on the cases alone: kept surveys are those of equal cases, with the very same meshes.
class SurveyCache {
 public:
  /// In the order of the cases; valid until the next call.
  std::vector<const FacadeSurvey*> of(const std::vector<SurveyCase>& cases, ThreadPool* pool);
  /// How many the last call has made anew.
  std::size_t made() const { return made_; }

 private:
  struct Entry {
    SurveyCase asked;
    FacadeSurvey survey;
  };
  std::map<std::string, Entry> kept_;
  std::size_t made_ = 0;
};

}  // namespace bl::facade
