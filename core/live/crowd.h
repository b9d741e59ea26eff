// People who walk through a hall: a recorded table of their places, and the commands by which a sensor follows them.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/address/live_address.h"
#include "core/base/vector.h"
#include "core/graph/scene.h"
#include "core/reading/views/stream.h"
#include "core/session/commands.h"

namespace bl::live {

/// A row of the table: where somebody is from then on; without a place, they are gone.
struct WalkStep {
  double seconds = 0;
  std::string person;
  std::optional<Vector3> place;  ///< in plan [m]
};

/// The rows in the order of their times. Rows that cannot be read are errors with their line.
Result<std::vector<WalkStep>> read_walk(std::string_view text, const address::LiveAddress& address);

/// What a sensor of people owns: the nodes whose ids begin with its own and `#`. It knows them from the scene, so that it goes on
/// after a return to another moment, and never touches a node of anybody else.
class Crowd {
 public:
  /// Another address or scene; `walk` is read once for each address.
  void follow(const std::string& sensor, const reading::PeopleFigures& wanted, const Scene& scene);
  void set_walk(Result<std::vector<WalkStep>> walk);
  /// What has to be said for the tick after `tick`; nothing where nobody has moved. One command.
  std::optional<Command> step(std::int64_t tick) const;

  std::string sensor, address, line;  ///< `line`: what is wrong with the table
  std::size_t rows() const { return walk_.size(); }
  std::size_t played(std::int64_t tick) const;

 private:
  std::map<std::string, Vector3> people_at(std::int64_t tick) const;

  reading::PeopleFigures wanted_;
  std::vector<WalkStep> walk_;
  std::map<std::string, Vector3> there_;  // by node: as the scene has them
};

}  // namespace bl::live
