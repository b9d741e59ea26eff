// gzip by zlib's inflate; several members behind each other are one text, as gzip has it.
#include "core/exchange/inflate.h"

#include <zlib.h>

#include <array>

#include "core/base/stop_check.h"
#include "core/exchange/context_shape.h"

namespace bl {

Result<std::string> unpacked(std::string_view bytes, std::size_t limit) {
  const auto refused = [](const char* name) {
    return Error{ErrorCode::parse, "",
                 std::string("The file is packed with ") + name + ", which is not read: unpack it, or pack it with gzip."};
  };
  if (bytes.starts_with("BZh")) return refused("bzip2");
  if (bytes.starts_with("\xFD"
                        "7zXZ"))
    return refused("xz");
  if (bytes.starts_with("PK\x03\x04")) return refused("zip");
  if (!bytes.starts_with("\x1F\x8B")) return std::string(bytes);
  std::string text;
  std::array<char, 1 << 16> chunk;
  z_stream stream{};
  if (inflateInit2(&stream, 15 + 16) != Z_OK) return Error{ErrorCode::internal, "", "zlib could not be started."};
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  int state = Z_OK;
  while (text.size() <= limit) {
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
  const std::size_t read = stream.total_in;
  inflateEnd(&stream);
  if (text.size() > limit)
    return Error{ErrorCode::out_of_range, "",
                 "The file unpacks to more than " + std::to_string(limit >> 20) +
                     " MiB, the most that is read: cut out the part that you need."};
  if (state != Z_STREAM_END)
    return Error{ErrorCode::parse, "byte " + std::to_string(read),
                 "The packed file is damaged or cut off here: fetch or pack it again."};
  return text;
}

}  // namespace bl
