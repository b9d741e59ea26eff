// Compares the files of a call with each other and with the files on the disk, before anything is read or written.
#include "ui/cli/file_rule.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <set>
#include <string_view>

#include "core/file/file_io.h"

namespace bl::cli {

namespace {

namespace fs = std::filesystem;

std::map<const CLI::App*, TaskFiles>& all_task_files() {
  static std::map<const CLI::App*, TaskFiles> files;
  return files;
}

// Type names of options that take files or folders.
bool takes_files(const std::string& type) {
  static const std::set<std::string> kTypes = {"FILE", "SCENE", "SCENE_A", "SCENE_B", "FILE.lua", "DIR",
                                               "OUT",  "PATH",  "LOG",     "PICTURE", "NET",      "TRIPS"};
  return kTypes.contains(type);
}

// One file that a call names.
struct NamedFile {
  std::string option, path;
  const TaskFiles::Role* role = nullptr;
};

// Devices and pipes take what they are given, as often as it comes.
bool is_plain_file(const std::string& path) {
  std::error_code none;
  const fs::file_status status = fs::status(path, none);
  return !fs::exists(status) || fs::is_regular_file(status);
}

// The same file, by whatever name, link or way to it; also where it is not there yet.
bool is_one_file(const std::string& a, const std::string& b) {
  std::error_code none;
  if (fs::equivalent(a, b, none)) return true;
  return !a.empty() && !b.empty() && fs::weakly_canonical(fs::absolute(a), none) == fs::weakly_canonical(fs::absolute(b), none);
}

struct KindRow {
  FileKind kind;
  std::string_view name;  // with its article
};
constexpr std::array kKindRows = {KindRow{FileKind::scene, "a scene"}, KindRow{FileKind::figures, "figures as JSON"},
                                  KindRow{FileKind::table, "a table"}, KindRow{FileKind::page, "a page"},
                                  KindRow{FileKind::log, "a log"}};
std::string_view name_of(FileKind kind) {
  return std::find_if(kKindRows.begin(), kKindRows.end(), [&](const KindRow& row) { return row.kind == kind; })->name;
}

// What lies in a file by its beginning, with its article; "" where it is empty or not there.
std::string_view what_lies_in(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text(4096, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(std::max<std::streamsize>(0, file.gcount())));
  const std::string_view begin =
      std::string_view(text).substr(std::min(text.find_first_not_of("\xEF\xBB\xBF \t\r\n"), text.size()));
  if (begin.empty()) return "";
  // "format": "behaviourlinks" or "behaviourlinks-log", with whatever blanks.
  if (const std::size_t key = begin.find("\"format\""); begin.front() == '{' && key < 256) {
    const std::string_view value = begin.substr(std::min(begin.find_first_not_of(": \t\r\n", key + 8), begin.size()));
    if (value.starts_with("\"behaviourlinks-log\"")) return name_of(FileKind::log);
    if (value.starts_with("\"behaviourlinks\"")) return name_of(FileKind::scene);
  }
  for (const char* word : {"\"FeatureCollection\"", "\"Feature\"", "\"CityJSON\"", "\"CityJSONFeature\""})
    if (begin.front() == '{' && begin.find(word) != std::string_view::npos) return "a map";
  if (begin.front() == '{' || begin.front() == '[') return name_of(FileKind::figures);
  if (begin.front() == '<') return begin.starts_with("<!") || begin.starts_with("<html") ? name_of(FileKind::page) : "XML";
  if (std::any_of(begin.begin(), begin.end(), [](char c) { return c >= 0 && c < 32 && c != '\t' && c != '\r' && c != '\n'; }))
    return "no text";
  const std::string_view line = begin.substr(0, begin.find_first_of("\r\n"));
  const bool is_code = path.ends_with(".lua") || line.starts_with("--") || line.find_first_of("{}()=") != std::string_view::npos;
  return !is_code && line.find_first_of(",;\t") != std::string_view::npos ? name_of(FileKind::table) : "another text";
}

// Without its dashes, an argument stands in the help in capitals.
std::string shown_option(const CLI::Option& option) {
  return option.get_positional() ? option.get_type_name() : "--" + option.get_lnames().front();
}

std::vector<NamedFile> files_named(const CLI::App& task, const TaskFiles& files, std::string& defect) {
  std::vector<NamedFile> named;
  for (const CLI::Option* option : task.get_options()) {
    const std::string name = option->get_positional() ? option->get_name(true) : "--" + option->get_lnames().front();
    const auto role = files.roles().find(name);
    if (role == files.roles().end()) {
      if (takes_files(option->get_type_name())) defect = name;
      continue;
    }
    for (const std::string& path : option->results()) named.push_back({shown_option(*option), path, &role->second});
  }
  return named;
}

using Use = TaskFiles::Role::Use;

// Does what `output` writes fall on the file `other`?
bool falls_on(const NamedFile& output, const std::string& other) {
  if (output.role->use != Use::fills) return is_one_file(output.path, other);
  const std::vector<std::string>& endings = output.role->endings;
  const fs::path path = fs::absolute(other);
  return std::find(endings.begin(), endings.end(), path.extension().string()) != endings.end() &&
         is_one_file(output.path, path.parent_path().string());
}

// The output at `place` against all other files of the call.
std::string meets_another(const CLI::App& task, const std::vector<NamedFile>& named, std::size_t place) {
  const NamedFile& output = named[place];
  const CLI::Option* changed = output.role->changed.empty() ? nullptr : task.get_option_no_throw(output.role->changed);
  const std::string thing = output.role->use == Use::fills ? "folder" : "file";
  for (std::size_t i = 0; i < named.size(); ++i) {
    const NamedFile& other = named[i];
    if (i == place || other.role->use == Use::fills || !is_plain_file(other.path) || !falls_on(output, other.path)) continue;
    // Of two files the one that is named later is blamed.
    const bool is_written = other.role->use != Use::reads;
    if (is_written && output.role->use != Use::fills && i > place) continue;
    if (is_written)
      return output.option + ": " + other.path + ": is written by " + other.option + " already; choose another " + thing;
    if (changed != nullptr && shown_option(*changed) == other.option) continue;
    return output.option + ": " + other.path + ": is read as " + other.option + "; choose another " + thing;
  }
  return "";
}

// Better told before the work than after it.
std::string cannot_be_written(const NamedFile& output) {
  const std::string where = output.option + ": " + output.path + ": ";
  const fs::path folder = fs::path(output.path).parent_path();
  std::error_code none;
  if (fs::is_directory(output.path, none)) return where + "is a folder, not a file; choose another name";
  if (!folder.empty() && !fs::is_directory(folder, none))
    return where + "cannot be written: there is no folder " + folder.string();
  const auto may = may_write_file(output.path);
  return may ? "" : where + may.error().message + "; choose another place";
}

// The folder itself, or the nearest above it that is there, in which it would be made.
std::string cannot_be_filled(const NamedFile& output) {
  const std::string where = output.option + ": " + output.path + ": ";
  std::error_code none;
  fs::path folder = fs::absolute(output.path, none).lexically_normal();
  while (!fs::exists(folder, none) && folder.has_relative_path()) folder = folder.parent_path();
  if (!fs::is_directory(folder, none)) return where + folder.string() + " is a file, not a folder; choose another name";
  if (const auto may = may_write_file((folder / "probe").string()); !may)
    return where + "nothing can be written there; choose another place";
  if (!output.role->objection) return "";
  const auto objection = output.role->objection(output.path);
  return objection ? "" : output.option + ": " + objection.error().text();
}

// What --force replaces is --out, whose help says so: other outputs of the same call are somebody's files all the same.
constexpr std::string_view kForced = "--out";

std::string replaces_another_kind(const NamedFile& output, bool has_force) {
  if (!is_plain_file(output.path) || output.path.starts_with("/dev/")) return "";
  const std::string_view found = what_lies_in(output.path), wanted = name_of(output.role->kind);
  if (found.empty() || found == wanted) return "";
  return output.option + ": " + output.path + ": exists already and holds " + std::string(found) + ", not " +
         std::string(wanted) +
         (has_force && output.option == kForced ? "; choose another name, or replace it with --force"
                                                : "; choose another name, or remove it first");
}

}  // namespace

TaskFiles& TaskFiles::reads(std::initializer_list<const char*> options) {
  for (const char* option : options) roles_[option] = {};
  return *this;
}
TaskFiles& TaskFiles::writes(const char* option, FileKind kind, const char* changed) {
  roles_[option] = {Role::Use::writes, kind, changed == nullptr ? "" : changed, {}, {}};
  return *this;
}
TaskFiles& TaskFiles::fills(const char* option, std::vector<std::string> endings, Objection objection) {
  roles_[option] = {Role::Use::fills, FileKind::figures, "", std::move(endings), std::move(objection)};
  return *this;
}

TaskFiles& TaskFiles::exports(const char* option) {
  roles_[option] = {Role::Use::exports, FileKind::figures, "", {}, {}};
  return *this;
}

TaskFiles& files_of(CLI::App& task) { return all_task_files()[&task]; }

std::string wrong_files(const CLI::App& task) {
  std::string defect;
  const std::vector<NamedFile> named = files_named(task, all_task_files()[&task], defect);
  if (!defect.empty())
    return "a defect of the program, please report it: no rule says what " + defect + " does with its file (files_of)";
  for (const NamedFile& file : named)
    if (file.path.empty())
      return file.option + ": names no " + (file.role->use == Use::fills ? "folder" : "file") + "; say which one";
  const CLI::Option* force = task.get_option_no_throw("--force");
  for (std::size_t i = 0; i < named.size(); ++i) {
    const NamedFile& file = named[i];
    if (file.role->use == Use::reads) continue;
    std::string sentence = meets_another(task, named, i);
    if (file.role->use == Use::exports) {
      if (!sentence.empty()) return sentence;
      continue;
    }
    if (sentence.empty()) sentence = file.role->use == Use::fills ? cannot_be_filled(file) : cannot_be_written(file);
    const bool is_forced = force != nullptr && force->count() > 0 && file.option == kForced;
    if (sentence.empty() && file.role->use == Use::writes && !is_forced) sentence = replaces_another_kind(file, force != nullptr);
    if (!sentence.empty()) return sentence;
  }
  return "";
}

}  // namespace bl::cli
