// The volumes and buildings of one picture after another: of the next picture only those are made that may look another way.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "ui/desktop/editor/editor.h"
#include "ui/desktop/view/colouring.h"
#include "ui/desktop/view/scene_facts.h"
#include "ui/desktop/view/view_scene.h"

namespace bl::desktop {

class VolumePictures {
 public:
  /// What they are made from.
  struct Look {
    const SceneFacts& facts;
    const std::vector<Colour>& colours;  ///< as facts.volumes; plaster where there are fewer
    const Picks& picks;
    bool has_facades, has_bodies, is_dark;
  };
  const ViewVolumes& of(const Look& look);

 private:
  static constexpr std::uint32_t kNowhere = 0xffffffffu;

  // Who stands out, by hand or because a link does that joins it.
  struct Marks {
    std::string hovered;
    std::set<std::string> chosen;
    std::set<std::uint32_t> joined;
    bool operator==(const Marks&) const = default;
  };
  Marks marks_of(const Look& look) const;
  ViewVolume picture_of(const Look& look, std::size_t row) const;
  ViewVolume picture_of(const Look& look, const BodyFacts& body) const;
  ViewVolume picture_of(const Look& look, const CellarFacts& cellar) const;
  bool has_same_places(const Look& look) const;
  void make_all(const Look& look);
  void follow(const Look& look, const Marks& before);
  std::set<std::size_t> marked_rows(const Look& look, const Marks& marks) const;

  VolumeList volumes_;  ///< what the last picture was made from
  std::vector<Colour> colours_;
  Marks marks_;
  bool has_facades_ = false;
  std::vector<std::uint32_t> nodes_;  ///< of the picture's items
  /// Where rows, buildings and cellars are among the items.
  std::vector<std::uint32_t> rows_, bodies_, cellars_;
  ViewVolumes shown_;
};

}  // namespace bl::desktop
