// Feeds bytes to the scene reader; what it accepts must save, load again, run and be saved in mid-run.
#include <cstdint>

#include "core/session/session.h"
#include "tests/fuzz/require.h"

namespace {

using bl::fuzz::require;

// Work is bounded, so that the fuzzer looks for faults and not for patience.
bool is_small(const bl::Scene& scene) { return scene.nodes.size() <= 40 && scene.links.size() <= 20; }

void run(const bl::SceneReading& reading) {
  auto session = bl::Session::start(bl::full_registry(), reading.scene, reading.state ? &*reading.state : nullptr, 1);
  if (!session) return;
  for (int i = 0; i < 2; ++i) (*session)->tick();
  const bl::SavedState saved = bl::save(*(*session)->state());
  const std::string text = bl::write_scene(reading.scene, bl::full_registry(), &saved);
  const bl::SceneReading again = bl::read_scene(text, bl::full_registry());
  require(again.is_usable(), "a scene saved in mid-run cannot be loaded");
  auto loaded = bl::Session::start(bl::full_registry(), again.scene, &*again.state, 1);
  require(loaded.ok(), "a saved state does not fit its own scene");
  require((*loaded)->state()->hash == (*session)->state()->hash, "the hash differs after saving and loading");
  (*session)->tick();
  (*loaded)->tick();
  require((*loaded)->state()->hash == (*session)->state()->hash, "a tick differs after saving and loading");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const bl::SceneReading reading = bl::read_scene(text, bl::full_registry());
  if (!reading.is_usable()) {
    require(!reading.first_error().message.empty(), "an error without a sentence");
    return 0;
  }
  const std::string saved = bl::write_scene(reading.scene, bl::full_registry());
  const bl::SceneReading again = bl::read_scene(saved, bl::full_registry());
  require(again.is_usable(), "a saved scene cannot be loaded");
  require(again.scene == reading.scene, "a scene changes by saving and loading");
  require(bl::write_scene(again.scene, bl::full_registry()) == saved, "the text of a scene changes by saving and loading");
  if (is_small(reading.scene)) run(reading);
  return 0;
}
