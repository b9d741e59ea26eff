// A scene to test in: loaded, changed by commands, ticked, and read by name.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "core/session/session.h"

namespace bl {

/// A value of a state by node id and "typification.port"; ends the test program with a sentence where there is none.
const Value& value_in(const State& state, std::string_view node, std::string_view path);

/// The content of a file named from the root of the project.
std::string project_file(std::string_view path_from_root);

/// A batch of the list that a log or a script has as text.
Command batch_of_text(const std::string& list);

class World {
 public:
  /// A scene that cannot be loaded ends the test program with its first error.
  static World from_text(std::string_view scene_json, int threads = 1);
  static World from_file(std::string_view path_from_root, int threads = 1);

  void tick(int count = 1);
  /// Ticks until the scene has settled, at most `most` times.
  bool settle(int most = 500);

  double number(std::string_view node, std::string_view path) const;
  Vector3 point(std::string_view node, std::string_view path) const;
  std::string text(std::string_view node, std::string_view path) const;
  const Table& table(std::string_view node, std::string_view path) const;
  MeshPointer mesh(std::string_view node, std::string_view path) const;
  double tension(std::string_view node, std::string_view path) const;
  /// "" or "place: message".
  std::string node_error(std::string_view node, std::string_view typification) const;
  std::string link_error(std::string_view id) const;

  /// "" or the error's text.
  std::string submit(const Command& command, const std::string& author = "test");
  Session& session() { return *session_; }
  const State& state() const { return *session_->state(); }

 private:
  std::unique_ptr<Session> session_;
};

}  // namespace bl
