// How a fuzz target says that a law is broken.
#pragma once

#include <cstdio>
#include <cstdlib>

namespace bl::fuzz {

inline void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "broken law: %s\n", what);
  std::abort();
}

}  // namespace bl::fuzz
