// The one design of the window: colours with a meaning, a type scale, spacing; dark and light, any scale.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <imgui.h>

#include "core/define/definition.h"

namespace bl::desktop {

/// Colours by meaning, never by hue; packed as ImGui wants them.
struct Colours {
  ImU32 window, panel, raised, sunken, line;         ///< surfaces, from the window's background to pressed fields; hairlines
  ImU32 text, text_soft, text_faint;                 ///< body, labels, hints
  ImU32 accent, accent_soft, on_accent;              ///< selected or pressable elements; their subdued form; text on them
  ImU32 good, warning, bad;                          ///< met, in tension, failing: always used with a word or a sign
  ImU32 canvas, grid, grid_strong, node, node_head;  ///< the node canvas
  ImU32 sky, ground;                                 ///< the 3D view
};

/// Families of links: each has a colour and a name, the same as in the report.
struct Family {
  std::string_view label;
  ImU32 colour;
};

/// Text in sizes of one scale; `canvas` holds the same face in growing sizes, so that a zoomed canvas stays sharp.
struct Fonts {
  ImFont *body = nullptr, *small = nullptr, *strong = nullptr, *title = nullptr, *display = nullptr;
  std::vector<ImFont*> canvas;  ///< ascending size
};

class Theme {
 public:
  /// Sets ImGui's style. `scale` 1 to 2: pixels per point.
  void apply(bool is_dark, float scale);
  /// Builds the font atlas of the current ImGui context; returns a sentence where the packaged face is missing and another one is
  /// used.
  std::string load_fonts(float scale);

  const Colours& colours() const { return colours_; }
  const Fonts& fonts() const { return fonts_; }
  bool is_dark() const { return is_dark_; }
  float scale() const { return scale_; }
  /// Points to pixels.
  float px(float points) const { return points * scale_; }
  /// The font of the canvas scale that is nearest above `pixels`, to be drawn at that size.
  ImFont* canvas_font(float pixels) const;

  /// `kind` is nullptr for links of unknown kinds.
  Family family_of(const LinkDefinition* kind) const;
  /// A colour for the k-th of several categories (uses), distinguishable under any colour vision.
  ImU32 category(std::size_t k) const;
  /// Perceptually even ramp (dark blue to yellow), t in 0 to 1.
  static ImU32 ramp(double t);
  /// Diverging ramp: blue for too little, light for right, red-brown for too much; t in -1 to 1.
  ImU32 diverging(double t) const;

 private:
  Colours colours_{};
  Fonts fonts_;
  bool is_dark_ = true;
  float scale_ = 1;
};

/// `colour` with another opacity, 0 to 1.
ImU32 faded(ImU32 colour, float opacity);
/// `share` of `b` in `a`.
ImU32 mixed(ImU32 a, ImU32 b, float share);

/// `#rrggbb` as a colour; `otherwise` where the text is none.
ImU32 colour_of_text(const std::string& text, ImU32 otherwise = IM_COL32(128, 128, 128, 255));

/// Signs of the packaged icon face, as UTF-8.
namespace icon {
inline constexpr const char *kPlay = "\xef\x81\x8b", *kPause = "\xef\x81\x8c", *kStep = "\xef\x81\x91", *kRewind = "\xef\x81\x8a",
                            *kSearch = "\xef\x80\x82", *kWarning = "\xef\x81\xb1", *kError = "\xef\x81\x97",
                            *kLock = "\xef\x80\xa3", *kUnlock = "\xef\x82\x9c", *kEye = "\xef\x81\xae", *kHidden = "\xef\x81\xb0",
                            *kFolder = "\xef\x81\xbb", *kFile = "\xef\x80\x96", *kClose = "\xef\x80\x8d",
                            *kCheck = "\xef\x80\x8c", *kMuted = "\xef\x80\xa6", *kLink = "\xef\x83\x81", *kCube = "\xef\x86\xb2",
                            *kClock = "\xef\x80\x97", *kBalance = "\xef\x89\x8e", *kPlus = "\xef\x81\xa7",
                            *kReset = "\xef\x80\xa1", *kUp = "\xef\x81\xa2", *kHome = "\xef\x80\x95";
}  // namespace icon

/// The sign that stands for a declared icon.
const char* sign_of(Icon icon);

}  // namespace bl::desktop
