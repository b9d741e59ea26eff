// The access to a broker: user name, and security of the connection. Passwords are read when they are needed.
#pragma once

#include <map>
#include <string>

#include "core/base/result.h"
#include "core/graph/scene.h"

namespace bl::live {

/// What a node of the type `mqtt_broker` says. Without such a node all is empty.
struct Access {
  std::string node;  ///< its id
  std::string user, password_from, ca_file;
  bool is_encrypted = false;
  std::string folder;  ///< relative paths start here
  bool operator==(const Access&) const = default;

  /// Empty where none is asked for; an error says what is missing, and never holds the password.
  Result<std::string> password() const;
  /// The path of `ca_file`, if it can be read; empty where none is named.
  Result<std::string> certificates() const;
};

/// By "host:port"; of several nodes the first id counts.
std::map<std::string, Access> accesses_of(const Scene& scene, const std::string& folder);

}  // namespace bl::live
