// Composition by utf8proc; the only file that sees it.
#include "core/base/words.h"

#include <algorithm>
#include <cstdlib>
#include <memory>

#include <utf8proc.h>

namespace bl {

std::string composed(std::string_view text) {
  const bool is_ascii = std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; });
  if (is_ascii) return std::string(text);
  utf8proc_uint8_t* raw = nullptr;
  constexpr auto kHow = static_cast<utf8proc_option_t>(UTF8PROC_STABLE | UTF8PROC_COMPOSE);
  const auto size = utf8proc_map(reinterpret_cast<const utf8proc_uint8_t*>(text.data()),
                                 static_cast<utf8proc_ssize_t>(text.size()), &raw, kHow);
  const std::unique_ptr<utf8proc_uint8_t, decltype(&std::free)> made(raw, std::free);
  if (size < 0) return std::string(text);
  return {reinterpret_cast<const char*>(made.get()), static_cast<std::size_t>(size)};
}

}  // namespace bl
