// Reads briefs by the names of their ports, and what is missing from the figures that statistics and lists show.
#include "ui/desktop/panels/brief_uses.h"

#include <algorithm>
#include <map>
#include <set>

#include <nlohmann/json.hpp>

#include "core/define/json_text.h"
#include "ui/desktop/panels/panel_memory.h"
#include "ui/desktop/panels/statistics_record.h"

namespace bl::desktop {

namespace {

// All briefs of a scene that have a table.
std::vector<const Table*> briefs_of(const Scene& scene) {
  std::vector<const Table*> briefs;
  for (const auto& [id, node] : scene.nodes) {
    const auto programme = node.types.find("programme");
    if (programme == node.types.end()) continue;
    const auto rows = programme->second.find("rows");
    if (rows == programme->second.end()) continue;
    if (const auto* table = std::get_if<Shared<Table>>(&rows->second)) briefs.push_back(&**table);
  }
  return briefs;
}

std::vector<std::string> uses_of_briefs(const Scene& scene) {
  std::vector<std::string> uses;
  for (const Table* brief : briefs_of(scene))
    for (std::size_t row = 0; row < brief->rows.size(); ++row)
      if (const std::string& use = brief->text(row, "use");
          !use.empty() && std::find(uses.begin(), uses.end(), use) == uses.end())
        uses.push_back(use);
  return uses;
}

std::string use_of_volume(const NodeRecord& node) {
  const auto volume = node.types.find("smart_volume");
  if (volume == node.types.end()) return "";
  const auto use = volume->second.find("use");
  const auto* text = use == volume->second.end() ? nullptr : std::get_if<std::string>(&use->second);
  return text == nullptr ? std::string() : *text;
}

// What the first brief that speaks of a use lets its volumes stand on; empty where none does.
std::string standing_of_use(const Scene& scene, const std::string& use) {
  for (const Table* brief : briefs_of(scene))
    for (std::size_t row = 0; row < brief->rows.size(); ++row)
      if (brief->text(row, "use") == use) return brief->text(row, "standing");
  return "";
}

}  // namespace

std::vector<std::string> known_uses(const Scene& scene) {
  std::vector<std::string> uses = uses_of_briefs(scene);
  std::set<std::string> others;
  for (const auto& [id, node] : scene.nodes) others.insert(use_of_volume(node));
  for (const std::string& use : others)
    if (!use.empty() && std::find(uses.begin(), uses.end(), use) == uses.end()) uses.push_back(use);
  return uses;
}

std::vector<std::string> uses_by_need(Workbench& editor) {
  std::vector<std::string> uses = uses_of_briefs(editor.scene());
  const report::ReportModel& figures = memory_of(editor).record->figures(editor);
  std::map<std::string, double> missing;  // [m²]
  for (const report::UseAccount& use : figures.accounts.uses) missing[use.use] = use.missing_area();
  // A volume that no tick knows yet was added a moment ago: its use is seen to. One that ticks have left with nothing is not.
  const Plan& known = *editor.moment->ticked->plan;
  for (const auto& [id, node] : editor.scene().nodes)
    if (const std::string use = use_of_volume(node); !use.empty() && known.node_index(id) >= known.nodes.size()) missing[use] = 0;
  std::stable_sort(uses.begin(), uses.end(), [&](const auto& a, const auto& b) { return missing[a] > missing[b]; });
  return uses;
}

void tell_uses(Workbench& editor, const std::vector<std::string>& nodes) {
  std::set<std::string> uses;
  for (const std::string& id : nodes)
    if (const auto node = editor.scene().nodes.find(id); node != editor.scene().nodes.end())
      if (const std::string use = use_of_volume(node->second); !use.empty()) uses.insert(use);
  if (uses.empty()) return;
  std::string names;
  for (const std::string& use : uses) names += (names.empty() ? "`" : ", `") + use + "`";
  editor.tell(NoticeKind::told, (uses.size() == 1 ? "It takes the use " + names + ", which lacks most, and a share of its demand"
                                                  : "They take the uses that lack most, " + names) +
                                    "; choose another in the inspector.");
}

std::string first_values(Workbench& editor, const std::string& type, std::size_t number) {
  Json values = Json::object();
  if (type == "smart_volume")
    if (const std::vector<std::string> uses = uses_by_need(editor); !uses.empty()) {
      const std::string& use = uses[number % uses.size()];
      values["use"] = use;
      // Only what differs from the default is said.
      if (const std::string standing = standing_of_use(editor.scene(), use); !standing.empty() && standing != "stack")
        values["standing"] = standing;
    }
  return write_json_line(values);
}

}  // namespace bl::desktop
