// Fields that name things: sets of nodes, ports of typifications, words.
#include <algorithm>
#include <set>

#include "core/reading/figures.h"
#include "ui/desktop/panels/inspector_quantity.h"
#include "ui/desktop/panels/inspector_value.h"

namespace bl::desktop {

namespace {

// So many entries of a list are drawn; the search field finds the others.
constexpr int kMostEntries = 200;

std::string type_label(const Workbench& editor, const std::string& id) {
  const TypificationDefinition* type = editor.types().typification(id);
  return type != nullptr ? type->label : id;
}

std::vector<std::string> labels_of(const Workbench& editor, const Selection& selection) {
  std::vector<std::string> labels;
  if (!selection.typification.empty()) labels.push_back("every " + type_label(editor, selection.typification));
  if (!selection.tag.empty()) labels.push_back((labels.empty() ? "every node tagged " : "that is tagged ") + selection.tag);
  for (const std::string& id : selection.ids) labels.push_back(editor.name_of(id));
  return labels;
}

// The selection with one of its chips taken away.
Selection without(Selection selection, std::size_t chip) {
  if (chip < selection.ids.size()) selection.ids.erase(selection.ids.begin() + static_cast<std::ptrdiff_t>(chip));
  return selection;
}

// Ports that a number can be read from, or proposed to.
bool is_countable(ValueKind kind) {
  return kind == ValueKind::number || kind == ValueKind::integer || kind == ValueKind::boolean;
}

struct Found {
  std::set<std::string> types, tags;
};

Found types_and_tags(const Scene& scene) {
  Found found;
  const std::string base(kBaseNode);
  for (const auto& [id, node] : scene.nodes)
    for (const auto& [type, values] : node.types) {
      if (type != base) found.types.insert(type);
      for (const auto& [port, value] : values)
        if (const auto* texts = std::get_if<Shared<std::vector<std::string>>>(&value); texts != nullptr && type == base)
          found.tags.insert((*texts)->begin(), (*texts)->end());
    }
  return found;
}

void caption(Workbench& editor, const char* text) {
  ImGui::Dummy({0, editor.theme.px(2)});
  small_text(editor, text, editor.theme.colours().text_faint, -1);
}

// The list behind "choose": roles and tags make a query, nodes a list of names; the last press counts.
std::optional<Selection> selection_list(Workbench& editor, const Selection& now) {
  std::optional<Selection> chosen;
  const std::string& filter = memory_of(editor).filter;
  filter_field(editor, ImGui::GetContentRegionAvail().x);
  const Found found = types_and_tags(editor.scene());
  if (!found.types.empty()) caption(editor, "all nodes with a role");
  for (const std::string& type : found.types) {
    const std::string label = "every " + type_label(editor, type);
    if (!passes_filter(filter, label) || !list_entry(editor, label, "", now.typification == type)) continue;
    chosen = Selection{{}, now.typification == type ? std::string() : type, now.is_query() ? now.tag : std::string()};
  }
  if (!found.tags.empty()) caption(editor, "all nodes with a tag");
  for (const std::string& tag : found.tags) {
    if (!passes_filter(filter, tag) || !list_entry(editor, "tagged " + tag, "", now.tag == tag)) continue;
    chosen = Selection{{}, now.is_query() ? now.typification : std::string(), now.tag == tag ? std::string() : tag};
  }
  caption(editor, "single nodes");
  int drawn = 0;
  for (const auto& [id, node] : editor.scene().nodes) {
    const std::string label = node.name.empty() ? id : node.name + "  " + id;
    if (!passes_filter(filter, label)) continue;
    if (++drawn > kMostEntries) {
      small_text(editor, "there are more: search for them", editor.theme.colours().text_faint, -1);
      break;
    }
    const bool is_in = std::binary_search(now.ids.begin(), now.ids.end(), id);
    if (!list_entry(editor, label, "", is_in)) continue;
    chosen = Selection{now.ids, {}, {}};
    if (is_in) std::erase(chosen->ids, id);
    else chosen->ids.insert(std::upper_bound(chosen->ids.begin(), chosen->ids.end(), id), id);
  }
  return chosen;
}

}  // namespace

std::optional<Selection> selection_field(Workbench& editor, const std::string& key, const Selection& selection, bool is_mixed,
                                         float width) {
  std::optional<Selection> chosen;
  const std::vector<std::string> labels = is_mixed ? std::vector<std::string>{} : labels_of(editor, selection);
  std::string shown = is_mixed             ? "several"
                      : labels.empty()     ? "choose nodes"
                      : labels.size() == 1 ? "one node"
                                           : reading::counted(labels.size(), "node");
  if (!is_mixed && selection.is_query()) shown = labels.front() + (labels.size() > 1 ? " " + labels.back() : "");
  if (begin_list(editor, key, shown, width, labels.empty() ? editor.theme.colours().text_faint : 0)) {
    chosen = selection_list(editor, selection);
    ImGui::EndPopup();
  }
  constexpr std::size_t kMostChips = 12;
  // A query is said in one line above; nodes are named one by one.
  if (is_mixed || selection.is_query()) return chosen;
  std::vector<std::string> seen(labels.begin(),
                                labels.begin() + static_cast<std::ptrdiff_t>(std::min(labels.size(), kMostChips)));
  int clicked = -1;
  if (const int gone = chips(editor, key + "/chips", seen, false, &clicked); gone >= 0)
    chosen = without(selection, static_cast<std::size_t>(gone));
  if (labels.size() > kMostChips)
    small_text(editor, "and " + std::to_string(labels.size() - kMostChips) + " more", editor.theme.colours().text_faint, -1);
  // A press on a node's name goes to the node.
  if (clicked >= 0 && static_cast<std::size_t>(clicked) < selection.ids.size())
    editor.picks.only_node(selection.ids[static_cast<std::size_t>(clicked)]);
  return chosen;
}

std::optional<Change> texts_field(Workbench& editor, const Subject& subject, float width) {
  const auto& texts = *std::get<Shared<std::vector<std::string>>>(subject.value);
  std::optional<Change> change;
  if (subject.is_mixed)
    small_text(editor, "several; a word typed here is added to each", editor.theme.colours().text_faint, width);
  if (!subject.is_mixed && !texts.empty())
    if (const int gone = chips(editor, subject.key + "/chips", texts, false); gone >= 0) {
      std::vector<std::string> fresh = texts;
      fresh.erase(fresh.begin() + gone);
      change = constant(Shared<std::vector<std::string>>(std::move(fresh)));
    }
  CellLook look;
  look.hint = "add a word";
  const CellEvent event = cell(editor, subject.key, "", "", width, look);
  if (!event.is_typed || event.text.empty()) return change;
  return Change{[word = event.text](const Value& old) {
                  std::vector<std::string> fresh = *std::get<Shared<std::vector<std::string>>>(old);
                  if (std::find(fresh.begin(), fresh.end(), word) == fresh.end()) fresh.push_back(word);
                  return Value(Shared<std::vector<std::string>>(std::move(fresh)));
                },
                false};
}

std::optional<Change> port_field(Workbench& editor, const Subject& subject, float width) {
  const auto& chosen = std::get<std::string>(subject.value);
  std::optional<Change> change;
  const Colours& c = editor.theme.colours();
  const auto label = [&](const std::string& type, const std::string& port) {
    return type_label(editor, type) + " \xC2\xB7 " + label_of(port);
  };
  const auto path = parse_port_path(chosen);
  const std::string shown = subject.is_mixed ? "several"
                            : path           ? label(path->typification, path->port)
                            : chosen.empty() ? "choose a port"
                                             : chosen;
  if (begin_list(editor, subject.key, shown, width, subject.is_mixed || chosen.empty() ? c.text_faint : 0)) {
    filter_field(editor, ImGui::GetContentRegionAvail().x);
    const std::string& filter = memory_of(editor).filter;
    for (const auto& [id, type] : editor.types().typifications())
      for (const PortDefinition& port : type.ports) {
        const std::string text = id + "." + port.id, name = label(id, port.id);
        if (!is_countable(port.kind)) continue;
        if (!passes_filter(filter, text) && !passes_filter(filter, name)) continue;
        if (!list_entry(editor, name, filter.empty() ? "" : port.doc, text == chosen)) continue;
        change = constant(text);
        ImGui::CloseCurrentPopup();
      }
    ImGui::EndPopup();
  }
  return change;
}

}  // namespace bl::desktop
