// The table of figures, with the step from each source to 100 m² of gross floor area.
#include "core/making/use_rates.h"

#include <algorithm>
#include <array>
#include <set>

#include "core/base/text.h"

namespace bl::making {

namespace {

// Open space: it is known by its name alone. Areas outside of buildings are no floor area (DIN 277, Außenanlagenfläche).
constexpr std::string_view kOpenSource =
    "open space by its name: an area outside of buildings (DIN 277); sun: BRE 209 (2022), two hours on 21 March on half of it";

constexpr UseRates open_space(std::string_view use) { return {use, 0, 0, 0, 0.5, 7200, 0, kOpenSource, true}; }

// Sources give net areas; four fifths of the gross floor area are net.
// housing: 47.4 m² of living space for each person: 0.8 · 100 / 47.4 = 1.7 people, 3.1 trips each; one place for each dwelling of
// 100 m².
// offices: 12 m² net for each workplace: 0.8 · 100 / 12 = 6.7 people; one place for 35 m²: 0.8 · 100 / 35 = 2.3.
// shops: 17.5 m² net for each workplace: 4.6 people; one place for 40 m²: 2.0.
constexpr std::array kUses{
    UseRates{
        "housing", 1.7, 1.0, 5.3, 0.8, 5400, 55,
        "people: Destatis 2022, 47.4 m² of living space each; trips: MiD 2017, 3.1 a person; parking: one for each dwelling of "
        "100 m² (LBO Baden-Württemberg, 37); sun: EN 17037, least level; noise: DIN 18005, residential area"},
    UseRates{
        "offices", 6.7, 2.3, 0, 0.1, 0, 65,
        "people: HCA Employment Density Guide 2015, 12 m² net each; parking: VwV Stellplätze Baden-Württemberg 2015, one for 30 "
        "to 40 m²; noise: DIN 18005, commercial area; no source for trips: enter them"},
    UseRates{
        "shops", 4.6, 2.0, 0, 0.5, 0, 65,
        "people: HCA Employment Density Guide 2015, 15 to 20 m² net each; parking: VwV Stellplätze Baden-Württemberg 2015, one "
        "for 30 to 50 m²; noise: DIN 18005, commercial area; no source for trips: enter them"},
    open_space("garden"),
    open_space("park"),
    open_space("square"),
    open_space("plaza"),
    open_space("playground"),
    open_space("courtyard"),
    open_space("green"),
    open_space("lawn"),
    open_space("open space"),
};

}  // namespace

const UseRates* use_rates(std::string_view use) {
  // Briefs write the same use in both numbers, and names of open space with capitals.
  const std::string lower = lower_case(std::string(use));
  const auto is_same = [&](const UseRates& known) {
    const std::string_view name = known.is_open ? std::string_view(lower) : use;
    if (known.use == name) return true;
    const std::string_view longer = known.use.size() > name.size() ? known.use : name;
    const std::string_view shorter = known.use.size() > name.size() ? name : known.use;
    return longer.size() == shorter.size() + 1 && longer.ends_with('s') && longer.starts_with(shorter);
  };
  const auto found = std::find_if(kUses.begin(), kUses.end(), is_same);
  return found == kUses.end() ? nullptr : &*found;
}

std::string tell_uses_without_figures(const Scene& scene, const Registry& registry) {
  const TypificationDefinition *use = registry.typification("use"), *volume = registry.typification("smart_volume");
  if (use == nullptr || volume == nullptr) return "";
  std::set<std::string> known, wanted;
  bool is_looked_for = false;
  for (const auto& [id, node] : scene.nodes) {
    is_looked_for = is_looked_for || node.types.contains("use") || node.types.contains("programme");
    if (node.types.contains("use")) known.insert(std::get<std::string>(set_value(scene, node, *use, *use->find_port("use"))));
    if (node.types.contains("smart_volume"))
      wanted.insert(std::get<std::string>(set_value(scene, node, *volume, *volume->find_port("use"))));
  }
  std::string list;
  for (const std::string& one : wanted)
    if (!one.empty() && !known.contains(one)) list += (list.empty() ? "`" : ", `") + one + "`";
  if (!is_looked_for || list.empty()) return "";
  const bool is_one = list.find(',') == std::string::npos;
  return std::string("No figures are known of the use") + (is_one ? " " : "s ") + list + ": " + (is_one ? "its" : "their") +
         " people, parking places and trips do not count until " + (is_one ? "it" : "each") + " has a node of the type `use`.";
}

}  // namespace bl::making
