// Compares what two ways of evaluating a scene come to.
#include "tests/support/every_tick.h"

namespace bl {

namespace {

std::string failures_of(const State& state) {
  std::string text;
  for (std::uint32_t n = 0; n < state.nodes.size(); ++n)
    for (const TypeState& type : state.nodes[n].types)
      if (type.error) text += type.error->text() + "\n";
  for (const LinkState& link : state.links)
    for (const auto& said : {link.error, link.work})
      if (said) text += said->text() + "\n";
  return text;
}

}  // namespace

void expect_same(const State& changed, const State& everything) {
  ASSERT_EQ(changed.hash, everything.hash);
  EXPECT_EQ(changed.calm, everything.calm);
  EXPECT_EQ(changed.largest_move, everything.largest_move);
  EXPECT_EQ(changed.largest_change, everything.largest_change);
  EXPECT_EQ(changed.largest_residual, everything.largest_residual);
  EXPECT_EQ(changed.is_settled(), everything.is_settled());
  EXPECT_EQ(failures_of(changed), failures_of(everything));
  for (std::uint32_t n = 0; n < changed.nodes.size(); ++n)
    for (std::size_t t = 0; t < changed.nodes[n].types.size(); ++t)
      ASSERT_EQ(changed.nodes[n].types[t].tension, everything.nodes[n].types[t].tension) << changed.plan->nodes[n].id;
}

}  // namespace bl
