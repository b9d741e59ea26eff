// What every drawing carries: labels that do not cover each other, a north arrow, a scale bar.
#pragma once

#include <string>
#include <vector>

#include "core/drawing/markup.h"
#include "core/drawing/projection.h"

namespace bl::drawing {

/// Estimated width of a text [px]; fonts differ, so it is on the wide side.
double text_width(const std::string& text, double size);

/// What shall be written near `anchor`: two lines, or the short form where there is no room.
struct Label {
  Pixel anchor;
  std::string first, second, short_form;
};

/// Writes labels so that none covers another, the first of them with the first choice.
class LabelPlacer {
 public:
  /// Labels stay inside `frame` and out of what has been `taken`.
  LabelPlacer(const Box& frame, std::vector<Box> taken) : frame_(frame), taken_(std::move(taken)) {}
  /// `most_long`: how many labels may have the long form. Returns how many found no place at all.
  std::size_t write(Markup& svg, const std::vector<Label>& labels, std::size_t most_long);

 private:
  bool place_long(Markup& svg, const Label& label);
  bool place_short(Markup& svg, const Label& label);
  bool take(const Box& box);
  Box frame_;
  std::vector<Box> taken_;
};

/// An arrow to true north on the ground, as the view shows the ground; `degrees` clockwise from the y axis.
void draw_north(Markup& svg, const View& view, double degrees, Pixel centre, double radius);
/// A bar of a round number of metres, at most `most_width` pixels wide, its left end at `at`.
void draw_scale_bar(Markup& svg, double pixels_per_metre, Pixel at, double most_width);
/// 1, 2 or 5 times a power of ten, not above `most`.
double round_length(double most);

}  // namespace bl::drawing
