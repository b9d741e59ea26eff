// Reads briefs, and what is missing from the figures that statistics and lists show.
#include "ui/desktop/panels/brief_uses.h"

#include <algorithm>
#include <map>
#include <set>

#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/define/json_text.h"
#include "core/reading/views/programme.h"
#include "core/reading/views/volume.h"
#include "ui/desktop/panels/panel_memory.h"
#include "ui/desktop/panels/statistics_record.h"

namespace bl::desktop {

namespace {

using reading::VolumeFigures;

// All briefs of a scene.
std::vector<Shared<Table>> briefs_of(const Scene& scene) {
  std::vector<Shared<Table>> briefs;
  for (const auto& [id, node] : scene.nodes)
    if (const auto rows = reading::setting<&reading::ProgrammeFigures::rows>(scene, full_registry(), node))
      briefs.push_back(*rows);
  return briefs;
}

// No volume has these; in small letters, as the programme compares them.
std::set<std::string> open_uses(const Scene& scene) {
  std::set<std::string> uses;
  for (const auto& [id, node] : scene.nodes)
    if (const auto kind = reading::settings_of<reading::UseKind>(scene, full_registry(), node); kind && kind->is_open)
      uses.insert(lower_case(kind->use));
  return uses;
}

// Those that volumes can have.
std::vector<std::string> uses_of_briefs(const Scene& scene) {
  std::vector<std::string> uses;
  const std::set<std::string> open = open_uses(scene);
  for (const Shared<Table>& brief : briefs_of(scene))
    for (std::size_t row = 0; row < brief->rows.size(); ++row)
      if (const std::string& use = brief->text(row, "use");
          !use.empty() && !open.contains(lower_case(use)) && std::find(uses.begin(), uses.end(), use) == uses.end())
        uses.push_back(use);
  return uses;
}

std::string use_of_volume(const Scene& scene, const NodeRecord& node) {
  return reading::setting<&reading::VolumeFigures::use>(scene, full_registry(), node).value_or("");
}

// What the first brief that speaks of a use lets its volumes stand on; empty where none does.
std::string standing_of_use(const Scene& scene, const std::string& use) {
  for (const Shared<Table>& brief : briefs_of(scene))
    for (std::size_t row = 0; row < brief->rows.size(); ++row)
      if (brief->text(row, "use") == use) return brief->text(row, "standing");
  return "";
}

}  // namespace

std::vector<std::string> known_uses(const Scene& scene) {
  std::vector<std::string> uses = uses_of_briefs(scene);
  std::set<std::string> others;
  for (const auto& [id, node] : scene.nodes) others.insert(use_of_volume(scene, node));
  for (const std::string& use : others)
    if (!use.empty() && std::find(uses.begin(), uses.end(), use) == uses.end()) uses.push_back(use);
  return uses;
}

std::vector<std::string> uses_by_need(Workbench& editor) {
  std::vector<std::string> uses = uses_of_briefs(editor.scene());
  const reading::ReportModel& figures = memory_of(editor).record->figures(editor);
  std::map<std::string, double> missing;  // [m²]
  for (const reading::UseAccount& use : figures.accounts.uses) missing[use.use] = use.missing_area();
  // A volume that no tick knows yet was added a moment ago: its use is seen to. One that ticks have left with nothing is not.
  const Plan& known = *editor.moment->ticked->plan;
  for (const auto& [id, node] : editor.scene().nodes)
    if (const std::string use = use_of_volume(editor.scene(), node); !use.empty() && known.node_index(id) >= known.nodes.size())
      missing[use] = 0;
  std::stable_sort(uses.begin(), uses.end(), [&](const auto& a, const auto& b) { return missing[a] > missing[b]; });
  return uses;
}

void tell_uses(Workbench& editor, const std::vector<std::string>& nodes) {
  std::set<std::string> uses;
  for (const std::string& id : nodes)
    if (const auto node = editor.scene().nodes.find(id); node != editor.scene().nodes.end())
      if (const std::string use = use_of_volume(editor.scene(), node->second); !use.empty()) uses.insert(use);
  if (uses.empty()) return;
  std::string names;
  for (const std::string& use : uses) names += (names.empty() ? "`" : ", `") + use + "`";
  editor.notify(NoticeKind::told,
                (uses.size() == 1 ? "It takes the use " + names + ", which lacks the most, and a share of its demand"
                                  : "They take the uses that lack the most, " + names) +
                    "; choose another in the inspector.");
}

std::string first_values(Workbench& editor, const std::string& type, std::size_t number) {
  Json values = Json::object();
  const std::vector<std::string> uses =
      type == reading::type_of<reading::VolumeFigures>() ? uses_by_need(editor) : std::vector<std::string>();
  if (!uses.empty()) {
    const std::string &use = uses[number % uses.size()], standing = standing_of_use(editor.scene(), use);
    values[reading::port_name_of<&reading::VolumeFigures::use>()] = use;
    // Only what differs from the default is said.
    NodeRecord fresh;
    fresh.types[type];
    const auto usual = reading::setting<&reading::VolumeFigures::standing>(editor.scene(), full_registry(), fresh);
    if (!standing.empty() && standing != usual) values[reading::port_name_of<&reading::VolumeFigures::standing>()] = standing;
  }
  return write_json_line(values);
}

}  // namespace bl::desktop
