// Small scenes as text, for the tests of single typifications.
#pragma once

#include <string>

namespace bl {

/// A scene file that holds these nodes, given as JSON objects with commas between them.
inline std::string scene_text(const std::string& nodes) {
  return R"({"format": "behaviourlinks", "version": 1, "settings": {}, "nodes": [)" + nodes + "]}";
}

/// A scene with one node `it` of one typification.
inline std::string one_node(const std::string& typification, const std::string& ports) {
  return scene_text(R"({"id": "it", "types": {")" + typification + R"(": {)" + ports + "}}}");
}

/// A node with a position and one typification.
inline std::string node_text(const std::string& id, const std::string& position, const std::string& typification,
                             const std::string& ports = "") {
  return R"({"id": ")" + id + R"(", "position": )" + position + R"(, "types": {")" + typification + R"(": {)" + ports + "}}}";
}

}  // namespace bl
