// Axonometric pictures by the painter's way: far triangles first.
#include "ui/desktop/panels/scene_pictures.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <numbers>
#include <span>
#include <thread>

#include "core/file/file_io.h"
#include "core/reading/report_model.h"
#include "core/reading/views/node.h"
#include "core/session/session.h"
#include "core/traffic/street_line.h"
#include "ui/desktop/view/colouring.h"
#include "ui/desktop/view/urban_facts.h"

namespace bl::desktop {

namespace {

// Enough for weights to find their places; positions go on a little longer, which a picture of this size does not show.
constexpr int kTicks = 24;
constexpr std::size_t kMostTriangles = 30000;

struct Projected {
  double x, y, depth;
};

// Seen from the south-west and above; z up becomes y down.
Projected project(const Point3& p) {
  constexpr double kTurn = 0.6, kTilt = 0.62;
  const double right = std::cos(kTurn) * p.x + std::sin(kTurn) * p.y, away = -std::sin(kTurn) * p.x + std::cos(kTurn) * p.y;
  return {right, -(away * std::sin(kTilt) + p.z * std::cos(kTilt)), away * std::cos(kTilt) - p.z * std::sin(kTilt)};
}

struct Piece {
  Projected corners[3];
  double depth, shade;
  std::size_t colour;
};

// A ball of so many triangles as a small picture shows, for a volume whose shape nobody has.
Mesh ball(const Point3& centre, double radius) {
  constexpr int kRings = 6, kSides = 10;
  Mesh mesh;
  for (int ring = 0; ring <= kRings; ++ring)
    for (int side = 0; side < kSides; ++side) {
      const double down = std::numbers::pi * ring / kRings, around = 2 * std::numbers::pi * side / kSides;
      mesh.vertices.push_back(
          centre + radius * Vector3{std::sin(down) * std::cos(around), std::sin(down) * std::sin(around), std::cos(down)});
    }
  const auto corner = [](int ring, int side) { return static_cast<std::uint32_t>(ring * kSides + side % kSides); };
  for (int ring = 0; ring < kRings; ++ring)
    for (int side = 0; side < kSides; ++side) {
      if (ring > 0) mesh.triangles.push_back({corner(ring, side), corner(ring + 1, side), corner(ring, side + 1)});
      if (ring + 1 < kRings)
        mesh.triangles.push_back({corner(ring, side + 1), corner(ring + 1, side), corner(ring + 1, side + 1)});
    }
  return mesh;
}

void add_pieces(const Mesh& mesh, std::size_t colour, std::vector<Piece>& pieces) {
  const Vector3 light = Vector3{-0.45, -0.3, 0.84};
  for (const auto& triangle : mesh.triangles) {
    const Point3 &a = mesh.vertices[triangle[0]], &b = mesh.vertices[triangle[1]], &c = mesh.vertices[triangle[2]];
    const Vector3 normal = cross(b - a, c - a);
    const double length = norm(normal);
    Piece piece{{project(a), project(b), project(c)}, 0, 0, colour};
    const auto& k = piece.corners;
    const bool is_seen = (k[1].x - k[0].x) * (k[2].y - k[0].y) - (k[1].y - k[0].y) * (k[2].x - k[0].x) < 0;
    if (!is_seen || !(length > 0)) continue;
    piece.depth = k[0].depth + k[1].depth + k[2].depth;
    piece.shade = 0.55 + 0.45 * dot(normal, light) / length;
    pieces.push_back(piece);
  }
}

std::vector<Piece> pieces_of(const State& state, const reading::ReportModel& model) {
  const UseNumbers numbers(state.plan->scene);
  std::vector<Piece> pieces;
  for (const reading::VolumeRow& row : model.volumes) {
    const double radius = row.figures.radius;
    if (row.mesh) add_pieces(*row.mesh, numbers.tone(row.use), pieces);
    else if (row.volume > 0 && radius > 0) add_pieces(ball(row.figures.position, radius), numbers.tone(row.use), pieces);
  }
  std::stable_sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.depth > b.depth; });
  return pieces;
}

}  // namespace

namespace {

using Lines = std::vector<std::vector<Projected>>;

Lines ground_lines(const reading::ReportModel& model) {
  Lines lines;
  for (const reading::SiteRow& site : model.sites)
    for (const geometry::Polyline& line : site.ground) {
      lines.emplace_back();
      for (const Point3& point : line.points) lines.back().push_back(project({point.x, point.y, site.bottom}));
    }
  return lines;
}

Lines street_lines(const State& state) {
  Lines lines;
  for (const StreetFacts& street : read_urban(state, nullptr).streets) {
    const auto place = [&](std::uint32_t node) { return reading::read<&reading::NodePlace::position>(state, node); };
    lines.emplace_back();
    for (const Point3& point : traffic::street_line(place(street.start), street.course, place(street.end)))
      lines.back().push_back(project(point));
  }
  return lines;
}

}  // namespace

