// Where the checkout is that the tests were built from.
#pragma once

#include <string>

namespace bl::test {

/// The root of the checkout, an absolute path without a slash at its end.
const std::string& source_folder();

}  // namespace bl::test
