// `docs`: catalogue pages of typifications, link kinds and commands, from their declarations.
#include <sys/stat.h>
#include <cerrno>
#include <cstring>
#include <optional>

#include "core/base/text.h"
#include "core/define/catalogue.h"
#include "core/file/file_io.h"
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

int print_list() {
  const Registry& registry = full_registry();
  list_types("typification", registry.typifications(), {"name", "what it is"});
  print_line();
  list_types("link kind", registry.links(), {"name", "what it does"});
  print_line();
  list_types("command", registry.commands(), {"name", "what it does"});
  return kDone;
}

std::optional<std::string> page_of(const std::string& id) {
  const Registry& registry = full_registry();
  // An id may stand for a typification and a link kind at once; then both pages are shown.
  std::string page;
  if (const auto* type = registry.typification(id)) page += catalogue_page(*type, registry);
  if (const auto* kind = registry.link(id)) page += (page.empty() ? "" : "\n") + catalogue_page(*kind, registry);
  if (const auto* command = registry.command(id)) page += (page.empty() ? "" : "\n") + catalogue_page(*command);
  if (page.empty()) return std::nullopt;
  return page;
}

std::vector<std::string> all_ids() {
  std::vector<std::string> ids = keys_of(full_registry().typifications());
  for (const auto& [id, kind] : full_registry().links()) ids.push_back(id);
  for (const auto& [id, command] : full_registry().commands()) ids.push_back(id);
  return ids;
}

Result<void> make_folder(const std::string& path) {
  if (::mkdir(path.c_str(), 0777) == 0) return {};
  struct stat status {};
  if (errno == EEXIST && ::stat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode)) return {};
  return Error{ErrorCode::io, path,
               errno == EEXIST ? "is a file, not a folder" : std::string("cannot be made: ") + std::strerror(errno)};
}

Result<std::size_t> write_pages(const std::string& folder) {
  const Registry& registry = full_registry();
  std::vector<std::pair<std::string, std::string>> files{{"README.md", catalogue_index(registry)}};
  for (const auto& [id, type] : registry.typifications())
    files.emplace_back("nodes/" + id + ".md", catalogue_page(type, registry));
  for (const auto& [id, kind] : registry.links()) files.emplace_back("links/" + id + ".md", catalogue_page(kind, registry));
  for (const auto& [id, command] : registry.commands()) files.emplace_back("commands/" + id + ".md", catalogue_page(command));
  for (const char* part : {"", "/nodes", "/links", "/commands"})
    if (auto made = make_folder(folder + part); !made) return made.error();
  for (const auto& [name, text] : files)
    if (auto written = write_file(folder + "/" + name, text); !written) return written.error();
  return files.size();
}

}  // namespace

int docs_command(const DocsOptions& options) {
  if (!options.out.empty()) {
    const auto written = write_pages(options.out);
    if (!written) {
      print_error(options.out, written.error());
      return kBadInput;
    }
    print_line("wrote " + counted(*written, "page") + " to " + options.out);
    return kDone;
  }
  if (options.is_list || options.type.empty()) return print_list();
  const auto page = page_of(options.type);
  if (!page) {
    complain("there is no type `" + options.type + "`" + did_you_mean(options.type, all_ids()) +
             "; `behaviourlinks docs --list` names all.");
    return kBadInput;
  }
  print_page(*page);
  return kDone;
}

}  // namespace bl::cli
