// The parts of the page on façades and on pictures; both are left out where the scene has none.
#include <algorithm>
#include <map>

#include "core/reading/figures.h"
#include "core/reading/views/facade.h"
#include "core/reading/views/surroundings.h"
#include "core/report/page.h"

namespace bl::report {

namespace {

// "north_east" as "north-east".
std::string spoken_style(std::string name) {
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

struct Glazing {
  double area = 0, glazed = 0, cost = 0;
};

void row_of(drawing::Markup& page, const std::string& name, const std::string& style, const Glazing& part) {
  page.open("tr").element("th", name, {{"scope", "row"}}).element("td", style);
  const auto cell = [&](const std::string& text) { page.element("td", text, {{"class", "n"}}); };
  cell(reading::readable(part.area));
  cell(reading::readable(part.glazed));
  cell(reading::readable(part.area - part.glazed));
  cell(part.area > 0 ? reading::percent(part.glazed / part.area) : "\xE2\x80\x93");
  cell(reading::readable(part.cost));
  page.close();
}

void open_table(drawing::Markup& page, const std::string& id, const std::string& caption,
                std::initializer_list<const char*> heads) {
  const std::string heading = id == "facades" ? "Fa\xC3\xA7"
                                                "ades"
                                              : "Pictures";
  page.element("h2", heading, {{"id", id}});
  page.open("div", {{"class", "wide"}, {"role", "region"}, {"aria-label", heading}, {"tabindex", "0"}}).open("table");
  page.element("caption", caption);
  page.open("thead").open("tr");
  std::size_t column = 0;
  for (const char* head : heads)
    page.element("th", head, {{"scope", "col"}, {"class", id == "facades" && column++ >= 2 ? "n" : "t"}});
  page.close().close().open("tbody");
}

}  // namespace

void write_facades(drawing::Markup& page, const reading::ReportModel& model, const State& state) {
  std::map<std::size_t, Glazing> sides;
  std::vector<std::string> names;
  Glazing all;
  bool is_open = false;
  for (const reading::VolumeRow& volume : model.volumes) {
    const auto facade = reading::row_of<reading::FacadeFigures>(state, volume.node);
    if (!facade || facade->style_in_force.empty()) continue;
    if (!is_open)
      open_table(page, "facades",
                 "Steep surface above the ground that no neighbour covers, dressed by a style; cost by the prices of the style.",
                 {"Name", "Style",
                  "Fa\xC3\xA7"
                  "ade m\xC2\xB2",
                  "Glazed m\xC2\xB2", "Opaque m\xC2\xB2", "Glazed", "Cost \xE2\x82\xAC"});
    is_open = true;
    const Glazing own{facade->facade_area, facade->glazed_area, facade->cost};
    row_of(page, volume.name, facade->style_in_force, own);
    all.area += own.area;
    all.glazed += own.glazed;
    all.cost += own.cost;
    const Table& table = *facade->by_orientation;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
      if (names.size() <= row) names.push_back(table.text(row, "orientation"));
      sides[row].area += table.number(row, "area");
      sides[row].glazed += table.number(row, "glazed");
      sides[row].cost += table.number(row, "cost");
    }
  }
  if (!is_open) return;
  for (const auto& [row, side] : sides)
    if (side.area > 0) row_of(page, "towards " + spoken_style(names[row]), "", side);
  page.close().open("tfoot");
  row_of(page, "All", "", all);
  page.close().close().close();
}

void write_pictures(drawing::Markup& page, const State& state) {
  std::size_t veiled = 0;
  bool is_open = false;
  for (const auto& [node, media] : reading::rows<reading::MediaFigures>(state)) {
    if (!media.is_free) {
      ++veiled;
      continue;
    }
    if (!is_open) open_table(page, "pictures", "Pictures that may be shown.", {"Name", "File", "Author", "Licence", "Taken"});
    is_open = true;
    page.open("tr").element("th", state.plan->nodes[node].name, {{"scope", "row"}});
    for (const std::string* text : {&media.file, &media.author, &media.licence, &media.taken}) page.element("td", *text);
    page.close();
  }
  if (is_open) page.close().close().close();
  if (veiled > 0)
    page.element("p", (veiled == 1 ? "One picture of the scene is left out here"
                                   : std::to_string(veiled) + " pictures of the scene are left out here") +
                          std::string(", because nobody has said that it may be shown."));
}

}  // namespace bl::report
