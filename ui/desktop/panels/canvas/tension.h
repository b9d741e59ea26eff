// Where proposals on a node's ports disagree, and who pulls.
#pragma once

#include <string>
#include <vector>

#include "ui/desktop/panels/canvas/model.h"

namespace bl::desktop::canvas {

/// Less than this share of what is pulled at is not marked on the canvas.
inline constexpr double kMarkedTension = 0.02;

struct Pull {
  PortRef port;
  double share = 0;  ///< tension against the size of what is pulled at
  std::string text;  ///< "demand: 340 m³ apart"
};

/// Tension of one port as a share of its size; 0 where there is none.
double tension_share(const State& state, PortRef ref);
/// The worst share over all ports of the node.
double worst_tension(const State& state, std::uint32_t node);
/// Ports of the node under marked tension, the worst first.
std::vector<Pull> pulls_of(const State& state, std::uint32_t node);
/// Who pulls at a port: "Attract (hotel_market) pulls 0.12 m".
std::vector<std::string> voices_at(const State& state, PortRef port);
/// Why a node's typification fails, or empty.
std::string error_of(const State& state, std::uint32_t node);
bool has_error(const State& state, std::uint32_t node);

}  // namespace bl::desktop::canvas
