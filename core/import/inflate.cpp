// gzip by zlib's inflate; several members behind each other are one text, as gzip has it.
#include "core/import/inflate.h"

#include <zlib.h>

#include <array>

#include "core/base/packed_kind.h"
#include "core/base/stop_check.h"
#include "core/import/context_shape.h"

namespace bl::importing {

namespace {

// Kinds of text that people make pack to a tenth, sparse grids to a hundredth; what packs to a thousandth was made for that.
constexpr std::size_t kMostPacked = 200;          // bytes for each byte of the file,
constexpr std::size_t kNeverTooMuch = 64u << 20;  // from so many on [bytes]

bool is_too_much(std::size_t size, std::size_t packed, std::size_t limit) {
  return size > limit || (size > kNeverTooMuch && size / kMostPacked > packed);
}

}  // namespace

Error too_large_unpacked(std::size_t limit) {
  return {ErrorCode::out_of_range, "",
          "The file unpacks to more than " + std::to_string(limit >> 20) +
              " MiB, the most that is read: cut out the part that you need."};
}

Result<std::string> unpacked(std::string_view bytes, std::size_t limit) {
  if (bytes == "\x1F") return Error{ErrorCode::parse, "byte 1", "The packed file is cut off here: fetch or pack it again."};
  if (!bytes.starts_with("\x1F\x8B")) {
    if (auto refusal = packed_refusal(bytes)) return *refusal;
    return std::string(bytes);
  }
  const auto refusal = [&](std::size_t size) {
    if (size > limit) return too_large_unpacked(limit);
    return Error{ErrorCode::out_of_range, "",
                 "The file unpacks to more than " + std::to_string(kMostPacked) +
                     " times its size, as no map, model or table does: it is not read. Unpack it first if it is one."};
  };
  std::string text;
  std::array<char, 1 << 16> chunk;
  z_stream stream{};
  if (inflateInit2(&stream, 15 + 16) != Z_OK) return Error{ErrorCode::internal, "", "zlib could not be started."};
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  int state = Z_OK;
  const auto packed = [&] { return bytes.size() - stream.avail_in; };  // of what is unpacked so far
  while (!is_too_much(text.size(), packed(), limit)) {
    if (is_stop_wished()) {
      inflateEnd(&stream);
      return stopped_error();
    }
    stream.next_out = reinterpret_cast<Bytef*>(chunk.data());
    stream.avail_out = static_cast<uInt>(chunk.size());
    state = inflate(&stream, Z_NO_FLUSH);
    text.append(chunk.data(), chunk.size() - stream.avail_out);
    if (state == Z_STREAM_END) {
      // Padding of zeros may follow; another member begins with its own mark.
      while (stream.avail_in > 0 && *stream.next_in == 0) ++stream.next_in, --stream.avail_in;
      if (stream.avail_in == 0 || inflateReset(&stream) != Z_OK) break;
      continue;
    }
    if (state != Z_OK) break;
  }
  const std::size_t read = packed();
  inflateEnd(&stream);
  if (is_too_much(text.size(), read, limit)) return refusal(text.size());
  if (state != Z_STREAM_END)
    return Error{ErrorCode::parse, "byte " + std::to_string(read),
                 "The packed file is damaged or cut off here: fetch or pack it again."};
  return text;
}

}  // namespace bl::importing
