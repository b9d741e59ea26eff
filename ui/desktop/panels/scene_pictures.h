// Small pictures of the shipped scenes, made by running them: what a person sees is what the scene gives.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/define/registry.h"
#include "core/graph/state.h"

namespace bl::desktop {

/// A triangle of a picture, in a square of side 1, y downwards; painted in the order given.
struct PictureTriangle {
  float x[3], y[3];
  float shade;         ///< 0 dark to 1 light
  std::size_t colour;  ///< the tone of its use, or kNoUse
};

struct ScenePicture {
  std::string path, title, about;
  std::size_t volumes = 0;
  bool is_ready = false;
  std::vector<PictureTriangle> triangles;
  std::vector<std::vector<std::pair<float, float>>> grounds;  ///< outlines of boundaries, in the same square
  std::vector<std::vector<std::pair<float, float>>> streets;  ///< from end to end
};

/// Runs scenes one after the other on a thread of its own, for as long as somebody looks.
class ScenePictures {
 public:
  ScenePictures(const Registry& registry, std::vector<std::string> paths);
  ~ScenePictures();
  ScenePictures(const ScenePictures&) = delete;
  ScenePictures& operator=(const ScenePictures&) = delete;

  /// Pictures in the order of the paths; each is replaced by a finished one as soon as there is one.
  std::vector<std::shared_ptr<const ScenePicture>> pictures() const;
  /// Have all been made that can be?
  bool is_done() const;

 private:
  struct Worker;
  std::unique_ptr<Worker> worker_;
};

/// An axonometric picture of a state: volumes, boundaries and streets.
ScenePicture picture_of(const State& state);

}  // namespace bl::desktop
