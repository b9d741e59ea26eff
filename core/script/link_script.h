// A link kind that people wrote in Lua: declaration and evaluate in one text, made an ordinary LinkDefinition.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/define/registry.h"

namespace bl::script {

/// What a script may use. Counted, not timed, so that a script is stopped at the same place on every machine.
struct ScriptLimits {
  /// Instructions of the Lua machine in one evaluation, and in all evaluations of one link in one tick.
  static constexpr std::int64_t kInstructions = 500'000, kInstructionsPerTick = 2'000'000;
  /// Memory taken in one evaluation, given back or not, and by all evaluations of one link in one tick [byte].
  static constexpr std::size_t kMemory = std::size_t{4} << 20, kMemoryPerTick = std::size_t{256} << 20;
  /// The largest text, and the largest piece of memory (a table of 16 384 numbers) [byte].
  static constexpr std::size_t kText = std::size_t{4} << 10, kPiece = std::size_t{256} << 10;
  /// Values on the stack: what all calls that are under way hold and hand on. One instruction may copy all of them. Twice as many
  /// would be more than kPiece, which is how more are refused.
  static constexpr int kStack = 8192;
  /// Names that a table can have at the usual price; with n times as many, each instruction counts for n.
  static constexpr std::size_t kNames = 256;
  /// The largest script [byte].
  static constexpr std::size_t kSource = std::size_t{256} << 10;
};

/// Reads a script. `name` is what its errors call it, as in "name.lua:12: ..."; `types` has the ports that it may name. The
/// definition can be evaluated from several threads at once, and gives the same bits whoever asks.
Result<LinkDefinition> read_link_script(const std::string& name, std::string_view text, const Registry& types);

}  // namespace bl::script
