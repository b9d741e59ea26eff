// The messages declared, and Base64.
#include "core/serve/following.h"

#include <array>

namespace bl::serve {

namespace {

constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

Error no_bytes() { return {ErrorCode::parse, "bytes", "this is no Base64"}; }

}  // namespace

void Follow::declare(wire::MessageBuilder<Follow>& m) {
  m.from_page().id("follow").doc("The laptop is ready for a copy of the session file.");
  m.field(&Follow::is_safe, "safe").doc("Answers wait until this laptop has stored them, too.");
}
void CopyPart::declare(wire::MessageBuilder<CopyPart>& m) {
  m.id("copy").doc("A part of the packed session file.");
  m.field(&CopyPart::n, "n").required().doc("The last change that is in it.");
  m.field(&CopyPart::part, "part").required().doc("Bytes in Base64.");
  m.field(&CopyPart::size, "size").doc("Of the file, in the last part.");
  m.field(&CopyPart::digest, "digest").doc("Of the file, in the last part.");
  m.field(&CopyPart::is_last, "last").doc("The file is whole now.");
}
void Changes::declare(wire::MessageBuilder<Changes>& m) {
  m.id("changes").doc("What was stored since the change before.");
  m.field(&Changes::n, "n").required().doc("Its number.");
  m.field(&Changes::bytes, "bytes").required().doc("In Base64.");
}
void Kept::declare(wire::MessageBuilder<Kept>& m) {
  m.from_page().id("kept").doc("All changes up to this one are stored here, too.");
  m.field(&Kept::n, "n").required().doc("Its number.");
}

std::string text_of_bytes(std::string_view bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - k);
    std::uint32_t three = 0;
    for (std::size_t j = 0; j < 3; ++j) three = three << 8 | (j < count ? static_cast<unsigned char>(bytes[k + j]) : 0u);
    for (std::size_t j = 0; j < 4; ++j) text += j <= count ? kDigits[three >> (18 - 6 * j) & 63] : '=';
  }
  return text;
}

Result<std::string> bytes_of_text(std::string_view text) {
  static const auto kValues = [] {
    std::array<std::int8_t, 256> values;
    values.fill(-1);
    for (std::size_t k = 0; k < kDigits.size(); ++k) values[static_cast<unsigned char>(kDigits[k])] = static_cast<std::int8_t>(k);
    return values;
  }();
  if (text.size() % 4 != 0) return no_bytes();
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3);
  for (std::size_t k = 0; k < text.size(); k += 4) {
    std::uint32_t four = 0;
    std::size_t count = 4;
    if (k + 4 == text.size())
      while (count > 2 && text[k + count - 1] == '=') --count;
    for (std::size_t j = 0; j < 4; ++j) {
      const int value = j < count ? kValues[static_cast<unsigned char>(text[k + j])] : 0;
      if (value < 0) return no_bytes();
      four = four << 6 | static_cast<std::uint32_t>(value);
    }
    for (std::size_t j = 0; j + 1 < count; ++j) bytes += static_cast<char>(four >> (16 - 8 * j) & 255);
  }
  return bytes;
}

}  // namespace bl::serve
