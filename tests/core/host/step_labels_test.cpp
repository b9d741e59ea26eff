// Labels of steps that say more than the name of their command.
#include <gtest/gtest.h>

#include "core/host/step_labels.h"
#include "tests/support/world.h"

namespace bl::host {
namespace {

TEST(StepLabels, CastingAndWithdrawingAVoteDoNotNameTheVoter) {
  World world = World::from_text(
      R"({"format": "behaviourlinks", "version": 1, "nodes": [{"id": "poll", "name": "Height", "types": {"vote": {}}}]})");
  const auto label = [&](const JsonValue& ballot) {
    return label_of_step(full_registry(), command<CastVote>({"poll", "otter", ballot}), world.session().scene());
  };
  EXPECT_EQ(label({"\"yes\""}), "Cast vote · Height");
  EXPECT_EQ(label(JsonValue::null()), "Withdraw vote · Height");
}

}  // namespace
}  // namespace bl::host
