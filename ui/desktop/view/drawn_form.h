// In which form volumes are drawn, and up to which storey: facts of a state with other shapes.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "core/geometry/plates.h"
#include "core/reading/volume_form.h"
#include "ui/desktop/view/colouring.h"
#include "ui/desktop/view/scene_facts.h"

namespace bl::desktop {

/// The same forms as those of exports.
using DrawnForm = reading::VolumeForm;
using FormChoice = reading::VolumeFormChoice;
inline constexpr std::size_t kFormCount = reading::kVolumeForms;
/// All forms, in the order of menus; the first is that of a new window.
std::span<const FormChoice> form_choices();
/// By its id; the first where there is none of that id.
const FormChoice& form_of(const std::string& id);

struct DrawnLook {
  DrawnForm form = DrawnForm::as_is;
  /// How many from the ground up are drawn; 0: all. Below 0 only cellars: -1 all of them, -2 from the second down.
  int storeys = 0;
  bool opens_ground = false;  ///< cellars are drawn besides, where a section may lay them open
  bool is_plain() const { return form == DrawnForm::as_is && storeys == 0 && !opens_ground; }
  bool operator==(const DrawnLook&) const = default;
};

/// How many storeys of the volume stand below its own lowest one, counted in its own storey height from the ground of the scene;
/// below 0 where it begins under the ground.
int storeys_below(const VolumeFacts& volume, double ground);
/// The number of its storeys, at least 1; 0 where it has no height.
int storeys_of(const VolumeFacts& volume);
/// The number of storeys from the ground up that show all of every volume; 0 without volumes.
int storeys_in(const SceneFacts& facts);
/// The number of storeys below the ground, of the volume that has most of them.
int cellars_in(const SceneFacts& facts);

class DrawnShapes {
 public:
  /// The facts with the shapes of that look, and without volumes of which it shows nothing. What has not changed keeps its shape.
  std::shared_ptr<const SceneFacts> of(const std::shared_ptr<const SceneFacts>& facts, const DrawnLook& look);
  /// What is drawn and what it measures, beside the figures of the scene; empty where volumes are drawn whole as they are.
  const Legend& legend() const { return legend_; }
  /// What a volume measures in the form that is drawn, whole, though it may be cut; nothing where it has no shape, or is drawn as
  /// it is.
  struct FormFigures {
    double volume = 0, floor_area = 0;  ///< [m³], [m²]
  };
  std::optional<FormFigures> figures_of(std::uint32_t node) const;

 private:
  struct Shape {
    MeshPointer mesh, cell;  ///< what it was made from
    Point3 position;
    double bottom = 0, height = 0, storey_height = 0, volume = 0, weight = 0;
    int storeys = 0;  ///< that are shown; 0: all
    DrawnForm form = DrawnForm::as_is;
    MeshPointer made;
    bool is_edgeless = false;
    double drawn_volume = 0, drawn_area = 0, form_volume = 0, form_area = 0;
    bool is_of_same(const Shape& other) const;
  };
  void fill_or_leave(const SceneFacts& facts, const VolumeFacts& volume, Shape& shape) const;
  static void fill_standing(const SceneFacts& facts, const VolumeFacts& volume, Shape& shape);
  void fill(const SceneFacts& facts, const VolumeFacts& volume, Shape& shape) const;
  void tell(const SceneFacts& all, const SceneFacts& drawn, const DrawnLook& look);
  std::shared_ptr<SceneFacts> formed(const SceneFacts& facts, const DrawnLook& look);
  MeshPointer cellar_cell(const SceneFacts& facts, const VolumeFacts& volume, const CellarFacts& cellar, int from);
  void open_ground(const SceneFacts& facts, SceneFacts& drawn);
  std::shared_ptr<SceneFacts> below_ground(const SceneFacts& facts, int from);

  std::shared_ptr<const SceneFacts> from_, made_;
  DrawnLook look_;
  std::map<std::uint32_t, Shape> shapes_;  // by node
  // Its storeys from `from` down, 1 the uppermost; with what the cell was made from.
  struct CellarShape {
    MeshPointer mesh;
    int storeys = 0, from = 1;
    double height = 0;
    MeshPointer cell;
  };
  std::map<std::uint32_t, CellarShape> cellars_;  // by node
  Legend legend_;
};

}  // namespace bl::desktop
