// Packing by zlib.
#include "core/journal/packed.h"

#include <zlib.h>

#include <algorithm>

#include "core/base/hash.h"

namespace bl::journal {

namespace {

constexpr std::int64_t kMostText = std::int64_t{1} << 30;  // as files have it [bytes]
// Fast: texts are packed while people work, and level 9 makes them a twentieth smaller at three times the time.
constexpr int kLevel = 6;

std::string digest_of(std::string_view text) {
  Hash hash;
  hash.add(text);
  return hash.hex();
}

}  // namespace

Packed pack(std::string_view text) {
  Packed packed{.bytes = {}, .size = static_cast<std::int64_t>(text.size()), .digest = digest_of(text)};
  uLongf size = compressBound(text.size());
  packed.bytes.resize(size);
  // It fails only where there is too little room or memory, or where the level is none.
  compress2(reinterpret_cast<Bytef*>(packed.bytes.data()), &size, reinterpret_cast<const Bytef*>(text.data()), text.size(),
            kLevel);
  packed.bytes.resize(size);
  return packed;
}

Result<std::string> unpack(const Packed& packed) {
  const Error damaged{ErrorCode::parse, "", "the packed text is damaged"};
  // zlib packs to a thousandth at most: a size beyond that was never true, and nothing is laid out for it.
  if (packed.size < 0 || packed.size > kMostText || packed.size / 1100 > static_cast<std::int64_t>(packed.bytes.size()))
    return damaged;
  std::string text(static_cast<std::size_t>(std::max<std::int64_t>(packed.size, 1)), '\0');
  uLongf size = text.size();
  const int state = uncompress(reinterpret_cast<Bytef*>(text.data()), &size, reinterpret_cast<const Bytef*>(packed.bytes.data()),
                               packed.bytes.size());
  if (state != Z_OK || static_cast<std::int64_t>(size) != packed.size) return damaged;
  text.resize(size);
  if (digest_of(text) != packed.digest) return damaged;
  return text;
}

}  // namespace bl::journal
