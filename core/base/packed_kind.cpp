// The marks that the formats themselves define; an archive without content begins with the mark of its end.
#include "core/base/packed_kind.h"

#include <array>

namespace bl {

namespace {

struct PackedMark {
  std::string_view bytes, kind;
};
constexpr std::string_view kZip = "a zip archive or an office document";
constexpr std::array kPackedMarks = {PackedMark{"PK\x03\x04", kZip},
                                     PackedMark{"PK\x05\x06", kZip},
                                     PackedMark{"PK\x07\x08", kZip},
                                     PackedMark{"7z\xBC\xAF\x27\x1C", "a 7z archive"},
                                     PackedMark{"Rar!\x1A\x07", "a rar archive"},
                                     PackedMark{"\x1F\x8B", "a file packed with gzip"},
                                     PackedMark{"BZh", "a file packed with bzip2"},
                                     PackedMark{"\xFD\x37zXZ", "a file packed with xz"},
                                     PackedMark{"\x28\xB5\x2F\xFD", "a file packed with zstd"}};

}  // namespace

std::string_view packed_kind(std::string_view bytes) {
  for (const PackedMark& mark : kPackedMarks)
    if (bytes.starts_with(mark.bytes)) return mark.kind;
  return {};
}

std::optional<Error> packed_refusal(std::string_view bytes) {
  const std::string_view kind = packed_kind(bytes);
  if (kind.empty()) return std::nullopt;
  return Error{ErrorCode::parse, "byte 0",
               "This is " + std::string(kind) + ", which is not read: unpack it first, and give the file that is in it."};
}

}  // namespace bl
