// Where a password is kept: never in a scene, which is saved, shared and logged.
#pragma once

#include <string>
#include <string_view>

#include "core/base/result.h"

namespace bl::address {

struct PasswordSource {
  bool is_file = false;  ///< else a variable of the environment
  std::string name;
};

/// `env:BL_NAME` or `file:NAME.password`. A scene from somebody else must not send other secrets of this computer to a host of
/// its choice: hence these names only.
Result<PasswordSource> parse_password_source(std::string_view text);

}  // namespace bl::address
