// Meshes that are made when somebody looks, and the measure of a mesh.
#include "core/base/mesh.h"

#include <atomic>
#include <mutex>

namespace bl {

// What copies share. By hand instead of std::call_once, which the thread sanitizer leaves locked when making throws.
struct MeshPointer::Lazy {
  explicit Lazy(std::unique_ptr<MeshRecipe> how) : recipe(std::move(how)), depth(recipe->depth()) {}

  void make_coarse() {
    if (has_coarse.load(std::memory_order_acquire)) return;
    const std::lock_guard lock(mutex);
    make_coarse_alone();
  }
  void make() {
    if (is_made.load(std::memory_order_acquire)) return;
    const std::lock_guard lock(mutex);
    if (is_made.load(std::memory_order_relaxed)) return;
    make_coarse_alone();
    Mesh made = recipe->make();
    made.coarse = coarse;
    mesh = std::move(made);
    recipe.reset();
    is_made.store(true, std::memory_order_release);
  }

  Mesh mesh;
  std::shared_ptr<const Mesh> coarse;
  std::atomic<bool> is_made = false, has_coarse = false;
  std::unique_ptr<MeshRecipe> recipe;  // let go when nothing is left to be made
  const int depth;
  std::mutex mutex;

 private:
  void make_coarse_alone() {
    if (has_coarse.load(std::memory_order_relaxed)) return;
    coarse = recipe->make_coarse();
    has_coarse.store(true, std::memory_order_release);
  }
};

MeshPointer::MeshPointer(std::unique_ptr<MeshRecipe> recipe) {
  const auto lazy = std::make_shared<Lazy>(std::move(recipe));
  mesh_ = std::shared_ptr<const Mesh>(lazy, &lazy->mesh);
  lazy_ = lazy.get();
}

void MeshPointer::make() const { lazy_->make(); }

const std::shared_ptr<const Mesh>& MeshPointer::coarse() const {
  static const std::shared_ptr<const Mesh> none;
  if (lazy_ == nullptr) return mesh_ ? mesh_->coarse : none;
  lazy_->make_coarse();
  return lazy_->coarse;
}

bool MeshPointer::has_depth(int depth) const {
  if (lazy_ != nullptr) return lazy_->depth == depth;
  return mesh_ && mesh_->coarse && mesh_->triangles.size() == mesh_->coarse->triangles.size() << (2 * depth);
}

bool MeshPointer::is_made() const { return lazy_ == nullptr || lazy_->is_made.load(std::memory_order_acquire); }

bool MeshPointer::is_coarse_made() const { return lazy_ == nullptr || lazy_->has_coarse.load(std::memory_order_acquire); }

double enclosed_volume(const Mesh& mesh) {
  if (mesh.vertices.empty()) return 0;
  // Relative to a vertex of the mesh: far from the origin the determinants would cancel.
  const Point3 origin = mesh.vertices.front();
  double six_volumes = 0;
  for (const auto& t : mesh.triangles) {
    const Vector3 a = mesh.vertices[t[0]] - origin, b = mesh.vertices[t[1]] - origin, c = mesh.vertices[t[2]] - origin;
    six_volumes += dot(a, cross(b, c));
  }
  return six_volumes / 6;
}

}  // namespace bl
