// New inputs for the fuzzer of frames: whole frames with commands and events of the registries, beside changed bytes.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/base/random.h"
#include "core/define/codec.h"
#include "core/room/event_builder.h"
#include "tests/support/random_commands.h"
#include "tests/support/random_values.h"

namespace bl::fuzz {

/// Bytes that are changed at random are seldom JSON, and a changed name is seldom that of a command. So every other input is
/// changed by whole frames, which fit the scene as it was at the beginning.
class FrameMutator {
 public:
  FrameMutator(const Scene& scene, std::uint64_t seed) : scene_(&scene), random_(seed) {}

  /// One line of the text is replaced, put before another, taken away, or gets another value somewhere.
  std::string changed(std::string_view text) {
    std::vector<std::string> lines = lines_of(text);
    if (lines.empty()) lines.push_back(frame());
    const std::size_t at = random_.below(lines.size());
    const auto line = lines.begin() + static_cast<std::ptrdiff_t>(at);
    switch (random_.below(6)) {
      case 0: lines[at] = frame(); break;
      case 1: lines.erase(line); break;
      case 2: lines.insert(line, lines[random_.below(lines.size())]); break;
      case 3: lines[at] = with_another_value(lines[at]); break;
      default: lines.insert(line, frame());
    }
    std::string all;
    for (const std::string& one : lines) all += one + "\n";
    return all;
  }

  /// As many new frames as fit.
  std::string session(std::size_t most) {
    std::string all;
    for (std::string line = frame() + "\n"; all.size() + line.size() <= most; line = frame() + "\n") all += line;
    return all;
  }

 private:
  static std::vector<std::string> lines_of(std::string_view text) {
    std::vector<std::string> lines;
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      lines.emplace_back(text.substr(0, end));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    return lines;
  }

  std::string frame() {
    Json json = {{"t", "op"}, {"id", 1}};
    const std::string draft = random_.below(2) == 0 ? "d" : "";
    switch (random_.below(8)) {
      case 0: json["t"] = random_.below(2) == 0 ? "undo" : "redo"; break;
      case 1: json["t"] = "rewind", json["to"] = random_.below(6); break;
      case 2: {
        constexpr const char* kDeeds[] = {"begin", "undo", "drop"};
        json["t"] = "draft", json["draft"] = "d", json["do"] = kDeeds[random_.below(3)];
        break;
      }
      case 3:
      case 4: json["t"] = "room", json["e"] = event(); break;
      default:
        json["c"] = command_to_json(full_registry(), random_command(*scene_, random_, static_cast<int>(random_.below(9))));
        if (!draft.empty()) json["draft"] = draft;
    }
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
  }

  Json event() {
    const room::EventKinds& kinds = room::event_kinds();
    const auto kind = std::next(kinds.begin(), static_cast<std::ptrdiff_t>(random_.below(kinds.size())));
    Json arguments = Json::object();
    for (const PortDefinition& port : kind->second.ports)
      if (random_.below(4) != 0)
        arguments[port.id] = random_.below(2) == 0 ? value() : value_to_json(random_value(port, random_), port);
    return {{"event", kind->first}, {"arguments", arguments}};
  }

  /// Ids and numbers that something in the room may have, and what fits nowhere.
  Json value() {
    static const Json kValues = Json::parse(
        R"(["a", "b", "card", "poll", "l", "c", "d", "n", "seat 1", "seat 2", "yes", "", "designer", "participant", 0, 1, 2, 3, -1,
            0.5, 1e300, 9007199254740993, true, false, null, [], {}, ["a"], {"ids": ["a"]}, {"tag": "x"}, [[0, 0], [1, 0]],
            {"smart_volume.demand": {"min": 0, "max": 900, "step": 10}}])");
    return kValues[random_.below(kValues.size())];
  }

  std::string with_another_value(const std::string& line) {
    const Json json = Json::parse(line, nullptr, false);
    if (!json.is_structured() || json.empty()) return frame();
    const Json flat = json.flatten();
    const std::string place = std::next(flat.begin(), static_cast<std::ptrdiff_t>(random_.below(flat.size()))).key();
    Json changed = json;
    changed[Json::json_pointer(place)] = value();
    return changed.dump(-1, ' ', false, Json::error_handler_t::replace);
  }

  const Scene* scene_;
  Random random_;
};

}  // namespace bl::fuzz
