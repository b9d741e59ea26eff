// Folding blocks of four words.
#include "core/base/long_text.h"

namespace bl {

namespace {

// Eight characters, the first one lowest, on every machine.
std::uint64_t word_at(std::string_view text, std::size_t at) {
  std::uint64_t word = 0;
  for (std::size_t k = 0; k < 8; ++k) word |= static_cast<std::uint64_t>(static_cast<unsigned char>(text[at + k])) << (8 * k);
  return word;
}

}  // namespace

void TextLanes::add(std::string_view blocks) {
  for (std::size_t at = 0; at + kBlock <= blocks.size(); at += kBlock)
    for (std::size_t lane = 0; lane < lanes_.size(); ++lane) lanes_[lane].add(word_at(blocks, at + 8 * lane));
}

void TextLanes::finish(Hash& hash, std::size_t length, std::string_view rest) const {
  hash.add(static_cast<std::uint64_t>(length));
  for (const Hash& lane : lanes_) hash.add(lane.value());
  hash.add(rest);
}

void add_table_text(Hash& hash, std::string_view text) {
  if (text.size() < kLongText) return hash.add(text);
  TextLanes lanes;
  const std::size_t whole = text.size() / TextLanes::kBlock * TextLanes::kBlock;
  lanes.add(text.substr(0, whole));
  lanes.finish(hash, text.size(), text.substr(whole));
}

}  // namespace bl
