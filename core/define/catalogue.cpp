// Writing the catalogue pages.
#include "core/define/catalogue.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/define/codec.h"
#include "core/define/no_value.h"

namespace bl {

namespace {

std::string cell(std::string text) {
  std::string safe;
  for (const char c : text) safe += c == '|' ? std::string("\\|") : c == '\n' ? std::string(" ") : std::string(1, c);
  return safe;
}

std::string range_of(const PortDefinition& port) {
  if (!port.choices.empty()) {
    std::string list;
    for (const ChoiceDefinition& choice : port.choices) list += (list.empty() ? "`" : ", `") + choice.id + "`";
    return list;
  }
  if (port.kind != ValueKind::number && port.kind != ValueKind::integer) return "";
  std::string text;
  if (!std::isinf(port.hard_minimum)) text += "from " + shortest(port.hard_minimum);
  if (!std::isinf(port.hard_maximum)) text += (text.empty() ? "to " : " to ") + shortest(port.hard_maximum);
  return text;
}

std::string default_of(const PortDefinition& port) {
  if (port.is_required) return "required";
  if (port.of_scene == OfScene::always) return "the scene's setting";
  if (port.is_computed) return "";
  const std::string text = write_json_line(value_to_json(port.default_value, port));
  if (value_of_none(port)) return std::string(kNoneWord) + ", `" + text + "`";
  return text == "\"\"" || text == "[]"
             ? ""
             : "`" + text + "`" + (port.of_scene == OfScene::unless_set ? ", or the scene's setting" : "");
}

std::string unit_of(const PortDefinition& port) {
  if (!port.unit_from.empty()) return "as `" + port.unit_from + "`";
  return std::string(info(port.unit).pretty);
}

void port_table(std::string& page, const TypeDefinition& type, bool is_computed, const std::string& title) {
  bool is_open = false;
  for (const PortDefinition& port : type.ports) {
    if (port.is_computed != is_computed) continue;
    if (!is_open)
      page += "## " + title + "\n\n| id | kind | unit | " + (is_computed ? "" : "default | range | links | ") + "meaning |\n" +
              (is_computed ? "|---|---|---|---|\n" : "|---|---|---|---|---|---|---|\n");
    is_open = true;
    page += "| `" + port.id + "` | " + std::string(kind_text(port.kind, port.made)) + " | " + unit_of(port) + " | ";
    if (!is_computed)
      page += cell(default_of(port)) + " | " + range_of(port) + " | " +
              (port.rule == CombineRule::none ? "" : std::string(name_of(port.rule))) + " | ";
    page += cell(port.doc) + " |\n";
  }
  if (is_open) page += "\n";
  for (const PortDefinition& port : type.ports) {
    if (port.is_computed != is_computed) continue;
    if (!port.columns.empty()) page += "Columns of `" + port.id + "`:\n\n";
    for (const ColumnDefinition& column : port.columns) {
      const std::string unit(info(column.unit).pretty);
      page += "- `" + column.id + "`" + (unit.empty() ? "" : " [" + unit + "]") + (column.is_required ? " (required)" : "") +
              (column.list == ListOf::nothing ? "" : " (a list in each row)") + ": " + column.doc + "\n";
    }
    if (!port.columns.empty()) page += "\n";
    for (const ChoiceDefinition& choice : port.choices) page += "- `" + port.id + "` = `" + choice.id + "`: " + choice.doc + "\n";
    if (!port.choices.empty()) page += "\n";
  }
}

std::string head(const TypeDefinition& type, const char* sort) {
  return "# " + type.label + "\n\n`" + type.id + "` · " + sort + "\n\n" + type.doc + "\n\n";
}

std::string path_text(const PortPath& path) {
  return path.chosen_by.empty() ? "`" + path.typification + "." + path.port + "`" : "the port chosen in `" + path.chosen_by + "`";
}

// Does the link read or change a port of this typification at this end? Derived, so that nobody keeps a second list.
bool needs(const LinkDefinition& kind, End end, const std::string& typification) {
  return std::any_of(kind.reads.begin(), kind.reads.end(),
                     [&](const LinkRead& r) { return r.end == end && r.path.typification == typification; }) ||
         std::any_of(kind.proposes.begin(), kind.proposes.end(),
                     [&](const LinkWrite& w) { return w.end == end && w.path.typification == typification; });
}

}  // namespace

std::string catalogue_page(const TypificationDefinition& type, const Registry& registry) {
  std::string page = head(type, "typification");
  port_table(page, type, false, "Settings");
  port_table(page, type, true, "Results");
  for (const SetDefinition& set : type.sets) {
    page += "For every node that `" + set.selection + "` names, it reads";
    for (const ReadDefinition& read : set.reads) page += " " + path_text(read.path) + ",";
    page.back() = set.writes.empty() ? '.' : ';';
    if (!set.writes.empty()) page += " it writes";
    for (const WriteDefinition& write : set.writes) page += " " + path_text(write.path) + ",";
    page.back() = '.';
    page += "\n\n";
  }
  for (const End end : {End::from, End::to}) {
    std::string kinds;
    for (const auto& [id, kind] : registry.links())
      if (needs(kind, end, type.id)) kinds += (kinds.empty() ? "`" : ", `") + id + "`";
    if (!kinds.empty()) page += std::string("Links that ") + (end == End::from ? "start" : "end") + " here: " + kinds + ".\n\n";
  }
  return page;
}

std::string catalogue_page(const LinkDefinition& kind, const Registry& registry) {
  std::string page = head(kind, "link kind");
  port_table(page, kind, false, "Parameters");
  page += "## Ends\n\n| end | reads | proposes |\n|---|---|---|\n";
  for (const End end : {End::from, End::to}) {
    std::string reads, proposes;
    for (const LinkRead& read : kind.reads)
      if (read.end == end)
        reads += (reads.empty() ? "" : ", ") +
                 (read.is_lock ? "whether " + path_text(read.path) + " is locked" : path_text(read.path)) +
                 (read.is_optional ? " where there is one" : "");
    for (const LinkWrite& write : kind.proposes)
      if (write.end == end) {
        proposes += (proposes.empty() ? "" : ", ") + path_text(write.path);
        if (const auto port = registry.port(write.path)) proposes += " (" + std::string(name_of((*port)->rule)) + ")";
        if (write.is_optional) proposes += " where there is one";
      }
    page += "| " + std::string(name_of(end)) + (kind.is_whole(end) ? " (the whole set at once)" : "") + " | " + reads + " | " +
            proposes + " |\n";
  }
  return page + "\n";
}

std::string catalogue_page(const CommandDefinition& command) {
  std::string page = head(command, "command");
  port_table(page, command, false, "Arguments");
  return page;
}

std::string catalogue_index(const Registry& registry) {
  std::string page = "# Catalogue\n\nMade from the declarations in the code.\n\n";
  auto list = [&](const char* title, const auto& types) {
    page += std::string("## ") + title + "\n\n| id | name | what it does |\n|---|---|---|\n";
    for (const auto& [id, type] : types) page += "| `" + id + "` | " + type.label + " | " + cell(type.doc) + " |\n";
    page += "\n";
  };
  list("Typifications", registry.typifications());
  list("Link kinds", registry.links());
  list("Commands", registry.commands());
  return page;
}

}  // namespace bl
