// Colours of uses: told apart by people with any colour vision, and never without a letter beside them.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace bl::drawing {

struct Colour {
  double red = 0, green = 0, blue = 0;  ///< 0 to 1, sRGB
};

/// "#rrggbb".
std::string hex(const Colour& colour);
/// `share` of `b` in `a`, in sRGB, as drawing programs mix.
Colour mix(const Colour& a, const Colour& b, double share);

inline constexpr Colour kPaper = {0.988, 0.984, 0.973};
inline constexpr Colour kInk = {0.13, 0.15, 0.19};
inline constexpr Colour kWhite = {1, 1, 1};
/// Deep shade of a drawing: a blue-grey, as daylight shadows are.
inline constexpr Colour kShade = {0.17, 0.20, 0.29};

/// A letter for each use, in the order given, beside the colour that it has everywhere (use_colours).
class Palette {
 public:
  explicit Palette(const std::vector<std::string>& uses);
  Colour colour(const std::string& use) const;
  /// "A", "B", ... "Z", "AA", ...
  std::string letter(const std::string& use) const;

 private:
  std::map<std::string, std::size_t> order_;
};

}  // namespace bl::drawing
