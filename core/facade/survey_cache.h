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

/// What it hands out depends on the cases alone. Kept surveys are those of the very same meshes with the same options; neighbours
/// matter by the faces that they cover.
class SurveyCache {
 public:
  /// In the order of the cases; valid until the next call.
  std::vector<const FacadeSurvey*> of(const std::vector<SurveyCase>& cases, ThreadPool* pool);

 private:
  struct Entry {
    SurveyCase asked;
    std::vector<ShapeFace> faces;  ///< of its mesh, those that neighbours cover marked
    FacadeSurvey survey;
  };
  static void renew(const SurveyCase& one, Entry& entry);

  std::map<std::string, Entry> kept_;
};

}  // namespace bl::facade
