// A DXF R2000 drawing (AC1015): layers, closed lines with arcs, lines and texts, in metres, with unique handles.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/vector.h"

namespace bl::exporting {

class DxfDrawing {
 public:
  /// A corner and the arc that begins there: the tangent of a quarter of its angle, counter-clockwise; 0: a straight side.
  struct Corner {
    Point3 at;
    double bulge = 0;
  };

  /// A layer name that all programs take: capitals, digits, `-` and `_`; other letters as `_`.
  static std::string layer_name(std::string_view text);

  /// `colour`: a number of AutoCAD's list. A layer that is there already keeps its colour.
  void layer(const std::string& name, int colour);
  void polyline(const std::string& layer, const std::vector<Corner>& corners, bool is_closed, double elevation);
  void line(const std::string& layer, const Point3& from, const Point3& to);
  /// `height` of capitals [m]; centred: about its place, else from its lower left.
  void text(const std::string& layer, const Point3& at, double height, std::string_view words, bool is_centred = false);

  /// Are there question marks in place of letters of texts?
  bool has_lost_letters() const { return has_lost_letters_; }

  /// `comment`: a line at the head of the file.
  std::string str(const std::string& comment) const;

 private:
  struct Entity {
    std::string type, layer, body;  // body: groups behind the common ones
  };
  void reach(const Point3& p);
  std::map<std::string, int> layers_ = {{"0", 7}};
  std::vector<Entity> entities_;
  bool has_lost_letters_ = false;
  Point3 low_ = {1e20, 1e20, 1e20}, high_ = {-1e20, -1e20, -1e20};
};

}  // namespace bl::exporting
