// Values that no port takes are left out, and numbers are brought into their range.
#include "core/making/port_fitting.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "core/making/tidy_length.h"

namespace bl::making {

Json points_json(const std::vector<Point3>& points, bool with_heights) {
  Json list = Json::array();
  for (const Point3& p : points) list.push_back({tidy_length(p.x), tidy_length(p.y), with_heights ? tidy_length(p.z) : 0.0});
  return list;
}

Fitting::Fitting(const TypificationDefinition& type) : type_(type), values_(std::make_unique<Json>(Json::object())) {}
Fitting::~Fitting() = default;

const PortDefinition* Fitting::settable(const char* port) const {
  const PortDefinition* found = type_.find_port(port);
  return found != nullptr && !found->is_computed ? found : nullptr;
}

void Fitting::set(const char* port, double value) {
  const PortDefinition* found = settable(port);
  if (found == nullptr) return;
  const double fitted = std::clamp(value, found->hard_minimum, found->hard_maximum);
  if (found->kind == ValueKind::integer) (*values_)[port] = static_cast<std::int64_t>(std::llround(fitted));
  else if (found->kind == ValueKind::number) (*values_)[port] = fitted;
}

void Fitting::set(const char* port, bool value) {
  const PortDefinition* found = settable(port);
  if (found != nullptr && found->kind == ValueKind::boolean) (*values_)[port] = value;
}

void Fitting::set(const char* port, const std::vector<Point3>& points) {
  const PortDefinition* found = settable(port);
  if (found != nullptr && found->kind == ValueKind::points) (*values_)[port] = points_json(points, false);
}

void Fitting::set_node(const char* port, const std::string& id) {
  const PortDefinition* found = settable(port);
  if (found != nullptr && found->kind == ValueKind::selection) (*values_)[port] = Json::array({id});
}

}  // namespace bl::making
