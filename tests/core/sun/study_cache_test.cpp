// Studies one after the other hand out the bits of fresh ones, measure only what may have changed, and can be refused and
// stopped.
#include "core/sun/study_cache.h"

#include <gtest/gtest.h>

#include "core/base/stop.h"
#include "tests/core/sun/boxes.h"

namespace bl::sun {
namespace {

std::vector<SunMoment> day() { return *sun_moments({}, {2461121, 2461121, 1, 3600, 5}); }

SunCase receiver(const std::string& name, const Point3& centre, bool is_upright = false) {
  SunCase one{name, {}};
  one.receiver.centre = centre;
  one.receiver.spacing = 4;
  one.receiver.required = 7200;
  if (is_upright) upright_axes(12, 8, 200, one.receiver);
  else level_axes(16, 12, 20, one.receiver);
  return one;
}

void expect_fresh(SunStudyCache& cache, const std::vector<SunCaster>& casters, const std::vector<SunMoment>& moments,
                  const std::vector<SunCase>& cases) {
  const auto kept = cache.of(casters, moments, cases, nullptr);
  std::vector<MeshPointer> meshes;
  for (const SunCaster& caster : casters) meshes.push_back(caster.mesh);
  std::vector<SunReceiver> receivers;
  for (const SunCase& one : cases) receivers.push_back(one.receiver);
  const auto fresh = sun_study(meshes, moments, receivers);
  ASSERT_TRUE(kept.ok() && fresh.ok());
  ASSERT_EQ(kept->size(), fresh->size());
  for (std::size_t r = 0; r < kept->size(); ++r) {
    const SunRecord &a = (*kept)[r], &b = (*fresh)[r];
    EXPECT_EQ(a.hours.seconds, b.hours.seconds);
    EXPECT_EQ(a.hours.possible, b.hours.possible);
    EXPECT_EQ(a.deficit, b.deficit);
    EXPECT_EQ(a.share_met, b.share_met);
    ASSERT_EQ(a.hours.casters.size(), casters.size());
    for (std::size_t k = 0; k < casters.size(); ++k) {
      EXPECT_EQ(a.hours.casters[k].lost, b.hours.casters[k].lost);
      EXPECT_EQ(a.hours.casters[k].shared, b.hours.casters[k].shared);
    }
  }
}

TEST(SunStudyCache, GivesTheBitsOfFreshStudiesWhateverWasAskedBefore) {
  Random random(7);
  const auto boxes = random_boxes(60, 3, 150);
  std::vector<SunCaster> casters;
  for (int k = 0; k < 12; ++k) casters.push_back({"c" + std::to_string(k), boxes[static_cast<std::size_t>(k)]});
  std::vector<SunCase> cases;
  for (int r = 0; r < 6; ++r)
    cases.push_back(receiver("r" + std::to_string(r), {random.uniform(-120, 120), random.uniform(-120, 120), 1}, r % 2 == 1));
  SunStudyCache cache;
  std::size_t measured = 0;
  for (int round = 0; round < 40; ++round) {
    const auto k = static_cast<std::size_t>(random.uniform(0, 11.99));
    const int what = static_cast<int>(random.uniform(0, 6));
    if (what == 0) casters[k].mesh = nullptr;
    else if (what == 1) cases[k % 6].receiver.centre.x += 5;
    else if (what == 2) cases[k % 6].receiver.required += 600;
    else if (what == 3) std::swap(casters[k], casters[0]);
    else casters[k].mesh = boxes[static_cast<std::size_t>(random.uniform(0, 59.99))];
    cases[2].receiver.mask.assign(casters.size(), 1);
    cases[2].receiver.mask[static_cast<std::size_t>(round) % casters.size()] = 0;
    expect_fresh(cache, casters, day(), cases);
    if (HasFatalFailure()) return;
    measured += cache.measured();
  }
  EXPECT_LT(measured, 40u * 6 * 3 / 4) << "or nothing was kept";
}

TEST(SunStudyCache, MeasuresOnlyWhatMayHaveChanged) {
  const auto box = [](double x, double y) { return std::make_shared<const Mesh>(box_mesh({x, y, 0}, 10, 10, 20)); };
  std::vector<SunCaster> casters{{"south", box(0, -25)}, {"far", box(400, 0)}};
  std::vector<SunCase> cases{receiver("garden", {0, 0, 0}), receiver("other", {400, 25, 0})};
  SunStudyCache cache;
  const auto measured = [&] {
    EXPECT_TRUE(cache.of(casters, day(), cases, nullptr).ok());
    return cache.measured();
  };
  EXPECT_EQ(measured(), 2u);
  EXPECT_EQ(measured(), 0u);
  cases[0].receiver.required = 100;
  EXPECT_EQ(measured(), 0u);
  casters[0].mesh = box(0, -25);
  EXPECT_EQ(measured(), 0u) << "another mesh of the same shape";
  casters[0].mesh = box(2, -25);
  EXPECT_EQ(measured(), 1u) << "400 m to the side nobody sees it";
  casters.push_back({"north", box(0, 60)});
  EXPECT_EQ(measured(), 0u) << "no sun comes from there";
  casters.pop_back();
  EXPECT_EQ(measured(), 0u);
  casters.erase(casters.begin());
  EXPECT_EQ(measured(), 1u);
  cases.push_back(receiver("new", {0, 10, 0}));
  EXPECT_EQ(measured(), 1u);
}

TEST(SunStudyCache, RefusesTooManyRaysWhateverIsKept) {
  std::vector<SunMoment> moments(60000, {.toward = {0, 0, 1}, .seconds = 1});
  SunCase large = receiver("large", {0, 0, 0});
  level_axes(200, 200, 0, large.receiver);
  large.receiver.spacing = 3.2;  // 63 x 63 points
  SunStudyCache cache;
  const auto refused = cache.of({}, moments, std::vector<SunCase>{large}, nullptr);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::out_of_range);
  EXPECT_EQ(refused.error().place, "receivers");
  EXPECT_NE(refused.error().message.find("would follow 238 million rays, and at most 200 million"), std::string::npos)
      << refused.error().message;
}

TEST(SunStudyCache, AStoppedStudyIsCancelledAndNothingOfItKept) {
  const std::vector<SunCase> cases{receiver("a", {0, 0, 0}), receiver("b", {30, 0, 0})};
  SunStudyCache cache;
  {
    const StopScope scope([] { return true; });
    const auto stopped = cache.of({}, day(), cases, nullptr);
    ASSERT_FALSE(stopped.ok());
    EXPECT_EQ(stopped.error().code, ErrorCode::cancelled);
  }
  expect_fresh(cache, {}, day(), cases);
  EXPECT_EQ(cache.measured(), 2u);
}

}  // namespace
}  // namespace bl::sun
