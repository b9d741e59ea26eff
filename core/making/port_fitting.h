// Values of imports as ports of typifications that this program really has.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/define/codec.h"
#include "core/define/registry.h"
#include "core/making/tidy_length.h"

namespace bl::making {

inline Json points_json(const std::vector<Point3>& points, bool with_heights) {
  Json list = Json::array();
  for (const Point3& p : points) list.push_back({tidy_length(p.x), tidy_length(p.y), with_heights ? tidy_length(p.z) : 0.0});
  return list;
}

/// Values for ports that this program's typification really has, in the kind that it wants.
class Fitting {
 public:
  explicit Fitting(const TypificationDefinition& type) : type_(type) {}
  void set(const char* port, double value) {
    const PortDefinition* found = type_.find_port(port);
    if (found == nullptr || found->is_computed) return;
    const double fitted = std::clamp(value, found->hard_minimum, found->hard_maximum);
    if (found->kind == ValueKind::integer) values[port] = static_cast<std::int64_t>(std::llround(fitted));
    else if (found->kind == ValueKind::number) values[port] = fitted;
  }
  void set(const char* port, bool value) {
    const PortDefinition* found = type_.find_port(port);
    if (found != nullptr && !found->is_computed && found->kind == ValueKind::boolean) values[port] = value;
  }
  void set_node(const char* port, const std::string& id) {
    const PortDefinition* found = type_.find_port(port);
    if (found != nullptr && !found->is_computed && found->kind == ValueKind::selection) values[port] = Json::array({id});
  }
  void set(const char* port, const std::vector<Point3>& points) {
    const PortDefinition* found = type_.find_port(port);
    if (found != nullptr && !found->is_computed && found->kind == ValueKind::points) values[port] = points_json(points, false);
  }
  Json values = Json::object();

 private:
  const TypificationDefinition& type_;
};

}  // namespace bl::making
