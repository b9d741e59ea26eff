// Protobuf by hand, as far as two numbers need it: the length of each block, and its length once unpacked.
#include "core/import/pbf_blocks.h"

#include <cstdint>
#include <optional>
#include <string>

#include "core/import/inflate.h"

namespace bl::importing {

namespace {

// The fields of one protobuf message: numbers are read, all else is passed over.
class ProtobufFields {
 public:
  explicit ProtobufFields(std::string_view bytes) : rest_(bytes) {}

  // The number of the wanted field; nothing where it is not there, or the bytes are no message.
  std::optional<std::uint64_t> number(std::uint64_t wanted) {
    while (!rest_.empty()) {
      const auto key = varint();
      if (!key) return std::nullopt;
      const std::uint64_t kind = *key & 7;
      if (kind == 0) {
        const auto value = varint();
        if (!value || *key >> 3 == wanted) return value;
      } else if (!pass(kind)) {
        return std::nullopt;
      }
    }
    return std::nullopt;
  }

 private:
  std::optional<std::uint64_t> varint() {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 64 && !rest_.empty(); shift += 7) {
      const auto byte = static_cast<unsigned char>(rest_.front());
      rest_.remove_prefix(1);
      value |= static_cast<std::uint64_t>(byte & 0x7fu) << shift;
      if ((byte & 0x80u) == 0) return value;
    }
    return std::nullopt;
  }

  bool pass(std::uint64_t kind) {
    std::uint64_t length = kind == 1 ? 8 : kind == 5 ? 4 : 0;
    if (kind == 2) {
      const auto given = varint();
      if (!given) return false;
      length = *given;
    } else if (length == 0) {
      return false;
    }
    if (length > rest_.size()) return false;
    rest_.remove_prefix(static_cast<std::size_t>(length));
    return true;
  }

  std::string_view rest_;
};

constexpr std::size_t kLengthBytes = 4;
constexpr std::uint64_t kMostHeader = 65536;  // as the format has it
// Field numbers of the format: BlobHeader.datasize, Blob.raw_size.
constexpr std::uint64_t kDataSize = 3, kRawSize = 2;

Error cut_off(std::size_t at) {
  return {ErrorCode::parse, "byte " + std::to_string(at), "The PBF ends within a block: the file is cut off. Fetch it again."};
}

}  // namespace

Result<void> check_pbf_blocks(std::string_view bytes) {
  std::uint64_t unpacked = 0;
  for (std::size_t at = 0; at < bytes.size();) {
    if (bytes.size() - at < kLengthBytes) return cut_off(bytes.size());
    std::uint64_t header = 0;
    for (std::size_t i = 0; i < kLengthBytes; ++i) header = header << 8 | static_cast<unsigned char>(bytes[at + i]);
    at += kLengthBytes;
    if (header == 0 || header > kMostHeader) return {};
    if (header > bytes.size() - at) return cut_off(bytes.size());
    const auto size = ProtobufFields(bytes.substr(at, static_cast<std::size_t>(header))).number(kDataSize);
    at += static_cast<std::size_t>(header);
    if (!size) return {};
    if (*size > bytes.size() - at) return cut_off(bytes.size());
    unpacked += ProtobufFields(bytes.substr(at, static_cast<std::size_t>(*size))).number(kRawSize).value_or(*size);
    at += static_cast<std::size_t>(*size);
    if (unpacked > kMostUnpacked) return too_large_unpacked(kMostUnpacked);
  }
  return {};
}

}  // namespace bl::importing
