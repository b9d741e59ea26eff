// Reads UTF-8 character by character; what is none, and what a terminal obeys, is written out.
#include "core/base/printable.h"

#include "core/base/words.h"

#include <cstdio>

namespace bl {

namespace {

struct Character {
  unsigned code = 0;
  std::size_t length = 1;  // in bytes
  bool is_sound = false;   // as UTF-8 (RFC 3629)
};

Character character_at(std::string_view text, std::size_t at) {
  const unsigned lead = static_cast<unsigned char>(text[at]);
  if (lead < 0x80) return {lead, 1, true};
  const std::size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4 || at + length > text.size()) return {lead, 1, false};
  unsigned code = lead & (0xffu >> (length + 1));
  for (std::size_t k = 1; k < length; ++k) {
    const unsigned next = static_cast<unsigned char>(text[at + k]);
    if ((next & 0xc0u) != 0x80u) return {lead, 1, false};
    code = code << 6 | (next & 0x3fu);
  }
  const unsigned least = length == 2 ? 0x80u : length == 3 ? 0x800u : 0x10000u;
  if (code < least || code > 0x10ffff || (code >= 0xd800 && code <= 0xdfff)) return {lead, 1, false};
  return {code, length, true};
}

// Control characters (C0, DEL, C1), and the marks that turn or break lines without being seen (Unicode 15, 5.8 and 23.2).
bool is_obeyed(const Character& character) {
  const unsigned code = character.code;
  return !character.is_sound || code < 0x20 || (code >= 0x7f && code < 0xa0) || (code >= 0x200e && code <= 0x200f) ||
         (code >= 0x2028 && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069) || code == 0x061c || code == 0xfeff;
}

void append_code(std::string& out, const Character& character, unsigned char byte) {
  char buffer[16];
  if (character.code == '\n') std::snprintf(buffer, sizeof buffer, "\\n");
  else if (character.code == '\t') std::snprintf(buffer, sizeof buffer, "\\t");
  else if (character.is_sound && character.code >= 0x80) std::snprintf(buffer, sizeof buffer, "\\u%04x", character.code);
  else std::snprintf(buffer, sizeof buffer, "\\x%02x", byte);
  out += buffer;
}

}  // namespace

bool is_harmless(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const Character character = character_at(text, i);
    if (is_obeyed(character) && character.code != '\n') return false;
    i += character.length;
  }
  return true;
}

std::string printable(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const Character character = character_at(text, i);
    if (is_obeyed(character)) append_code(out, character, static_cast<unsigned char>(text[i]));
    else out += text.substr(i, character.length);
    i += character.length;
  }
  return out;
}

}  // namespace bl
