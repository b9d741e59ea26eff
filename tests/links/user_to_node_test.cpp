// User to node: means by weight, rights and presence by hand, and houses that follow people.
#include <nlohmann/json.hpp>

#include "tests/links/link_case.h"

namespace bl {
namespace {

struct Person {
  std::string id, role;
  double weight = 1, size = 0;
  bool is_present = true;
  std::string unit = "m3";
};

LinkCase choosing(const std::vector<Person>& people) {
  std::vector<Value> ids, roles, weights, present, values;
  for (const Person& person : people) {
    ids.push_back(person.id);
    roles.push_back(person.role);
    weights.push_back(person.weight);
    present.push_back(person.is_present);
    values.push_back(Shared<Table>(Table{{"id", "unit", "value"}, {{std::string("size"), person.unit, person.size}}}));
  }
  LinkCase link("user_to_node");
  link.set("choice", std::string("size"));
  link.read(End::from, "node.id", ids).read(End::from, "user.role", roles).read(End::from, "user.weight", weights);
  link.read(End::from, "user.is_present", present).read(End::from, "user.values", values);
  return link;
}

TEST(UserToNode, OnePersonIsFollowedAndSeveralAreAveragedByWeight) {
  auto one = choosing({{"a", "participant", 0.5, 700}});
  ASSERT_EQ(one.run(), "");
  EXPECT_EQ(one.number(End::to, "target"), 700) << "whatever the weight, where nobody else has a say";
  auto three = choosing({{"a", "participant", 1, 700}, {"b", "designer", 2, 100}, {"c", "participant", 0, 9000}});
  ASSERT_EQ(three.run(), "");
  EXPECT_DOUBLE_EQ(three.number(End::to, "target"), 300);
}

TEST(UserToNode, RolesHaveTheRightAndTheAbsentWait) {
  auto link = choosing({{"a", "participant", 1, 700}, {"b", "viewer", 1, 100}, {"c", "participant", 1, 300, false}});
  ASSERT_EQ(link.run(), "");
  EXPECT_EQ(link.number(End::to, "target"), 700);
  ASSERT_EQ(link.set("only_present", false).run(), "");
  EXPECT_EQ(link.number(End::to, "target"), 500);
  using Texts = Shared<std::vector<std::string>>;
  ASSERT_EQ(link.set("roles", Texts(std::vector<std::string>{"viewer"})).run(), "");
  EXPECT_EQ(link.number(End::to, "target"), 100);
  ASSERT_EQ(link.set("roles", Texts(std::vector<std::string>{"recorder"})).run(), "");
  EXPECT_FALSE(link.proposed(End::to, "target").has_value());
  EXPECT_EQ(link.remarked(LinkRemark::short_of), "from: nobody with the right to it has a say now");
  EXPECT_EQ(link.set("roles", Texts(std::vector<std::string>{"desinger"})).run(),
            "roles/0: there is no role `desinger`, did you mean `designer`?");
}

TEST(UserToNode, SaysWhatItLacks) {
  EXPECT_EQ(choosing({{"a", "participant", 1, 7}}).set("choice", std::string()).run(),
            "choice: no choice is named: write the id of one, such as `height`");
  auto other = choosing({{"a", "participant", 1, 7}, {"b", "designer", 1, 7}});
  ASSERT_EQ(other.set("choice", std::string("height")).run(), "");
  EXPECT_FALSE(other.proposed(End::to, "target").has_value());
  EXPECT_EQ(other.remarked(LinkRemark::short_of), "choice: there is no choice `height` at `a`, `b`");
  EXPECT_EQ(choosing({{"a", "participant", 1, 7}, {"b", "designer", 1, 7, true, "m2"}}).run(),
            "choice: the users have chosen in different units (`m3` and `m2`): give the choice one unit");
}

TEST(UserToNode, SceneFollowsThePeople) {
  World world = World::from_file("scenes/links/user_to_node.json");
  ASSERT_TRUE(world.settle());
  for (const std::string house : {"house_1", "house_2"})
    EXPECT_NEAR(world.number(house, "smart_volume.demand"), (6000 + 2 * 3000) / 3.0, 1e-9);
  EXPECT_EQ(world.number("own_house", "smart_volume.demand"), 2500);
  ASSERT_EQ(world.submit(command<SetPort>({"resident_2", {"user.is_present"}, {"true"}})), "");
  world.tick(3);
  EXPECT_NEAR(world.number("house_1", "smart_volume.demand"), (6000 + 2 * 3000 + 8000) / 4.0, 1e-9);
  // Two people who choose at once change rows of their own.
  ASSERT_EQ(world.submit(command<SetCell>({"resident_1", {"user.choices"}, "own_size", "value", {"3000"}}), "heron"), "");
  world.tick(3);
  EXPECT_EQ(world.number("own_house", "smart_volume.demand"), 3000);
}

}  // namespace
}  // namespace bl
