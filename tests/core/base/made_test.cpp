// Made objects: made once and only when asked for, told apart by type, equal by identity.
#include "core/base/made.h"

#include <gtest/gtest.h>

#include "core/base/parallel.h"
#include "tests/support/made_objects.h"

namespace bl {
namespace {

Made route(double length, int& asked) {
  return Made::of<MadeRoute>([length, &asked] {
    ++asked;
    return std::make_shared<const MadeRoute>(MadeRoute{length});
  });
}

TEST(Made, IsMadeOnceAndOnlyWhenSomebodyAsks) {
  int asked = 0;
  const Made made = route(3, asked), same = made;
  EXPECT_EQ(asked, 0);
  EXPECT_EQ(made.get<MadeRoute>()->length, 3);
  EXPECT_EQ(same.get<MadeRoute>(), made.get<MadeRoute>());
  EXPECT_EQ(asked, 1);
}

TEST(Made, IsNothingForWhoAsksForAnotherType) {
  int asked = 0;
  EXPECT_EQ(route(1, asked).get<MadeTunnel>(), nullptr);
  EXPECT_EQ(asked, 0);
  EXPECT_EQ(Made().get<MadeRoute>(), nullptr);
  EXPECT_EQ(made_type<MadeRoute>(), route(1, asked).type());
  EXPECT_FALSE(made_type<MadeRoute>() == made_type<MadeTunnel>());
  EXPECT_FALSE(made_type<MadeRoute>() == MadeType{});
}

TEST(Made, IsEqualToItselfAlone) {
  int asked = 0;
  const Made made = route(2, asked), same = made;
  EXPECT_TRUE(made == same);
  EXPECT_FALSE(made == route(2, asked));
}

TEST(Made, ThreadsThatAskTogetherGetOneObject) {
  ThreadPool pool(4);
  int asked = 0;
  const Made made = route(5, asked);
  std::vector<const MadeRoute*> got(64);
  pool.for_each_chunk(got.size(), 1, [&](std::size_t begin, std::size_t) { got[begin] = made.get<MadeRoute>().get(); });
  for (const MadeRoute* one : got) EXPECT_EQ(one, got.front());
  EXPECT_EQ(asked, 1);
}

}  // namespace
}  // namespace bl
