// Tensions that are all gone are equal to those that never were, however that came about.
#include "core/graph/tensions.h"

#include <gtest/gtest.h>

namespace bl {
namespace {

TEST(Tensions, AreEqualByWhatTheySay) {
  const Tensions none(3);
  Tensions some(3);
  EXPECT_TRUE(some == none);
  some.set(1, 0);
  EXPECT_TRUE(some == none);
  some.set(1, 2.5);
  EXPECT_EQ(some[0], 0);
  EXPECT_EQ(some[1], 2.5);
  EXPECT_EQ(some[2], 0);
  EXPECT_EQ(some.size(), 3u);
  EXPECT_FALSE(some == none);
  EXPECT_FALSE(none == some);
  some.tidy();
  EXPECT_EQ(some[1], 2.5);
  some.set(1, 0);
  EXPECT_TRUE(some == none);
  EXPECT_TRUE(none == some);
  some.tidy();
  EXPECT_TRUE(some == none);
  EXPECT_FALSE(Tensions(2) == none);
}

}  // namespace
}  // namespace bl
