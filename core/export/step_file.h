// A STEP file (ISO 10303-21): numbered entities, each one line, with values written as the format wants them.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/vector.h"

namespace bl::exporting {

/// A text in quotes: letters beyond ASCII by their numbers.
std::string step_text(std::string_view utf8);
/// A number with its point: "3.", "0.25", "1.5E-7".
std::string step_real(double number);
/// "(a,b,c)".
std::string step_list(const std::vector<std::string>& items);
/// "(1.,2.,3.)"; the height only where it is wanted.
std::string step_coordinates(const Point3& p, bool with_height = true);

class StepFile {
 public:
  /// "#12": the name of the new entity. `arguments` are written as they are.
  std::string add(std::string_view entity, std::initializer_list<std::string> arguments);
  /// `description`, `name`, `schema`: of the header. No clock: the date is that of the beginning of time.
  std::string str(const std::string& description, const std::string& name, const std::string& schema) const;

 private:
  std::string body_;
  std::size_t count_ = 0;
};

}  // namespace bl::exporting
