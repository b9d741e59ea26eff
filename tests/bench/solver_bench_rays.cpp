// Rows of rays to the sun: how many a second among boxes, against a loop over all triangles in the same run.
#include <algorithm>
#include <cmath>
#include <memory>

#include "core/base/hash.h"
#include "core/base/random.h"
#include "core/sun/shadow_scene.h"
#include "core/sun/sun_place.h"
#include "core/sun/triangle_hit.h"
#include "tests/bench/solver_bench_rows.h"

namespace bl::cli::bench {

namespace {

struct Ray {
  Point3 origin;
  Vector3 toward;
};

Mesh upright_box(const Point3& foot, double width, double depth, double height) {
  Mesh box;
  for (const double z : {foot.z, foot.z + height})
    for (const auto& [x, y] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}})
      box.vertices.push_back({foot.x + x * width, foot.y + y * depth, z});
  box.triangles = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}};
  for (std::uint32_t i = 0, j = 1; i < 4; ++i, j = (i + 1) % 4) {
    box.triangles.push_back({i, j, j + 4});
    box.triangles.push_back({i, j + 4, i + 4});
  }
  return box;
}

// As many boxes as a town of that size has: 30 m from one to the next.
std::vector<MeshPointer> town(int count) {
  Random random(20070);
  const double reach = 15 * std::sqrt(static_cast<double>(count));
  std::vector<MeshPointer> boxes;
  for (int i = 0; i < count; ++i)
    boxes.push_back(
        std::make_shared<const Mesh>(upright_box({random.uniform(-reach, reach), random.uniform(-reach, reach), 0},
                                                 random.uniform(8, 20), random.uniform(8, 20), random.uniform(4, 40))));
  return boxes;
}

std::vector<Ray> rays_over(int boxes, std::size_t count) {
  Random random(7);
  const double reach = 15 * std::sqrt(static_cast<double>(boxes));
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < count; ++i)
    rays.push_back({{random.uniform(-reach, reach), random.uniform(-reach, reach), 0},
                    scene_direction(sun::SunPlace{}, random.uniform(90, 270), random.uniform(10, 60))});
  return rays;
}

// All boxes in the way, each asked triangle by triangle until one is met.
void plain_loop(const std::vector<MeshPointer>& boxes, const Ray& ray, std::vector<std::uint32_t>& found) {
  const sun::RayTest test(ray.origin, ray.toward);
  found.clear();
  for (std::uint32_t k = 0; k < boxes.size(); ++k)
    for (const auto& [a, b, c] : boxes[k]->triangles)
      if (test.meets(boxes[k]->vertices[a], boxes[k]->vertices[b], boxes[k]->vertices[c], sun::ShadowScene::kStart)) {
        found.push_back(k);
        break;
      }
}

using Answers = std::vector<std::vector<std::uint32_t>>;

Result<void> measure_rays(const SolverBench& bench, int count, BenchTable& table) {
  const auto boxes = town(count);
  const auto scene = sun::ShadowScene::build(boxes);
  if (!scene) return scene.error();
  const double triangles = static_cast<double>(scene->triangles());
  // The same few rays again and again would be known to the processor; the loop takes its time over fewer of them.
  const auto rays = rays_over(count, 20000);
  const auto looped = static_cast<std::size_t>(std::min(2e4, std::max(200.0, 2e7 / triangles)));
  Answers wanted(looped), found(rays.size());
  const std::vector<int> threads = bench.threads();
  std::vector<std::unique_ptr<ThreadPool>> pools;
  std::vector<Contender> contenders;
  for (const int number : threads) {
    ThreadPool* pool = pools.emplace_back(std::make_unique<ThreadPool>(number)).get();
    contenders.push_back({[&, pool] {
                            pool->for_each_chunk(rays.size(), 64, [&](std::size_t begin, std::size_t end) {
                              for (std::size_t i = begin; i < end; ++i) scene->blockers(rays[i].origin, rays[i].toward, found[i]);
                            });
                          },
                          {},
                          {}});
  }
  contenders.push_back({[&] {
                          for (std::size_t i = 0; i < looped; ++i) plain_loop(boxes, rays[i], wanted[i]);
                        },
                        {},
                        {}});
  take_turns(contenders, bench.rounds, bench.turn_seconds,
             [&] { return bench.goes_on("rays among " + std::to_string(count) + " boxes"); });
  if (!bench.goes_on("")) return Error{ErrorCode::cancelled, "", "stopped"};
  std::size_t shaded = 0, differ = 0;
  Hash hash;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    shaded += found[i].empty() ? 0 : 1;
    if (i < looped) differ += found[i] != wanted[i] ? 1 : 0;
    for (const std::uint32_t box : found[i]) hash.add(static_cast<std::uint64_t>(box));
    hash.add(static_cast<std::uint64_t>(found[i].size()));
  }
  const double number = static_cast<double>(rays.size());
  const double in_loop = static_cast<double>(looped) / contenders.back().median.of(1);
  for (std::size_t t = 0; t < threads.size(); ++t) {
    const double seconds = contenders[t].median.of(threads[t]);
    table.add({figure(static_cast<std::size_t>(count)), figure(scene->triangles()), figure(static_cast<std::size_t>(threads[t])),
               figure(rays.size()), figure(100 * static_cast<double>(shaded) / number, 1), figure(looped),
               figure(number / seconds, 0), figure(in_loop, 0), figure(number / seconds / in_loop, 1), figure(differ),
               word(hex_digits(hash.value()))});
  }
  return {};
}

}  // namespace

BenchTables bench_rays(const SolverBench& bench) {
  BenchTable table{
      "rays",
      "Rays from the ground of a town to the sun: all boxes in the way, against a loop over all triangles with the same test",
      {{"boxes", "sites"},
       {"triangles", "triangles"},
       {"threads", "threads"},
       {"rays", "rays"},
       {"shaded %", "shaded_percent"},
       {"looped", "looped_rays"},
       {"rays/s", "rays_per_second"},
       {"loop rays/s", "loop_rays_per_second"},
       {"times", "times_the_loop"},
       {"differ", "differing_rays"},
       {"hash", "hash", true}}};
  for (const int count : bench.sites({10, 100, 1000, 10000}, {100}))
    if (auto done = measure_rays(bench, count, table); !done) return done.error();
  return std::vector<BenchTable>{table};
}

}  // namespace bl::cli::bench
