// Builds XML text (SVG and the page around it) whose tags always match and whose texts are always escaped.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace bl::drawing {

/// Safe as text and as attribute; characters that XML does not allow and broken UTF-8 become U+FFFD.
std::string escape_xml(std::string_view text);

/// Pixels with one decimal at most: "12", "12.5", "-0.5".
std::string pixels(double value);

/// A place on the drawing sheet; y grows downwards.
struct Pixel {
  double x = 0, y = 0;
};

/// An SVG path in tenths of a pixel, relative, so that thousands of lines stay small. Rounding errors do not add up.
class PathText {
 public:
  void move(Pixel to);
  void line(Pixel to);
  void close();
  /// Points joined by lines; nothing where there are fewer than two.
  void polyline(const std::vector<Pixel>& points, bool is_closed);
  bool empty() const { return text_.empty(); }
  const std::string& text() const { return text_; }

 private:
  void number(std::int64_t tenths, bool after_letter);
  void step(char letter, std::int64_t x, std::int64_t y);
  std::string text_;
  char letter_ = 0;
  std::int64_t x_ = 0, y_ = 0, start_x_ = 0, start_y_ = 0;
};

/// Tags, texts and attributes in the order given.
class Markup {
 public:
  using Attributes = std::initializer_list<std::pair<std::string_view, std::string>>;
  Markup& open(std::string_view tag, Attributes attributes = {});
  Markup& close();
  /// An element without content.
  Markup& leaf(std::string_view tag, Attributes attributes = {});
  /// An element with a text in it.
  Markup& element(std::string_view tag, std::string_view text, Attributes attributes = {});
  Markup& text(std::string_view text);
  /// Markup made elsewhere by this class.
  Markup& raw(std::string_view markup);
  /// A path with its attributes; nothing where it is empty.
  Markup& path(const PathText& path, Attributes attributes);
  const std::string& str() const { return out_; }

 private:
  void start(std::string_view tag, Attributes attributes);
  std::string out_;
  std::vector<std::string> open_;
};

}  // namespace bl::drawing
