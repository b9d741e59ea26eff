// Reads what nodes say of brokers, and passwords from where they are kept.
#include "core/live/access.h"

#include <cstdlib>
#include <filesystem>

#include "core/address/password_source.h"
#include "core/file/file_io.h"
#include "core/reading/views/stream.h"

namespace bl::live {

namespace {

constexpr std::uintmax_t kLongestCertificates = 16u << 20;  // [bytes]
constexpr std::uintmax_t kLongestPassword = 65535;          // [bytes] the protocol has no longer ones

}  // namespace

Result<std::string> Access::password() const {
  if (password_from.empty()) return std::string();
  const auto source = address::parse_password_source(password_from);
  if (!source) return source.error();
  if (!source->is_file) {
    const char* const held = std::getenv(source->name.c_str());
    if (held == nullptr)
      return Error{ErrorCode::missing, "", "the variable `" + source->name + "` is not set in the environment of this program"};
    return std::string(held);
  }
  const std::filesystem::path path = std::filesystem::path(folder) / source->name;
  std::error_code none;
  if (std::filesystem::file_size(path, none) > kLongestPassword && !none)
    return Error{ErrorCode::io, "", "the file `" + source->name + "` is too long for a password"};
  const auto text = read_plain_file(path.string(), kLongestPassword);
  if (!text) return Error{ErrorCode::io, "", "the file `" + source->name + "` cannot be read"};
  return text->substr(0, text->find_first_of("\r\n"));
}

Result<std::string> Access::certificates() const {
  if (ca_file.empty()) return std::string();
  const std::string path = (std::filesystem::path(folder) / ca_file).string();
  if (const auto text = read_plain_file(path, kLongestCertificates);
      !text || text->find("-----BEGIN CERTIFICATE-----") == std::string::npos)
    return Error{
        ErrorCode::io, "",
        text ? "the file `" + ca_file + "` holds no certificate in PEM form" : "the file `" + ca_file + "` cannot be read"};
  return path;
}

std::map<std::string, Access> accesses_of(const Scene& scene, const std::string& folder) {
  std::map<std::string, Access> accesses;
  for (const auto& [id, node] : scene.nodes) {
    const auto broker = reading::settings_of<reading::BrokerSettings>(scene, full_registry(), node);
    if (!broker) continue;
    accesses.emplace(broker->host + ":" + std::to_string(broker->port),
                     Access{id, broker->user, broker->password_from, broker->ca_file, broker->is_encrypted, folder});
  }
  return accesses;
}

}  // namespace bl::live
