// Values of imports as ports of typifications that this program really has.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/define/json_text.h"
#include "core/define/registry.h"

namespace bl::making {

Json points_json(const std::vector<Point3>& points, bool with_heights);

/// Values for ports that this program's typification really has, in the kind that it wants.
class Fitting {
 public:
  explicit Fitting(const TypificationDefinition& type);
  ~Fitting();
  void set(const char* port, double value);
  void set(const char* port, bool value);
  void set(const char* port, const std::vector<Point3>& points);
  void set_node(const char* port, const std::string& id);
  const Json& values() const { return *values_; }

 private:
  const PortDefinition* settable(const char* port) const;

  const TypificationDefinition& type_;
  std::unique_ptr<Json> values_;
};

}  // namespace bl::making
