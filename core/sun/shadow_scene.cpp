// Embree finds the few triangles near a ray; whether one is met is decided in doubles, so that no order, tree or processor
// matters.
#include "core/sun/shadow_scene.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/sun/triangle_hit.h"

namespace bl::sun {

namespace {

struct Triangle {
  Point3 a, b, c;
  std::uint32_t caster = 0;
};

// What a search carries through Embree; it hands the context on to our callback.
struct Search {
  RTCIntersectContext context;
  const std::vector<Triangle>* triangles = nullptr;
  const RayTest* ray = nullptr;
  ShadowScene::Mask mask;
  std::vector<std::uint32_t>* found = nullptr;
};

}  // namespace

struct ShadowScene::Content {
  std::vector<Triangle> triangles;
  std::size_t casters = 0;
  Point3 centre;      // single precision counts from here
  double radius = 0;  // of a ball around all triangles
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  Content() = default;
  Content(const Content&) = delete;
  Content& operator=(const Content&) = delete;
  ~Content() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }

  Result<void> build_tree();
  void search(const Point3& origin, const Vector3& toward, Search& search) const;
};

namespace {

float rounded_down(double x) { return std::nextafterf(static_cast<float>(x), -std::numeric_limits<float>::infinity()); }
float rounded_up(double x) { return std::nextafterf(static_cast<float>(x), std::numeric_limits<float>::infinity()); }

// The box of a triangle, widened by more than single precision can lose on a ray that crosses the whole scene.
void box_of(const RTCBoundsFunctionArguments* args) {
  const auto& content =
      *static_cast<const std::pair<const std::vector<Triangle>*, std::pair<Point3, double>>*>(args->geometryUserPtr);
  const Triangle& triangle = (*content.first)[args->primID];
  const auto& [centre, margin] = content.second;
  const auto low = [&](double a, double b, double c, double from) { return rounded_down(std::min({a, b, c}) - from - margin); };
  const auto high = [&](double a, double b, double c, double from) { return rounded_up(std::max({a, b, c}) - from + margin); };
  const auto& [a, b, c, caster] = triangle;
  RTCBounds& box = *args->bounds_o;
  box.lower_x = low(a.x, b.x, c.x, centre.x);
  box.lower_y = low(a.y, b.y, c.y, centre.y);
  box.lower_z = low(a.z, b.z, c.z, centre.z);
  box.upper_x = high(a.x, b.x, c.x, centre.x);
  box.upper_y = high(a.y, b.y, c.y, centre.y);
  box.upper_z = high(a.z, b.z, c.z, centre.z);
}

// Never says that the ray is stopped, so that Embree goes on to all triangles along it.
void judge(const RTCOccludedFunctionNArguments* args) {
  if (args->valid[0] == 0) return;
  Search& search = *reinterpret_cast<Search*>(args->context);
  const Triangle& triangle = (*search.triangles)[args->primID];
  if (!search.mask.empty() && search.mask[triangle.caster] == 0) return;
  std::vector<std::uint32_t>& found = *search.found;
  if (std::find(found.begin(), found.end(), triangle.caster) != found.end()) return;
  if (search.ray->meets(triangle.a, triangle.b, triangle.c, ShadowScene::kStart)) found.push_back(triangle.caster);
}

Error embree_error() {
  return {ErrorCode::internal, "", "the ray tracing library could not be started: too little memory is left"};
}

}  // namespace

Result<void> ShadowScene::Content::build_tree() {
  // One thread of its own: our pool runs the rays, and the tree must not depend on how many there are.
  device = rtcNewDevice("threads=1,user_threads=0");
  if (device == nullptr) return embree_error();
  scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  std::pair<const std::vector<Triangle>*, std::pair<Point3, double>> boxes{&triangles, {centre, 4e-6 * radius}};
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(triangles.size()));
  rtcSetGeometryUserData(geometry, &boxes);
  rtcSetGeometryBoundsFunction(geometry, box_of, nullptr);
  rtcSetGeometryOccludedFunction(geometry, judge);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
  if (rtcGetDeviceError(device) != RTC_ERROR_NONE) return embree_error();
  return {};
}

// The ray that Embree follows is in single precision, and starts where it enters the ball around everything, so that no point is
// too far away for that.
void ShadowScene::Content::search(const Point3& origin, const Vector3& toward, Search& search) const {
  const Vector3 from = origin - centre;
  const double nearest = -dot(from, toward), missed = squared_norm(from) - nearest * nearest, reach = 1.01 * radius;
  if (missed > reach * reach) return;
  const double half = std::sqrt(reach * reach - missed);
  if (nearest + half < 0) return;
  const Vector3 start = from + toward * std::max(0.0, nearest - half);
  RTCRay ray{};
  ray.org_x = static_cast<float>(start.x);
  ray.org_y = static_cast<float>(start.y);
  ray.org_z = static_cast<float>(start.z);
  ray.dir_x = static_cast<float>(toward.x);
  ray.dir_y = static_cast<float>(toward.y);
  ray.dir_z = static_cast<float>(toward.z);
  ray.tnear = 0;
  ray.tfar = std::numeric_limits<float>::infinity();
  ray.mask = ~0u;
  rtcInitIntersectContext(&search.context);
  search.triangles = &triangles;
  rtcOccluded1(scene, &search.context, &ray);
}

Result<ShadowScene> ShadowScene::build(std::span<const MeshPointer> casters) {
  auto content = std::make_shared<Content>();
  content->casters = casters.size();
  Point3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  for (std::size_t k = 0; k < casters.size(); ++k) {
    if (!casters[k]) continue;
    const Mesh& mesh = *casters[k];
    for (const Point3& vertex : mesh.vertices) {
      if (!is_finite(vertex))
        return Error{ErrorCode::not_finite, std::to_string(k), "a corner of the mesh is no finite point: repair the mesh"};
      low = {std::min(low.x, vertex.x), std::min(low.y, vertex.y), std::min(low.z, vertex.z)};
      high = {std::max(high.x, vertex.x), std::max(high.y, vertex.y), std::max(high.z, vertex.z)};
    }
    for (const auto& [a, b, c] : mesh.triangles)
      content->triangles.push_back({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c], static_cast<std::uint32_t>(k)});
  }
  ShadowScene made;
  if (!content->triangles.empty()) {
    content->centre = (low + high) * 0.5;
    content->radius = std::max(1e-3, 0.5 * distance(low, high));
    if (auto built = content->build_tree(); !built) return built.error();
  }
  made.content_ = std::move(content);
  return made;
}

void ShadowScene::blockers(const Point3& origin, const Vector3& toward, std::vector<std::uint32_t>& found, Mask mask) const {
  found.clear();
  if (content_->triangles.empty()) return;
  const RayTest ray(origin, toward);
  Search search{};
  search.ray = &ray;
  search.mask = mask;
  search.found = &found;
  content_->search(origin, toward, search);
  std::sort(found.begin(), found.end());
}

std::size_t ShadowScene::casters() const { return content_->casters; }
std::size_t ShadowScene::triangles() const { return content_->triangles.size(); }

}  // namespace bl::sun
