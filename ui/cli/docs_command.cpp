// `docs`: catalogue pages of typifications, link kinds, commands and export formats, from their declarations.
#include <sys/stat.h>
#include <cerrno>
#include <cstring>
#include <map>
#include <optional>
#include <utility>

#include "core/base/text.h"
#include "core/define/catalogue.h"
#include "core/export/option_text.h"
#include "core/file/file_io.h"
#include "core/making/script_file.h"
#include "ui/cli/commands.h"
#include "ui/cli/scene_loading.h"
#include "ui/cli/terminal.h"

namespace bl::cli {

namespace {

template <class Map>
void list_types(const std::string& title, const Map& types, std::vector<std::string> columns) {
  TextTable table({{title}, {columns.front()}, {columns.back()}});
  for (const auto& [id, type] : types) {
    // The first sentence says what it is; the page has the rest.
    const std::size_t end = type.doc.find(". ");
    table.add({id, type.label, type.doc.substr(0, end == std::string::npos ? end : end + 1)});
  }
  table.print();
}

int print_list(const Registry& registry) {
  list_types("typification", registry.typifications(), {"name", "what it is"});
  print_line();
  list_types("link kind", registry.links(), {"name", "what it does"});
  print_line();
  list_types("command", registry.commands(), {"name", "what it does"});
  print_line();
  std::map<std::string, exporting::FormatDefinition> formats;
  for (const exporting::FormatDefinition& format : exporting::all_formats()) formats.emplace(format.id, format);
  list_types("export format", formats, {"name", "what it holds"});
  return kDone;
}

std::optional<std::string> page_of(const std::string& id, const Registry& registry) {
  // An id may stand for a typification and a link kind at once; then both pages are shown.
  std::string page;
  if (const auto* type = registry.typification(id)) page += catalogue_page(*type, registry);
  if (const auto* kind = registry.link(id)) page += (page.empty() ? "" : "\n") + catalogue_page(*kind, registry);
  if (const auto* command = registry.command(id)) page += (page.empty() ? "" : "\n") + catalogue_page(*command);
  if (const auto* format = exporting::find_format(id)) page += (page.empty() ? "" : "\n") + exporting::format_page(*format);
  if (page.empty()) return std::nullopt;
  return page;
}

std::vector<std::string> all_ids(const Registry& registry) {
  std::vector<std::string> ids = keys_of(registry.typifications());
  for (const auto& [id, kind] : registry.links()) ids.push_back(id);
  for (const auto& [id, command] : registry.commands()) ids.push_back(id);
  for (const exporting::FormatDefinition& format : exporting::all_formats()) ids.push_back(format.id);
  return ids;
}

// The scripts of a scene, or the one that a .lua file is. Nothing where the file cannot be read, which was said then.
std::optional<Scripts> scripts_of(const std::string& file) {
  const auto text = read_file(file);
  if (!text) {
    print_error(file, text.error());
    return std::nullopt;
  }
  Scripts scripts;
  if (file.ends_with(".lua")) {
    scripts = Scripts::read({{making::script_name(file), *text}}, full_registry());
  } else {
    const SceneReading reading = read_scene(*text, full_registry());
    if (!reading.is_usable()) {
      print_problems(file, reading.problems);
      return std::nullopt;
    }
    scripts = reading.scene.scripts;
  }
  // One that cannot be read hides its own page only.
  for (const auto& [name, error] : scripts.errors()) print_error(file, error);
  return scripts;
}

bool is_file_name(const std::string& type) { return type.ends_with(".lua") || type.ends_with(".json"); }

// The pages of all link kinds that the scripts declare.
int print_pages(const std::string& file, const Scripts& scripts, const Registry& registry) {
  std::string pages;
  for (const auto& [name, kind] : scripts.kinds())
    if (const LinkDefinition* link = registry.link(kind)) pages += (pages.empty() ? "" : "\n") + catalogue_page(*link, registry);
  if (pages.empty()) {
    if (scripts.errors().empty()) complain(file + ": the scene has no link scripts, so it declares no types of its own.");
    return kBadInput;
  }
  print_page(pages);
  return kDone;
}

Result<void> make_folder(const std::string& path) {
  if (::mkdir(path.c_str(), 0777) == 0) return {};
  struct stat status {};
  if (errno == EEXIST && ::stat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode)) return {};
  return Error{ErrorCode::io, path,
               errno == EEXIST ? "is a file, not a folder" : std::string("cannot be made: ") + std::strerror(errno)};
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

Result<std::size_t> write_pages(const std::string& folder, const Registry& registry) {
  std::vector<std::pair<std::string, std::string>> files{{"README.md", catalogue_index(registry)}};
  for (const auto& [id, type] : registry.typifications())
    files.emplace_back("nodes/" + id + ".md", catalogue_page(type, registry));
  for (const auto& [id, kind] : registry.links()) files.emplace_back("links/" + id + ".md", catalogue_page(kind, registry));
  for (const auto& [id, command] : registry.commands()) files.emplace_back("commands/" + id + ".md", catalogue_page(command));
  for (const exporting::FormatDefinition& format : exporting::all_formats())
    files.emplace_back("formats/" + format.id + ".md", exporting::format_page(format));
  for (const auto& [name, text] : files)
    if (const auto there = read_file(folder + "/" + name); there && !there->empty() && first_line(*there) != first_line(text))
      return Error{ErrorCode::conflict, folder + "/" + name,
                   "exists already and is no page of the catalogue; choose another folder, or remove it first"};
  for (const char* part : {"", "/nodes", "/links", "/commands", "/formats"})
    if (auto made = make_folder(folder + part); !made) return made.error();
  for (const auto& [name, text] : files)
    if (auto written = write_file(folder + "/" + name, text); !written) return written.error();
  return files.size();
}

}  // namespace

int docs_command(const DocsOptions& options) {
  Scripts scripts;
  const bool is_file = options.from.empty() && is_file_name(options.type);
  if (const std::string& file = is_file ? options.type : options.from; !file.empty()) {
    auto read = scripts_of(file);
    if (!read) return kBadInput;
    scripts = std::move(*read);
  }
  const Registry& registry = scripts.types(full_registry());
  if (is_file) return print_pages(options.type, scripts, registry);
  if (!options.out.empty()) {
    const auto written = write_pages(options.out, registry);
    if (!written) {
      print_error(options.out, written.error());
      return kBadInput;
    }
    print_line("wrote " + counted(*written, "page") + " to " + options.out);
    return kDone;
  }
  if (options.is_list || options.type.empty()) return print_list(registry);
  const auto page = page_of(options.type, registry);
  if (!page) {
    complain("there is no type `" + options.type + "`" + did_you_mean(options.type, all_ids(registry)) +
             "; `behaviourlinks docs --list` names all" +
             (options.from.empty() ? ". Use --from SCENE for the types that a scene's scripts declare." : "."));
    return kBadInput;
  }
  print_page(*page);
  return kDone;
}

}  // namespace bl::cli
