// Frames from the network, as a page might send them: nothing crashes, a refused operation changes nothing, and each is answered
// once.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/file/scene_file.h"
#include "core/room/room.h"
#include "core/wire/operations.h"
#include "tests/fuzz/frame_mutator.h"
#include "tests/fuzz/require.h"

namespace {

using namespace bl;
using bl::fuzz::require;

constexpr const char* kScene = R"({"format": "behaviourlinks", "version": 1, "nodes": [
  {"id": "a", "types": {"smart_volume": {"demand": 900}}}, {"id": "b", "types": {"smart_volume": {}}},
  {"id": "card", "types": {"stakeholder_group": {}}}, {"id": "poll", "types": {"vote": {"kind": "yes_no"}}}],
  "links": [{"id": "l", "kind": "keep_distance", "from": "a", "to": "b"}]})";

const Scene& start() {
  static const Scene kStart = read_scene(kScene, full_registry()).scene;
  return kStart;
}

// Made anew for each input, so that an input that finds something finds it again by itself; and only for those that get so far,
// because it takes longer than to refuse a frame that is none.
struct World {
  explicit World(const Scene& scene)
      : ledger(full_registry(), scene), room(ledger, {.random = [](std::size_t n) { return std::string(n, 'k'); }}) {
    for (const Role role : {Role::facilitator, Role::designer, Role::participant})
      (void)room.admit({.role = role, .areas = {}, .card = "card"}, {0, 0});
  }
  Ledger ledger;
  room::Room room;
};

// Told at the end, because an input is a session of many frames.
struct Count {
  ~Count() { std::fprintf(stderr, "%lld frames were read, and %lld operations of them answered\n", frames, operations); }
  long long frames = 0, operations = 0;
};

}  // namespace

// A whole room is built and thrown away for each input: with all that address sanitizers keep of freed memory by default, most of
// the time goes into fresh pages, and into the stacks of those who have asked for them.
extern "C" const char* __asan_default_options() { return "quarantine_size_mb=8:malloc_context_size=8"; }

// Choosing inputs by how rare their paths are costs more than these inputs themselves: ten of them took the time of a hundred. To
// name the functions that an input is the first to reach takes a minute. Long inputs judge more frames for each room that is
// made.
extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments) {
  static char choice[] = "-entropic=0", names[] = "-print_funcs=0", length[] = "-max_len=16384";
  static std::vector<char*> all(*arguments, *arguments + *count);
  for (char* option : {choice, names, length})
    all.insert(all.begin() + 1, option);  // what the caller says comes later, and counts
  all.push_back(nullptr);
  *arguments = all.data();
  *count = static_cast<int>(all.size()) - 1;
  return 0;
}

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  if (seed % 2 == 0) return LLVMFuzzerMutate(data, size, most);
  bl::fuzz::FrameMutator mutator(start(), seed);
  const std::string text = seed % 16 == 1 ? mutator.session(most) : mutator.changed({reinterpret_cast<const char*>(data), size});
  // Half a frame would be refused for its form alone.
  if (text.size() > most) return LLVMFuzzerMutate(data, size, most);
  std::copy(text.begin(), text.end(), data);
  return text.size();
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static Count count;
  std::optional<World> made;
  std::string_view text(reinterpret_cast<const char*>(data), size);
  // Each line is a frame of the next seat.
  for (std::int64_t seat = 1; !text.empty(); seat = seat % 3 + 1) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const auto frame = wire::read_frame(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    ++count.frames;
    if (!frame || !wire::is_operation((*frame)["t"].get<std::string>())) continue;
    World& world = made ? *made : made.emplace(start());
    const std::string run = "run " + std::to_string(seat);
    room::Operation operation = wire::read_operation(*frame, run);
    operation.id = world.room.greet(seat, run, 0) + 1;
    const Scene before = world.ledger.scene();  // shares all that does not change, so that it costs nothing to compare
    const room::Answer answer = world.room.submit(seat, operation, {0, 0});
    if (std::holds_alternative<room::Refusal>(answer)) require(world.ledger.scene() == before, "a refusal changed the scene");
    require(world.room.submit(seat, operation, {0, 0}) == answer, "the same operation got two answers");
    (void)wire::read_frame(wire::write_answer(operation.id, answer));
    (void)world.room.take_record();
    ++count.operations;
  }
  return 0;
}
