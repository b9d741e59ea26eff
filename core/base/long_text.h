// How long texts go into a hash: as four hashes side by side, because one waits for its last word before each.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/base/hash.h"

namespace bl {

/// Texts of tables are folded side by side from here on, such as the rows of a terrain: a million cells are read in every tick
/// [characters].
inline constexpr std::size_t kLongText = 256;

/// The four hashes of a long text.
class TextLanes {
 public:
  static constexpr std::size_t kBlock = 32;  ///< characters that all lanes take together

  /// A whole number of blocks.
  void add(std::string_view blocks);
  /// Ends a text of so many characters with what was left of it behind the last whole block.
  void finish(Hash& hash, std::size_t length, std::string_view rest) const;

 private:
  std::array<Hash, 4> lanes_;
};

/// Folds a text of a table into a hash.
void add_table_text(Hash& hash, std::string_view text);

}  // namespace bl
