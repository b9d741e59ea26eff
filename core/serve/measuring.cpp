// The clock is only read here: nothing that is computed depends on it.
#include "core/serve/measuring.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "core/define/registry.h"
#include "core/host/clock.h"
#include "core/journal/journal.h"
#include "core/session/commands.h"
#include "core/session/session.h"

namespace bl::serve {

namespace {

namespace fs = std::filesystem;

// A file of ours that is gone when the measuring is over, whatever became of it; with what SQLite lays beside it.
class TrialFile {
 public:
  explicit TrialFile(const std::string& folder)
      : path_((fs::path(folder.empty() ? "." : folder) / (".check_" + std::to_string(::getpid()) + ".blsession")).string()) {}
  ~TrialFile() {
    std::error_code ignored;
    for (const char* ending : {"", "-wal", "-shm", "-journal"}) fs::remove(path_ + ending, ignored);
  }
  TrialFile(const TrialFile&) = delete;
  TrialFile& operator=(const TrialFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

struct Volume {
  std::string id;
  Vector3 position;
};

// None where the scene has no volume.
Volume first_volume(const Scene& scene) {
  for (const auto& [id, node] : scene.nodes) {
    if (!node.types.contains("smart_volume")) continue;
    Volume volume{id, {}};
    const PortValues& set = node.types.at("node");
    if (const auto position = set.find("position"); position != set.end())
      if (const auto* point = std::get_if<Vector3>(&position->second)) volume.position = *point;
    return volume;
  }
  return {};
}

// A volume that may not be moved stays where it is; what the tick takes then is what it takes.
void move_volume(Session& session, const Volume& volume, bool is_away) {
  constexpr double kStep = 0.5;  // [m]
  const Vector3& at = volume.position;
  const JsonValue place = JsonValue::of({at.x + (is_away ? kStep : 0), at.y, at.z});
  (void)session.submit(command<SetPort>({volume.id, {"node.position"}, place}), {"check", AuthorKind::program});
}

}  // namespace

Durations durations_of(std::vector<double> seconds) {
  std::sort(seconds.begin(), seconds.end());
  return {seconds[seconds.size() / 2], seconds.back(), seconds.size()};
}

Result<Durations> measure_commits(const std::string& folder, int count) {
  const TrialFile file(folder);
  auto journal = journal::Journal::create(file.path(), journal::RoomRow{.code = "TRLS", .title = "Check"}, full_registry(), {});
  if (!journal) return journal.error();
  std::vector<double> times;
  for (int k = 1; k <= count; ++k) {
    const journal::HashRow row{.seq = 0, .tick = k, .hash = "0123456789abcdef"};
    const double began = host::real_clock().now();
    if (auto stored = (*journal)->add_hashes(std::span(&row, 1)); !stored) return stored.error();
    times.push_back(host::real_clock().now() - began);
  }
  if (auto closed = (*journal)->close(); !closed) return closed.error();
  return durations_of(std::move(times));
}

Result<Durations> measure_ticks(const Scene& scene, double seconds) {
  constexpr std::size_t kLeast = 3;
  auto session = Session::start(full_registry(), scene, nullptr, 1);
  if (!session) return session.error();
  (*session)->tick();
  const Volume volume = first_volume(scene);
  std::vector<double> times;
  const double end = host::real_clock().now() + seconds;
  while (times.size() < kLeast || host::real_clock().now() < end) {
    if (!volume.id.empty()) move_volume(**session, volume, times.size() % 2 == 0);
    const double began = host::real_clock().now();
    (*session)->tick();
    times.push_back(host::real_clock().now() - began);
  }
  return durations_of(std::move(times));
}

}  // namespace bl::serve
