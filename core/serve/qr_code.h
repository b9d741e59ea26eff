// Addresses as QR codes, for phones: on a terminal, and as SVG for pages, and in a window.
#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"

namespace bl::serve {

/// Half blocks of a terminal, two rows a line, dark on light, with the quiet zone of four modules that readers want.
Result<std::string> qr_text(const std::string& text);
/// By row: true is dark. With the quiet zone.
Result<std::vector<std::vector<bool>>> qr_modules(const std::string& text);
/// One SVG element.
Result<std::string> qr_svg(const std::string& text);

}  // namespace bl::serve
