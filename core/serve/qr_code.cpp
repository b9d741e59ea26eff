// The modules come from libqrencode; the only file that sees it.
#include "core/serve/qr_code.h"

#include <qrencode.h>

#include <memory>

namespace bl::serve {

namespace {

constexpr int kQuiet = 4;  // modules around the code (ISO/IEC 18004)

}  // namespace

Result<std::vector<std::vector<bool>>> qr_modules(const std::string& text) {
  const std::unique_ptr<QRcode, decltype(&QRcode_free)> code(QRcode_encodeString(text.c_str(), 0, QR_ECLEVEL_M, QR_MODE_8, 1),
                                                             QRcode_free);
  if (!code) return Error{ErrorCode::out_of_range, "", "the text is too long for a QR code"};
  const int width = code->width + 2 * kQuiet;
  std::vector<std::vector<bool>> modules(static_cast<std::size_t>(width), std::vector<bool>(static_cast<std::size_t>(width)));
  for (int y = 0; y < code->width; ++y)
    for (int x = 0; x < code->width; ++x)
      modules[static_cast<std::size_t>(y + kQuiet)][static_cast<std::size_t>(x + kQuiet)] =
          (code->data[y * code->width + x] & 1) != 0;
  return modules;
}

Result<std::string> qr_text(const std::string& text) {
  const auto modules = qr_modules(text);
  if (!modules) return modules.error();
  std::string lines;
  for (std::size_t y = 0; y < modules->size(); y += 2) {
    for (std::size_t x = 0; x < modules->size(); ++x) {
      const bool above = (*modules)[y][x], below = y + 1 < modules->size() && (*modules)[y + 1][x];
      // The block is what is light: terminals are dark.
      lines += above ? (below ? " " : "▄") : (below ? "▀" : "█");
    }
    lines += "\n";
  }
  return lines;
}

Result<std::string> qr_svg(const std::string& text) {
  const auto modules = qr_modules(text);
  if (!modules) return modules.error();
  const std::string width = std::to_string(modules->size());
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + width + " " + width +
                    "\" shape-rendering=\"crispEdges\"><path fill=\"#fff\" d=\"M0 0h" + width + "v" + width + "H0z\"/><path d=\"";
  for (std::size_t y = 0; y < modules->size(); ++y)
    for (std::size_t x = 0; x < modules->size(); ++x)
      if ((*modules)[y][x]) svg += "M" + std::to_string(x) + " " + std::to_string(y) + "h1v1h-1z";
  return svg + "\"/></svg>";
}

}  // namespace bl::serve
