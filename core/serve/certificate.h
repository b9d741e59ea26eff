// What a certificate for encryption says of itself: for which names it was made, and from when to when it is valid.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace bl::serve {

struct Certificate {
  std::string subject;                ///< as it names itself, such as `CN=session.example.org`
  std::vector<std::string> names;     ///< host names and addresses for which it was made
  std::vector<std::string> fitting;   ///< of the asked hosts, those that a browser takes it for
  std::int64_t begins = 0, ends = 0;  ///< [ms since 1970]
  bool fits_key = false;              ///< the private key belongs to it
  bool is_of_itself = false;          ///< no authority has signed it
};

/// Reads the first certificate of a PEM file and its key, and asks it about these hosts: names or addresses. Nobody is asked for
/// the password of a key: one that has a password is an error.
Result<Certificate> read_certificate(const std::string& file, const std::string& key_file, const std::vector<std::string>& hosts);

}  // namespace bl::serve
