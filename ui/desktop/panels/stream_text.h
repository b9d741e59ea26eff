// What a sensor said last, or what an actuator says: value with unit, age, and whether it can be relied on.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "ui/desktop/panels/workbench.h"

namespace bl::desktop {

enum class StreamStanding {
  good,
  stale,   ///< older than its sensor allows, or not sent yet
  lost,    ///< the line is broken, or what came is no reading
  silent,  ///< nothing has come, or nothing is sent
};

struct StreamText {
  StreamStanding standing = StreamStanding::silent;
  std::string value;    ///< "21.4 °C"
  std::string age;      ///< "3 s old", "sent 3 s ago", "no reading yet"
  std::string quality;  ///< as declared: "stale"; empty where it is good
  std::string message;  ///< what is wrong, as a sentence

  /// "21.4 °C, 3 s old, stale"
  std::string text() const;
};

/// Has the typification a value with an age and a quality, or is it one whose values leave the scene?
bool is_stream(const TypificationDefinition& type);
/// Of one typification of a node, both as numbers in the state.
std::optional<StreamText> stream_of(const Workbench& editor, const State& state, std::uint32_t node, std::size_t type);
/// Of the node's first stream; nothing where it has none.
std::optional<StreamText> stream_of(const Workbench& editor, const State& state, std::uint32_t node);

ImU32 colour_of(const Theme& theme, StreamStanding standing);
/// A disc, a triangle, a cross or a ring: told apart without colour.
void draw_standing(ImDrawList& list, const Theme& theme, ImVec2 middle, float radius, StreamStanding standing);

/// "just now", "3 s", "12 min", "5 h", "3 days".
std::string age_text(double seconds);

}  // namespace bl::desktop
