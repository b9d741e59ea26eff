// What a program tells of itself before it takes ticks with others.
#include "core/host/self_test.h"

#include <gtest/gtest.h>

namespace bl::host {
namespace {

TEST(SelfTests, TheSceneOfTheTestRunsAndGivesAHash) {
  const SelfTest& own = self_test();
  ASSERT_EQ(own.fingerprint.size(), 16u) << own.fingerprint;
  EXPECT_EQ(own.fingerprint.find_first_not_of("0123456789abcdef"), std::string::npos) << own.fingerprint;
  EXPECT_NE(own.build.find("types-"), std::string::npos) << own.build;
  EXPECT_EQ(&own, &self_test()) << "it is taken once";
}

}  // namespace
}  // namespace bl::host
