// Archives by libzip, which writes into a buffer of its own.
#include "core/export/zip_archive.h"

#include <zip.h>

namespace bl::exporting {

namespace {

Error zip_failure(const std::string& what, zip_error_t* error) {
  return {ErrorCode::internal, "zip", what + ": " + zip_error_strerror(error)};
}

Result<std::string> bytes_of(zip_source_t* buffer) {
  if (zip_source_open(buffer) != 0) return zip_failure("the archive cannot be read back", zip_source_error(buffer));
  std::string bytes;
  char part[1 << 16];
  for (zip_int64_t count = 0; (count = zip_source_read(buffer, part, sizeof part)) > 0;)
    bytes.append(part, static_cast<std::size_t>(count));
  zip_source_close(buffer);
  return bytes;
}

}  // namespace

Result<std::string> zip_archive(const std::vector<std::pair<std::string, std::string>>& files, const std::string& comment) {
  constexpr zip_uint16_t kNoTime = 0, kFirstDay = (1 << 5) | 1;
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* buffer = zip_source_buffer_create(nullptr, 0, 0, &error);
  if (buffer == nullptr) return zip_failure("no buffer", &error);
  zip_source_keep(buffer);
  zip_t* archive = zip_open_from_source(buffer, ZIP_TRUNCATE, &error);
  if (archive == nullptr) {
    zip_source_free(buffer);
    zip_source_free(buffer);
    return zip_failure("the archive cannot be made", &error);
  }
  for (const auto& [name, content] : files) {
    zip_source_t* source = zip_source_buffer(archive, content.data(), content.size(), 0);
    const zip_int64_t place = source == nullptr ? -1 : zip_file_add(archive, name.c_str(), source, ZIP_FL_ENC_UTF_8);
    if (place >= 0) zip_file_set_dostime(archive, static_cast<zip_uint64_t>(place), kNoTime, kFirstDay, 0);
    else zip_source_free(source);
  }
  zip_set_archive_comment(archive, comment.c_str(), static_cast<zip_uint16_t>(comment.size()));
  if (zip_close(archive) != 0) {
    const Error failed = zip_failure("the archive cannot be closed", zip_get_error(archive));
    zip_discard(archive);
    zip_source_free(buffer);
    return failed;
  }
  Result<std::string> bytes = bytes_of(buffer);
  zip_source_free(buffer);
  return bytes;
}

}  // namespace bl::exporting
