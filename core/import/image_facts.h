// The metadata of a picture file: size, orientation, time and place, and direction of view.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace bl::importing {

struct ImageFacts {
  int width = 0, height = 0;                  ///< pixels as they are stored, before they are turned
  int orientation = 1;                        ///< 1 to 8, as in EXIF: how the pixels are turned for display
  std::string taken;                          ///< "2015-08-12T14:03:21", by the camera's clock; empty where it is not said
  std::optional<double> latitude, longitude;  ///< [degree], WGS84
  std::optional<double> altitude;             ///< above the sea [m]
  std::optional<double> bearing;              ///< where the camera looked, clockwise from true north [degree]
  std::optional<double> field_of_view;        ///< across the width as it is seen [degree], by the focal length
  std::string author, licence, note;          ///< artist, copyright, description
  std::vector<std::string> notes;             ///< metadata that could not be used, one sentence each

  bool is_turned() const { return orientation >= 5; }
  /// As people see it.
  int seen_width() const { return is_turned() ? height : width; }
  int seen_height() const { return is_turned() ? width : height; }
};

/// Of the bytes of a JPEG or PNG file.
Result<ImageFacts> read_image_facts(std::string_view bytes);

}  // namespace bl::importing
