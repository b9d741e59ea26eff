// OBJ texts, byte by byte.
#include <gtest/gtest.h>

#include <memory>

#include "core/export/wavefront_obj.h"

namespace bl::exporting {
namespace {

TEST(WavefrontObj, ObjectsShareOneCount) {
  const auto triangle = std::make_shared<const Mesh>(Mesh{{{0, 0, 0}, {1, 0, 0}, {0, 0.1, 1e-20}}, {{0, 1, 2}}});
  const std::vector<NamedMesh> meshes = {
      {"shop", triangle}, {"starved", nullptr}, {"shop", triangle}, {"two words\no evil", triangle}};
  EXPECT_EQ(write_obj(meshes),
            "# BehaviourLinks: lengths in metres, z up\n"
            "o shop\nv 0 0 0\nv 1 0 0\nv 0 0.1 1e-20\nf 1 2 3\n"
            "# starved: no shape\n"
            "# shop\no shop_2\nv 0 0 0\nv 1 0 0\nv 0 0.1 1e-20\nf 4 5 6\n"
            "# two words o evil\no two_words_o_evil\nv 0 0 0\nv 1 0 0\nv 0 0.1 1e-20\nf 7 8 9\n");
}

TEST(WavefrontObj, ANoteIsOneLineOfTheHeader) {
  EXPECT_EQ(write_obj({}, "coarse\nmeshes"), "# BehaviourLinks: lengths in metres, z up\n# coarse meshes\n");
}

}  // namespace
}  // namespace bl::exporting
