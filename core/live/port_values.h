// Reading what people have set at a node of a scene, without the types of nodes.
#pragma once

#include "core/graph/scene.h"

namespace bl {

/// What is set of a typification; nullptr where the node does not carry it.
inline const PortValues* values_of(const NodeRecord& node, const char* type) {
  const auto found = node.types.find(type);
  return found != node.types.end() ? &found->second : nullptr;
}

template <class T>
T value_of(const PortValues& values, const char* port, T otherwise) {
  const auto found = values.find(port);
  const T* content = found != values.end() ? std::get_if<T>(&found->second) : nullptr;
  return content != nullptr ? *content : otherwise;
}

}  // namespace bl
