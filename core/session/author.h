// Who gives a command: a person, a device such as a sensor, or a program.
#pragma once

#include <compare>
#include <cstdint>
#include <string>

namespace bl {

enum class AuthorKind : std::uint8_t { person, device, program };

/// Made by the program that runs the session, never by the author: a device cannot sign as a person. The default is a person.
struct Author {
  Author() = default;
  Author(std::string who, AuthorKind what = AuthorKind::person)
      : id(std::move(who)), kind(what) {}  // NOLINT: implicit on purpose
  Author(const char* who) : id(who) {}     // NOLINT: implicit on purpose

  std::string id;
  AuthorKind kind = AuthorKind::person;

  auto operator<=>(const Author&) const = default;
};

}  // namespace bl
