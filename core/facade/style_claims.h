// Decides which of several styles applies to a façade, with a sentence about the others.
#pragma once

#include <span>
#include <string>

namespace bl::facade {

struct StyleClaim {
  std::string dresser;  ///< empty: nobody
  std::string message;  ///< a sentence where several claim it, where one is unknown or where none is given; else empty
};

/// `claims`: names that the façade has, ascending; the first that is among `known` dresses it.
StyleClaim settle_claims(std::span<const std::string> claims, std::span<const std::string> known);

}  // namespace bl::facade
