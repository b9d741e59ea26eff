// The closed bodies of core/sun without their ends.
#include "ui/desktop/view/shade.h"

#include <cmath>

#include "core/sun/shadow_shape.h"

namespace bl::desktop {

namespace {

// Cosine between a wall's normal and the rays: walls stand along them.
constexpr double kAlong = 1e-6;

// The lit side lies in the caster's own faces and the lower end in the ground: both are drawn already.
Mesh walls_of(Mesh body, const Vector3& toward, double ground) {
  std::erase_if(body.triangles, [&](const auto& t) {
    const Point3 &a = body.vertices[t[0]], &b = body.vertices[t[1]], &c = body.vertices[t[2]];
    const Vector3 normal = cross(b - a, c - a);
    const bool is_lit = dot(normal, toward) > kAlong * norm(normal);
    return is_lit || (a.z == ground && b.z == ground && c.z == ground);
  });
  return body;
}

}  // namespace

ShadeStore::Made& ShadeStore::made_for(const CasterFacts& caster, const Vector3& toward) {
  Made& made = made_[caster.id];
  if (made.of == caster.mesh && made.toward == toward && made.ground == caster.ground) return made;
  made = {caster.mesh, toward, caster.ground, nullptr, sun::shadow_outline(*caster.mesh, toward, caster.ground)};
  return made;
}

std::vector<ShadeBody> ShadeStore::bodies(const std::vector<CasterFacts>& casters, const Vector3& toward) {
  std::vector<ShadeBody> found;
  for (const CasterFacts& caster : casters) {
    Made& made = made_for(caster, toward);
    if (made.outline.empty()) continue;
    if (!made.walls)
      made.walls =
          std::make_shared<const Mesh>(walls_of(sun::shadow_volume(*caster.mesh, toward, caster.ground), toward, caster.ground));
    found.push_back({caster.node, caster.id, made.walls, made.outline});
  }
  return found;
}

std::vector<RingFacts> ShadeStore::outlines(const std::vector<CasterFacts>& casters, const Vector3& toward) {
  std::vector<RingFacts> found;
  for (const CasterFacts& caster : casters)
    if (const Made& made = made_for(caster, toward); !made.outline.empty())
      found.push_back({caster.node, caster.id, made.outline, false});
  return found;
}

}  // namespace bl::desktop
