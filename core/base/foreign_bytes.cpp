// Tells formats by how they begin, and texts by the control characters that they do not have.
#include "core/base/foreign_bytes.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "core/base/packed_kind.h"

namespace bl {

namespace {

// So much tells noise from text [bytes].
constexpr std::size_t kHead = 4096;

struct Beginning {
  std::string_view bytes;
  const char* kind;
};
constexpr std::array kBeginnings = {
    Beginning{"\x89PNG\r\n", "a picture (PNG)"}, Beginning{"\xff\xd8\xff", "a picture (JPEG)"},
    Beginning{"GIF8", "a picture (GIF)"},        Beginning{"II*", "a picture (TIFF)"},
    Beginning{"%PDF-", "a document (PDF)"},      Beginning{"SQLite format 3", "a database (SQLite, such as a GeoPackage)"},
    Beginning{"glTF", "a model (GLB)"},          Beginning{"\xff\xfe", "text in UTF-16"},
    Beginning{"\xfe\xff", "text in UTF-16"}};

// Tabs, line ends and form feeds stand in texts; the mark of the end that DOS wrote, and escapes, do now and then.
bool is_control(char c) {
  const auto code = static_cast<unsigned char>(c);
  return (code < 0x20 && !(code >= 0x09 && code <= 0x0d) && code != 0x1a && code != 0x1b) || code == 0x7f;
}

}  // namespace

std::string foreign_kind(std::string_view bytes) {
  if (const std::string_view packed = packed_kind(bytes); !packed.empty()) return std::string(packed);
  for (const Beginning& beginning : kBeginnings)
    if (bytes.starts_with(beginning.bytes)) return beginning.kind;
  const std::string_view head = bytes.substr(0, kHead);
  if (head.starts_with(std::string_view("MM\0*", 4))) return "a picture (TIFF)";
  // One or two slip into texts; of noise a tenth is of them.
  const auto controls = std::count_if(head.begin(), head.end(), is_control);
  const bool is_text = controls * 50 <= static_cast<std::ptrdiff_t>(head.size()) && head.find('\0') == std::string_view::npos;
  return is_text ? "" : "binary data of no known kind";
}

std::optional<Error> foreign_bytes(std::string_view bytes, std::string_view wanted, std::string_view remedy) {
  const std::string kind = foreign_kind(bytes);
  if (kind.empty()) return std::nullopt;
  return Error{ErrorCode::parse, "byte 0",
               "This is no " + std::string(wanted) + " but " + kind + ": " + std::string(remedy) + "."};
}

}  // namespace bl
