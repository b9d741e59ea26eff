// Meshes that are made by the first who looks: once for all copies, never for those who only pass them on.
#include <new>
#include <stdexcept>

#include <gtest/gtest.h>

#include "core/base/mesh.h"
#include "core/base/parallel.h"

namespace bl {
namespace {

struct Counts {
  int alive = 0, coarse = 0, made = 0;
};

// A triangle that is split once; making it fails as often as `failures` says.
class CountedRecipe : public MeshRecipe {
 public:
  explicit CountedRecipe(Counts& counts, int failures = 0, bool has_coarse = true)
      : counts_(counts), failures_(failures), has_coarse_(has_coarse) {
    ++counts_.alive;
  }
  ~CountedRecipe() override { --counts_.alive; }

  std::shared_ptr<const Mesh> make_coarse() override {
    fail();
    ++counts_.coarse;
    if (!has_coarse_) return nullptr;
    return std::make_shared<const Mesh>(Mesh{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}, {{0, 1, 2}}, std::make_shared<const MeshWrap>()});
  }
  Mesh make() override {
    fail();
    ++counts_.made;
    return {{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}}};
  }
  int depth() const override { return 1; }

 private:
  void fail() {
    if (failures_-- > 0) throw std::bad_alloc();
  }
  Counts& counts_;
  int failures_ = 0;
  bool has_coarse_ = true;
};

MeshPointer counted(Counts& counts, int failures = 0, bool has_coarse = true) {
  return MeshPointer(std::make_unique<CountedRecipe>(counts, failures, has_coarse));
}

TEST(MeshPointer, NothingIsMadeForWhoDoesNotLook) {
  Counts counts;
  {
    const MeshPointer mesh = counted(counts), same = mesh;
    EXPECT_TRUE(mesh && same == mesh && mesh != nullptr && mesh.has_recipe());
    EXPECT_FALSE(mesh == counted(counts));
    EXPECT_TRUE(mesh.has_depth(1));
    EXPECT_FALSE(mesh.has_depth(0) || mesh.is_made() || mesh.is_coarse_made());
  }
  EXPECT_EQ(counts.coarse + counts.made, 0);
  EXPECT_EQ(counts.alive, 0);
}

TEST(MeshPointer, TheFirstWhoLooksHasItMadeForAllCopies) {
  Counts counts;
  const MeshPointer mesh = counted(counts), same = mesh;
  EXPECT_EQ(same->triangles.size(), 4u);
  EXPECT_TRUE(mesh.is_made() && mesh.is_coarse_made());
  EXPECT_EQ(&*mesh, &*same);
  EXPECT_TRUE(mesh == same && mesh.has_depth(1));
  EXPECT_EQ(mesh->coarse, same.coarse());
  EXPECT_EQ(counts.coarse, 1);
  EXPECT_EQ(counts.made, 1);
  EXPECT_EQ(counts.alive, 0) << "what it was made from goes";
}

TEST(MeshPointer, TheCoarseMeshIsHadWithoutTheRest) {
  Counts counts;
  const MeshPointer mesh = counted(counts);
  const std::shared_ptr<const Mesh> coarse = mesh.coarse();
  ASSERT_NE(coarse, nullptr);
  EXPECT_EQ(&whole_cell(mesh), coarse.get());
  EXPECT_TRUE(mesh.is_coarse_made() && !mesh.is_made());
  EXPECT_EQ(counts.made, 0);
  EXPECT_EQ(mesh->coarse, coarse);
  EXPECT_EQ(counts.coarse, 1);
}

TEST(MeshPointer, AMeshWithoutACoarseOneIsItsOwnWholeCell) {
  Counts counts;
  const MeshPointer mesh = counted(counts, 0, false);
  EXPECT_EQ(mesh.coarse(), nullptr);
  EXPECT_EQ(&whole_cell(mesh), &*mesh);
  EXPECT_EQ(mesh->coarse, nullptr);
  EXPECT_EQ(counts.coarse, 1);
}

TEST(MeshPointer, AMeshThatIsThereIsEqualToItself) {
  const auto coarse = std::make_shared<const Mesh>(Mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}});
  auto changeable = std::make_shared<Mesh>(*coarse);
  changeable->coarse = coarse;
  const MeshPointer mesh = changeable, same = std::shared_ptr<const Mesh>(changeable);
  EXPECT_TRUE(mesh == same && mesh.is_made() && mesh.is_coarse_made() && mesh.has_depth(0));
  EXPECT_FALSE(mesh == MeshPointer(std::make_shared<const Mesh>(*changeable)) || mesh.has_recipe() || mesh.has_depth(1));
  EXPECT_EQ(mesh.coarse(), coarse);
  const MeshPointer none;
  EXPECT_TRUE(none == nullptr && !none && none == MeshPointer(std::shared_ptr<const Mesh>()) && none.coarse() == nullptr);
  EXPECT_FALSE(none.has_depth(0) || none == mesh);
}

TEST(MeshPointer, WhatWasTakenFromSomewhereIsThereNoLonger) {
  Counts counts;
  MeshPointer mesh = counted(counts), taken = std::move(mesh);
  EXPECT_TRUE(mesh == nullptr && mesh.coarse() == nullptr && !mesh.has_recipe());  // NOLINT: looked at on purpose
  EXPECT_TRUE(taken && taken.has_recipe());
  mesh = std::move(taken);
  EXPECT_TRUE(taken == nullptr && taken.coarse() == nullptr && !taken.has_recipe());  // NOLINT
  EXPECT_EQ(mesh->triangles.size(), 4u);
  mesh = nullptr;
  EXPECT_EQ(mesh, MeshPointer());
}

TEST(MeshPointer, WhoeverLooksAfterAFailureTriesAgain) {
  Counts counts;
  const MeshPointer mesh = counted(counts, 2);
  EXPECT_THROW((void)mesh.coarse(), std::bad_alloc);
  EXPECT_FALSE(mesh.is_coarse_made());
  EXPECT_THROW((void)*mesh, std::bad_alloc);
  EXPECT_EQ(mesh->triangles.size(), 4u);
  EXPECT_EQ(counts.coarse, 1);
  EXPECT_EQ(counts.made, 1);
}

TEST(MeshPointer, ThreadsThatLookTogetherGetOneMesh) {
  ThreadPool pool(4);
  for (int round = 0; round < 50; ++round) {
    Counts counts;
    const MeshPointer mesh = counted(counts, round % 2);
    std::vector<const Mesh*> coarse(64), got(64);
    pool.for_each_chunk(got.size(), 1, [&](std::size_t begin, std::size_t) {
      const MeshPointer own = mesh;
      for (int attempt = 0; attempt < 2 && got[begin] == nullptr; ++attempt) try {
          if (begin % 2 == 0) coarse[begin] = own.coarse().get();
          got[begin] = &*own;
          coarse[begin] = own.coarse().get();
        } catch (const std::bad_alloc&) {}
    });
    for (std::size_t k = 0; k < got.size(); ++k) {
      ASSERT_EQ(got[k], &*mesh);
      ASSERT_EQ(coarse[k], mesh->coarse.get());
    }
    EXPECT_EQ(counts.coarse, 1);
    EXPECT_EQ(counts.made, 1);
    EXPECT_EQ(counts.alive, 0);
  }
}

}  // namespace
}  // namespace bl
