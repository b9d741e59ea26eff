// The page holds its pictures itself: it needs no network to be printed.
#include "ui/desktop/panels/invitation_sheet.h"

#include <filesystem>

#include "core/file/file_io.h"
#include "core/serve/qr_code.h"

namespace bl::desktop {

Result<std::string> invitation_page(const std::string& page, const std::map<std::string, std::string>& keys,
                                    const std::map<std::string, int>& people) {
  std::string text =
      "<!doctype html><html lang=\"en\"><head><meta "
      "charset=\"utf-8\"><title>Invitations</title><style>body{font-family:sans-serif}"
      ".card{display:inline-block;width:45%;margin:1%;padding:1em;border:1px solid #888;break-inside:avoid;text-align:center}"
      ".card svg{width:45mm;height:45mm}.card p{font-size:8pt;word-break:break-all}</style></head><body>\n";
  for (const auto& [role, count] : people) {
    const auto key = keys.find(role);
    if (count <= 0 || key == keys.end()) continue;
    // Addresses and keys have no characters that mean something in HTML.
    const std::string address = page + "#k=" + key->second;
    const auto picture = serve::qr_svg(address);
    if (!picture) return picture.error();
    for (int k = 0; k < count; ++k)
      text += "<div class=\"card\"><h2>You are invited as " + role + "</h2>" + *picture +
              "<div>Join the Wi-Fi of the session. Then open this with the camera of your phone.</div><p>" + address +
              "</p></div>\n";
  }
  return text + "</body></html>\n";
}

Result<void> write_invitations(const std::string& path, const std::string& page, const std::map<std::string, std::string>& keys,
                               const std::map<std::string, int>& people) {
  const auto text = invitation_page(page, keys, people);
  if (!text) return text.error();
  // The file gets its mode before its content; write_file keeps the mode of the file that is there.
  if (auto begun = write_file(path, ""); !begun) return begun;
  std::error_code error;
  std::filesystem::permissions(path, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write, error);
  if (error) return Error{ErrorCode::io, path, "cannot be kept from others who use this computer: " + error.message()};
  return write_file(path, *text);
}

}  // namespace bl::desktop
