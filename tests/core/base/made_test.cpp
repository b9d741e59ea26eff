// Made objects: made once and only when asked for, told apart by type, equal by identity.
#include "core/base/made.h"

#include <gtest/gtest.h>

#include "core/base/parallel.h"

namespace bl {
namespace {

struct Cake {
  static constexpr std::string_view kMadeName = "a cake";
  int layers = 0;
};
struct Bread {
  static constexpr std::string_view kMadeName = "a bread";
};

Made cake(int layers, int& asked) {
  return Made::of<Cake>([layers, &asked] {
    ++asked;
    return std::make_shared<const Cake>(Cake{layers});
  });
}

TEST(Made, IsMadeOnceAndOnlyWhenSomebodyAsks) {
  int asked = 0;
  const Made made = cake(3, asked), same = made;
  EXPECT_EQ(asked, 0);
  EXPECT_EQ(made.get<Cake>()->layers, 3);
  EXPECT_EQ(same.get<Cake>(), made.get<Cake>());
  EXPECT_EQ(asked, 1);
}

TEST(Made, IsNothingForWhoAsksForAnotherType) {
  int asked = 0;
  EXPECT_EQ(cake(1, asked).get<Bread>(), nullptr);
  EXPECT_EQ(asked, 0);
  EXPECT_EQ(Made().get<Cake>(), nullptr);
  EXPECT_EQ(made_type<Cake>(), cake(1, asked).type());
  EXPECT_FALSE(made_type<Cake>() == made_type<Bread>());
  EXPECT_FALSE(made_type<Cake>() == MadeType{});
}

TEST(Made, IsEqualToItselfAlone) {
  int asked = 0;
  const Made made = cake(2, asked), same = made;
  EXPECT_TRUE(made == same);
  EXPECT_FALSE(made == cake(2, asked));
}

TEST(Made, ThreadsThatAskTogetherGetOneObject) {
  ThreadPool pool(4);
  int asked = 0;
  const Made made = cake(5, asked);
  std::vector<const Cake*> got(64);
  pool.for_each_chunk(got.size(), 1, [&](std::size_t begin, std::size_t) { got[begin] = made.get<Cake>().get(); });
  for (const Cake* one : got) EXPECT_EQ(one, got.front());
  EXPECT_EQ(asked, 1);
}

}  // namespace
}  // namespace bl
