// The table of figures, with the step from each source to 100 m² of gross floor area.
#include "core/making/use_rates.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "core/base/text.h"
#include "core/base/words.h"

namespace bl::making {

namespace {

// Open space: it is known by its name alone. Areas outside of buildings are no floor area (DIN 277, Außenanlagenfläche).
constexpr std::string_view kOpenSource =
    "open space by its name: an area outside of buildings (DIN 277); sun: BRE 209 (2022), two hours on 21 March on half of it";

constexpr std::size_t kMostNamed = 4;  // uses in a sentence

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
        "100 m² (LBO Baden-Württemberg, 37); sun: EN 17037, least level; noise: DIN 18005, residential area; depth: Apartment "
        "Design Guide (New South Wales, 2015), 2E: 12 to 18 m from glass to glass",
        false, 15},
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

// Further words for uses: as a whole name, or also as the last word of one, as in `start-up office`.
struct UseWord {
  std::string_view word, use;
  bool is_whole = false;
};
constexpr UseWord kUseWords[] = {{"home", "housing"},
                                 {"dwelling", "housing"},
                                 {"flat", "housing"},
                                 {"apartment", "housing"},
                                 {"residence", "housing"},
                                 {"townhouse", "housing"},
                                 {"residential", "housing", true},
                                 {"living", "housing", true},
                                 {"assisted living", "housing", true},
                                 {"workspace", "offices"},
                                 {"co-working", "offices", true},
                                 {"coworking", "offices", true},
                                 {"co-working space", "offices", true},
                                 {"coworking space", "offices", true},
                                 {"retail", "shops"},
                                 {"supermarket", "shops"},
                                 {"café", "shops"},
                                 {"cafe", "shops"},
                                 {"restaurant", "shops"},
                                 {"pub", "shops"},
                                 {"department store", "shops", true}};

// What a brief calls floors that lie below the ground.
constexpr std::array kCellarUses{std::string_view("underground parking"),
                                 std::string_view("underground car park"),
                                 std::string_view("underground garage"),
                                 std::string_view("basement parking"),
                                 std::string_view("basement garage"),
                                 std::string_view("underground storage"),
                                 std::string_view("cellar"),
                                 std::string_view("cellars"),
                                 std::string_view("basement"),
                                 std::string_view("parking below ground")};

}  // namespace

bool is_cellar_use(const std::string& use) {
  const std::string lower = lower_case(use);
  return std::find(kCellarUses.begin(), kCellarUses.end(), lower) != kCellarUses.end();
}

namespace {

bool is_same_word(std::string_view known, std::string_view name) {
  if (known == name) return true;
  const std::string_view longer = known.size() > name.size() ? known : name, shorter = known.size() > name.size() ? name : known;
  return longer.size() == shorter.size() + 1 && longer.ends_with('s') && longer.starts_with(shorter);
}

const UseRates* rates_called(std::string_view name) {
  const auto found = std::find_if(kUses.begin(), kUses.end(), [&](const UseRates& one) { return is_same_word(one.use, name); });
  return found == kUses.end() ? nullptr : &*found;
}

const UseRates* rates_by_word(std::string_view name, bool is_last) {
  for (const UseWord& word : kUseWords)
    if ((!is_last || !word.is_whole) && is_same_word(word.word, name)) return rates_called(word.use);
  return nullptr;
}

// Later rows of a use have numbers: "shop 2".
std::string_view without_number(std::string_view name) {
  const std::size_t end = name.find_last_not_of("0123456789 ");
  return end == std::string_view::npos ? name : name.substr(0, end + 1);
}

}  // namespace

const UseRates* use_rates(std::string_view use) {
  const std::string lower = lower_case(std::string(use));
  const std::string_view of = without_place(lower), name = without_number(of);
  // Open space is known by its whole name alone.
  if (const UseRates* rates = rates_called(name)) return rates->is_open && of != lower ? nullptr : rates;
  if (const UseRates* rates = rates_by_word(name, false)) return rates;
  const std::size_t space = name.find_last_of(" -_/");
  if (space == std::string_view::npos) return nullptr;
  const std::string_view last = name.substr(space + 1);
  const UseRates* rates = rates_called(last);
  if (rates != nullptr && !rates->is_open) return rates;
  return rates_by_word(last, true);
}

std::string tell_taken_uses(const std::vector<std::string>& uses) {
  std::map<std::string_view, std::string> taken;
  for (const std::string& use : uses) {
    const UseRates* rates = use_rates(use);
    const std::string lower = lower_case(use);
    if (rates == nullptr || rates->is_open || is_same_word(rates->use, without_number(lower))) continue;
    std::string& list = taken[rates->use];
    list += (list.empty() ? "`" : ", `") + use + "`";
  }
  std::string words;
  for (const auto& [kind, list] : taken)
    words +=
        (words.empty() ? "Figures of `" + std::string(kind) + "` were taken for " : ", of `" + std::string(kind) + "` for ") +
        list;
  return words.empty() ? words : words + ": change them at their nodes of the type `use`.";
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
  std::size_t count = 0;
  for (const std::string& one : wanted)
    if (!one.empty() && !known.contains(one) && ++count <= kMostNamed) list += (list.empty() ? "`" : ", `") + one + "`";
  if (!is_looked_for || list.empty()) return "";
  if (count > kMostNamed) list += " and " + std::to_string(count - kMostNamed) + " more";
  const bool is_one = count == 1;
  return std::string("No figures are known of the use") + (is_one ? " " : "s ") + list + ": " + (is_one ? "its" : "their") +
         " people, parking places and trips do not count until " + (is_one ? "it" : "each") + " has a node of the type `use`.";
}

}  // namespace bl::making
