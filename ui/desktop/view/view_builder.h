// Makes the picture's plain data from what the state says, what is chosen and which layers are on; knows no OpenGL.
#pragma once

#include <map>
#include <set>
#include <span>
#include <string>

#include "ui/desktop/editor/editor.h"
#include "ui/desktop/view/colouring.h"
#include "ui/desktop/view/isochrones.h"
#include "ui/desktop/view/scene_facts.h"
#include "ui/desktop/view/shade.h"
#include "ui/desktop/view/view_scene.h"
#include "ui/desktop/view/volume_pictures.h"

namespace bl::desktop {

/// A part of the picture that people switch on and off.
struct Layer {
  const char *id, *label;
  bool is_on_at_first;
};
inline constexpr std::size_t kLayerCount = 26;
std::span<const Layer> layers();
/// As the person has it, or as it is at first.
bool is_on(const PersonSettings& person, const std::string& layer);
void set_layer(PersonSettings& person, const std::string& layer, bool is_on);

/// The sun that the view shows, and what it casts: that of the scene, or of another moment that somebody looks at.
struct SunLook {
  bool is_there = false;    ///< the scene has a sun
  bool is_preview = false;  ///< it is not the scene's moment
  std::string clock;        ///< the moment that is shown, such as "15:40"
  Vector3 toward;           ///< unit vector; below the horizon it points downwards
  std::vector<ShadeBody> bodies;
  std::vector<RingFacts> outlines;  ///< of a preview: those of the scene stand in its facts
};

/// What the view itself decides.
struct ViewChoices {
  Camera camera;
  ViewSection section;
  std::string folder = {};               ///< of the scene's file, which pictures are named from; empty: the current one
  std::map<std::uint32_t, Point3> held;  ///< nodes in somebody's hand: where the hand has them
  SunLook sun = {};
  std::shared_ptr<const Isochrones> isochrones = {};  ///< of the chosen node; none where they are not wanted
};

/// `last`: the volumes of the picture before this one, which become those of this one; null: all are made.
ViewScene build_view(const SceneFacts& facts, const Colouring& colouring, const ViewChoices& choices, const Picks& picks,
                     const PersonSettings& person, const Theme& theme, VolumePictures* last = nullptr);

/// A distance of lines that people count with: 1, 2 or 5 times a power of ten, near to `wanted` [m].
double round_distance(double wanted);

}  // namespace bl::desktop
