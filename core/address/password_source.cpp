// Takes the two forms apart, and refuses names that could mean something else than a password for this program.
#include "core/address/password_source.h"

#include <algorithm>

namespace bl::address {

Result<PasswordSource> parse_password_source(std::string_view text) {
  const auto refused = [](const std::string& message) { return Error{ErrorCode::parse, "", message}; };
  if (std::any_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }))
    return refused("holds a control character");
  if (text.starts_with("env:")) {
    const std::string_view name = text.substr(4);
    const bool is_plain = std::all_of(name.begin(), name.end(),
                                      [](char c) { return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_'; });
    if (!name.starts_with("BL_") || name.size() < 4 || !is_plain)
      return refused("the name of the variable has to begin with `BL_` and hold capitals, digits and `_` only: `env:BL_BROKER`");
    return PasswordSource{false, std::string(name)};
  }
  if (text.starts_with("file:")) {
    const std::string_view name = text.substr(5);
    if (!name.ends_with(".password") || name.size() == 9)
      return refused("the name of the file has to end with `.password`: `file:broker.password`");
    return PasswordSource{true, std::string(name)};
  }
  return refused("the password itself does not belong into a scene: write `env:BL_NAME` or `file:NAME.password`");
}

}  // namespace bl::address
