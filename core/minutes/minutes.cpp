// Writes the files of the minutes, and tells those of earlier minutes from what somebody else has put there.
#include "core/minutes/minutes.h"

#include <filesystem>
#include <system_error>

#include "core/file/file_io.h"
#include "core/minutes/page.h"
#include "core/minutes/tables.h"

namespace bl::minutes {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kLogBegin = "{\"format\": \"behaviourlinks-log\"";

Result<void> make_directory(const fs::path& directory) {
  std::error_code code;
  fs::create_directories(directory, code);
  if (std::error_code ignored; fs::is_directory(directory, ignored)) return {};
  const std::string why = code ? code.message() : std::string("something else of that name is there");
  return Error{ErrorCode::io, directory.string(), "the folder for the minutes cannot be made (" + why + "): choose another one"};
}

// Nothing where the file is missing or empty.
Result<std::string> content_of(const fs::path& file) {
  std::error_code none;
  return fs::exists(file, none) ? read_file(file.string()) : Result<std::string>(std::string());
}

Error taken(const fs::path& file, const std::string& what) {
  return {ErrorCode::conflict, file.string(), "is there already and " + what + "; choose another folder, or remove it first"};
}

Result<void> may_replace(const fs::path& file, std::string_view begin) {
  const auto text = content_of(file);
  if (!text) return text.error();
  if (!text->empty() && !text->starts_with(begin)) return taken(file, "is not of earlier minutes");
  return {};
}

// A scene of somebody looks like ours: it is ours where the page beside it is.
Result<void> may_put_scenes(const fs::path& folder, const Account& account) {
  const auto page = content_of(folder / kMinutesPage);
  if (!page) return page.error();
  if (page->starts_with(page_beginning(account))) return {};
  if (!page->empty()) return taken(folder / kMinutesPage, "holds the minutes of another session");
  std::error_code none;
  if (!fs::is_empty(folder / "scenes", none) && !none) return taken(folder / "scenes", "is not of earlier minutes");
  return {};
}

}  // namespace

Result<void> may_fill_with_minutes(const std::string& directory) {
  const fs::path folder(directory);
  auto may = may_replace(folder / kMinutesPage, page_beginning());
  for (const auto& [name, begin] : table_beginnings())
    if (may) may = may_replace(folder / name, begin);
  if (may) may = may_replace(folder / "log.jsonl", kLogBegin);
  return may;
}

std::vector<std::pair<std::string, std::string>> files_of(const Account& account) {
  std::vector<std::pair<std::string, std::string>> files = {{std::string(kMinutesPage), write_page(account)},
                                                            {"decisions.csv", decisions_csv(account)},
                                                            {"comments.csv", comments_csv(account)},
                                                            {"votes.csv", votes_csv(account)},
                                                            {"log.jsonl", account.log},
                                                            {"scenes/end.json", account.last_scene}};
  for (const Saved& saved : account.scenarios) files.emplace_back(saved.file(), saved.scene);
  return files;
}

Result<std::size_t> write_minutes(const std::string& directory, const Account& account) {
  const fs::path folder(directory);
  auto done = make_directory(folder);
  if (done) done = may_fill_with_minutes(directory);
  if (done) done = may_put_scenes(folder, account);
  if (done) done = make_directory(folder / "scenes");
  // The page first: the scenes are known as ours by it.
  const auto files = files_of(account);
  for (const auto& [name, text] : files)
    if (done) done = write_file((folder / name).string(), text);
  if (!done) return done.error();
  return files.size();
}

}  // namespace bl::minutes
