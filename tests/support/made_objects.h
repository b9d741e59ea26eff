// Two types of made objects that only tests have: who asks for one must not get the other.
#pragma once

#include <string_view>

namespace bl {

struct MadeRoute {
  static constexpr std::string_view kMadeName = "a route";
  double length = 0;
};
struct MadeTunnel {
  static constexpr std::string_view kMadeName = "a tunnel";
};

}  // namespace bl
