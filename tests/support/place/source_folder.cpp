// The one file of the tests that knows the path of the checkout.
#include "tests/support/place/source_folder.h"

namespace bl::test {

const std::string& source_folder() {
  static const std::string folder = BL_SOURCE_DIR;
  return folder;
}

}  // namespace bl::test
