// The page holds its pictures itself: it needs no network to be printed.
#include "ui/desktop/panels/invitation_sheet.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

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
  // write_file keeps the mode of the file that is there.
  const int file = ::open(path.c_str(), O_CREAT | O_WRONLY | O_CLOEXEC, S_IRUSR | S_IWUSR);
  if (file < 0) return Error{ErrorCode::io, path, std::string("cannot be written: ") + std::strerror(errno)};
  const bool is_private = ::fchmod(file, S_IRUSR | S_IWUSR) == 0;
  ::close(file);
  if (!is_private) return Error{ErrorCode::io, path, "cannot be kept from others who use this computer"};
  return write_file(path, *text);
}

}  // namespace bl::desktop