ScenePicture picture_of(const State& state) {
  reading::ReportModel model;
  reading::read_model(state, model);
  ScenePicture picture;
  picture.title = model.title;
  picture.about = model.about;
  picture.volumes = model.volumes.size();
  const std::vector<Piece> pieces = pieces_of(state, model);
  const Lines grounds = ground_lines(model), streets = street_lines(state);
  double low_x = 1e300, high_x = -1e300, low_y = 1e300, high_y = -1e300;
  auto include = [&](const Projected& p) {
    low_x = std::min(low_x, p.x), high_x = std::max(high_x, p.x), low_y = std::min(low_y, p.y), high_y = std::max(high_y, p.y);
  };
  for (const Piece& piece : pieces)
    for (const Projected& corner : piece.corners) include(corner);
  for (const Lines* lines : {&grounds, &streets})
    for (const auto& line : *lines)
      for (const Projected& corner : line) include(corner);
  const double size = std::max({high_x - low_x, high_y - low_y, 1e-9});
  auto x_of = [&](const Projected& p) { return static_cast<float>(0.5 + (p.x - 0.5 * (low_x + high_x)) / size); };
  auto y_of = [&](const Projected& p) { return static_cast<float>(0.5 + (p.y - 0.5 * (low_y + high_y)) / size); };
  for (const auto& [lines, drawn] : {std::pair(&grounds, &picture.grounds), std::pair(&streets, &picture.streets)})
    for (const auto& line : *lines) {
      drawn->emplace_back();
      for (const Projected& corner : line) drawn->back().emplace_back(x_of(corner), y_of(corner));
    }
  // Where there are too many, the farthest go: they are the most covered.
  const std::size_t first = pieces.size() - std::min(pieces.size(), kMostTriangles);
  for (const Piece& piece : std::span(pieces).subspan(first)) {
    PictureTriangle triangle{{}, {}, static_cast<float>(piece.shade), piece.colour};
    for (int k = 0; k < 3; ++k) {
      triangle.x[k] = x_of(piece.corners[k]);
      triangle.y[k] = y_of(piece.corners[k]);
    }
    picture.triangles.push_back(triangle);
  }
  picture.is_ready = true;
  return picture;
}

struct ScenePictures::Worker {
  const Registry& registry;
  mutable std::mutex mutex;
  std::vector<std::shared_ptr<const ScenePicture>> pictures;
  std::atomic<bool> is_ending = false, is_done = false;
  std::thread thread;

  explicit Worker(const Registry& all) : registry(all) {}

  void make(std::size_t k) {
    const std::string path = pictures[k]->path;
    const auto text = read_file(path);
    if (!text) return;
    const SceneReading reading = read_scene(*text, registry);
    if (!reading.is_usable()) return;
    auto session = Session::start(registry, reading.scene, reading.state ? &*reading.state : nullptr, 1);
    if (!session) return;
    for (int tick = 0; tick < kTicks && !is_ending; ++tick) (*session)->tick();
    auto picture = std::make_shared<ScenePicture>(picture_of(*(*session)->state()));
    picture->path = path;
    const std::lock_guard lock(mutex);
    pictures[k] = std::move(picture);
  }
};

ScenePictures::ScenePictures(const Registry& registry, std::vector<std::string> paths)
    : worker_(std::make_unique<Worker>(registry)) {
  Worker& worker = *worker_;
  for (std::string& path : paths) {
    auto empty = std::make_shared<ScenePicture>();
    empty->path = std::move(path);
    worker.pictures.push_back(std::move(empty));
  }
  worker.thread = std::thread([&worker] {
    for (std::size_t k = 0; k < worker.pictures.size() && !worker.is_ending; ++k) {
      try {
        worker.make(k);
      } catch (const std::exception&) {
        // A scene without a picture can be opened all the same, and then says what is wrong.
      }
    }
    worker.is_done = true;
  });
}

ScenePictures::~ScenePictures() {
  worker_->is_ending = true;
  worker_->thread.join();
}

bool ScenePictures::is_done() const { return worker_->is_done; }

std::vector<std::shared_ptr<const ScenePicture>> ScenePictures::pictures() const {
  const std::lock_guard lock(worker_->mutex);
  return worker_->pictures;
}

}  // namespace bl::desktop
