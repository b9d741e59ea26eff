// The self-test runs solver, sun, traffic, a script and a formula, because each of them has arithmetic of its own.
#include "core/host/self_test.h"

#include <gnu/libc-version.h>

#include <nlohmann/json.hpp>

#include "core/base/hash.h"
#include "core/base/text.h"
#include "core/define/json_text.h"
#include "core/define/schema.h"
#include "core/file/scene_file.h"
#include "core/session/session.h"

namespace bl::host {

namespace {

constexpr int kTicks = 30;

constexpr const char* kScene = R"scene({
  "format": "behaviourlinks", "version": 1, "settings": {"title": "Self-test"},
  "scripts": [{"id": "sway", "lines": [
    "return {", "  id = \"sway\", label = \"Sway\", doc = \"Moves a node to and fro.\",", "  params = {},",
    "  reads = {here = {at = \"to\", port = \"node.position\", unit = \"m\"}},",
    "  proposes = {move = {at = \"to\", port = \"node.position\", unit = \"m\"}},",
    "  evaluate = function(params, ends, tick)",
    "    local a = math.sin(tick / 7) * math.exp(-tick / 50)",
    "    return {move = point(a, math.cos(ends.here.x) * 0.3, 0)}", "  end,", "}"]}],
  "nodes": [
    {"id": "garden", "position": [26, 38, 0], "types": {"shadow_receiver": {"width": 24, "depth": 16, "spacing": 4}}},
    {"id": "hall", "position": [48, 12, 6], "types": {"shadow_caster": {}, "smart_volume": {"demand": 4000}}},
    {"id": "house", "position": [12, 12, 6], "types": {"shadow_caster": {}, "smart_volume": {"demand": 2500}}},
    {"id": "tower", "position": [30, 12, 14], "types": {"shadow_caster": {}, "smart_volume": {"demand": 9000}}},
    {"id": "plot", "types": {"boundary": {"form": "plan", "plan": [[0, 0, 0], [60, 3, 0], [57, 24, 0], [0, 24, 0]], "height": 40}}},
    {"id": "solver", "types": {"smart_volumes_solver": {}}},
    {"id": "study", "types": {"sun_study": {}}},
    {"id": "sun", "types": {"sun_and_sky": {"first_date": "2026-02-01", "last_date": "2026-03-31", "day_step": 14}}},
    {"id": "rent", "types": {"expression": {"formula": "sin(a) * exp(b) + a ^ 1.7", "a": 1.3, "b": 0.4}}},
    {"id": "j1", "types": {"junction": {}, "traffic_zone": {"trips_out": 700, "trips_in": 80}}},
    {"id": "j2", "position": [150, 0, 0], "types": {"junction": {}, "traffic_zone": {"trips_out": 60, "trips_in": 500}}},
    {"id": "j3", "position": [150, 120, 0], "types": {"junction": {}, "traffic_zone": {"trips_out": 100, "trips_in": 280}}},
    {"id": "s1", "types": {"street": {"start": "j1", "end": "j2", "capacity_per_lane": 300}}},
    {"id": "s2", "types": {"street": {"start": "j2", "end": "j3", "capacity_per_lane": 400}}},
    {"id": "s3", "types": {"street": {"start": "j1", "end": "j3", "capacity_per_lane": 350}}},
    {"id": "network", "types": {"traffic_network": {"distribution": "doubly"}}}
  ],
  "links": [
    {"id": "near", "kind": "adjacency", "from": "hall", "to": "tower"},
    {"id": "sways", "kind": "sway", "from": "house", "to": "house"}
  ]
})scene";

std::string fingerprint_now() {
  const SceneReading reading = read_scene(kScene, full_registry());
  if (!reading.is_usable()) return "unusable: " + reading.first_error().text();
  auto session = Session::start(full_registry(), reading.scene, nullptr, 1);
  if (!session) return "unusable: " + session.error().text();
  for (int tick = 0; tick < kTicks; ++tick) (*session)->tick();
  return hex_digits((*session)->state()->hash);
}

std::string build_now() {
  Hash types;
  types.add(write_json_line(scene_schema(full_registry(), settings_type(), kSceneVersion)));
  return "state-" + std::to_string(kHashScheme) + " types-" + types.hex() + " compiler-" + __VERSION__ + " libc-" +
         gnu_get_libc_version();
}

}  // namespace

const SelfTest& self_test() {
  static const SelfTest kSelf{build_now(), fingerprint_now()};
  return kSelf;
}

}  // namespace bl::host
