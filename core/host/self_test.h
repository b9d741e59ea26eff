// What this program is, and what it computes: two programs in one room tick alike only where both are equal.
#pragma once

#include <string>

namespace bl::host {

struct SelfTest {
  std::string build;        ///< version, types, compiler and libraries, as one word
  std::string fingerprint;  ///< the hash after thirty ticks of a small scene; it tells what `build` cannot, such as the processor
};

/// Of the types that come with the program and are loaded into it. Taken at the first call, in a fraction of a second, and kept.
const SelfTest& self_test();

}  // namespace bl::host
