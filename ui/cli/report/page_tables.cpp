// The tables of the page; every row that the model has is in one of them.
#include <algorithm>
#include <cmath>

#include "ui/cli/report/figures.h"
#include "ui/cli/report/page.h"

namespace bl::report {

namespace {

constexpr std::size_t kMostConflicts = 60;

void head(Markup& page, std::string_view label, std::string_view unit = "", bool is_number = true) {
  page.open("th", {{"scope", "col"}, {"class", is_number ? "n" : "t"}}).text(label);
  if (!unit.empty()) page.element("small", unit);
  page.close();
}

void number_cell(Markup& page, const std::string& text, const std::string& more = "") {
  page.element("td", text, {{"class", more.empty() ? "n" : "n " + more}});
}

void open_table(Markup& page, const std::string& label, const std::string& caption) {
  page.open("div", {{"class", "wide"}, {"role", "region"}, {"aria-label", label}, {"tabindex", "0"}}).open("table");
  page.element("caption", caption);
}

// As a bar and in words; more than all fills the bar, the words say how much.
void met_cell(Markup& page, double volume, double wanted) {
  page.open("td");
  if (!(wanted > 0)) {
    page.text("\xE2\x80\x93").close();
    return;
  }
  const double share = volume / wanted;
  page.open("span", {{"class", "bar"}, {"aria-hidden", "true"}});
  page.open("span", {{"style", "width:" + pixels(std::clamp(share, 0.0, 1.0) * 100) + "%"}}).close().close();
  page.text(percent(share)).close();
}

std::string difference(double reached, double wanted) {
  return wanted > 0 ? signed_percent((reached - wanted) / wanted) : "\xE2\x80\x93";
}

// Caps and other limits lower demands before the solver sees them.
std::string held_back(const ReportModel& model) {
  const double held = model.demand - model.wanted;
  return held > 0.001 * model.demand ? " Limits hold " + quantity(held, Unit::cubic_metre) + " of the demand back." : "";
}

void volume_row(Markup& page, const VolumeRow& volume, const Palette& palette, double tolerance) {
  const std::string standing = standing_of(volume, tolerance);
  const bool is_good = standing == "met";
  page.open("tr");
  number_cell(page, std::to_string(volume.number));
  page.element("th", volume.name, {{"scope", "row"}});
  page.open("td");
  write_use(page, volume.use, palette);
  page.close();
  number_cell(page, readable(volume.wanted));
  number_cell(page, readable(volume.volume));
  number_cell(page, difference(volume.volume, volume.wanted), is_good ? "" : "bad");
  number_cell(page, readable(volume.floor_area));
  number_cell(page, readable(volume.surface_area));
  number_cell(page, readable(volume.footprint));
  number_cell(page, readable(volume.height));
  page.element("td", standing, {{"class", is_good ? "good" : "bad"}});
  std::string reason = volume.reason;
  // What was asked for and what is aimed at differ where a limit holds.
  if (std::abs(volume.demand - volume.wanted) > 0.005 * std::max(volume.demand, 1.0))
    reason += (reason.empty() ? "" : "; ") + std::string("asked for ") + quantity(volume.demand, Unit::cubic_metre) + ", limited";
  page.element("td", reason, {{"class", "reason"}}).close();
}

}  // namespace

std::string standing_of(const VolumeRow& volume, double tolerance) {
  if (volume.state != "alive") return volume.state.empty() ? "unknown" : volume.state;
  return std::abs(volume.error()) <= tolerance ? "met" : volume.error() < 0 ? "short" : "over";
}

void write_use(Markup& page, const std::string& use, const Palette& palette) {
  page.open("span", {{"class", "use"}});
  page.element("span", palette.letter(use), {{"class", "swatch"}, {"style", "background:" + hex(palette.colour(use))}});
  page.text(use.empty() ? "no use given" : use).close();
}

void write_programme(Markup& page, const ReportModel& model, const Palette& palette) {
  page.element("h2", "Programme", {{"id", "programme"}});
  if (model.uses.empty()) {
    page.element("p", "The scene has no programme and no volumes.");
    return;
  }
  const bool has_own = std::any_of(model.uses.begin(), model.uses.end(), [](const UseRow& use) { return !use.is_in_programme; });
  open_table(page, "Programme",
             "Floor area by use. The bar shows how much of the volume asked for there is." + held_back(model) +
                 std::string(has_own ? " Uses with * stand in no programme; their area follows from the demands of their volumes."
                                     : ""));
  page.open("thead").open("tr");
  head(page, "Use", "", false);
  head(page, "Wanted", "m\xC2\xB2");
  head(page, "Reached", "m\xC2\xB2");
  head(page, "Difference");
  head(page, "Volumes");
  head(page, "Demand met", "", false);
  page.close().close().open("tbody");
  for (const UseRow& use : model.uses) {
    page.open("tr").open("th", {{"scope", "row"}});
    write_use(page, use.use, palette);
    if (!use.is_in_programme) page.text(" *");
    page.close();
    number_cell(page, readable(use.wanted_floor_area));
    number_cell(page, readable(use.floor_area));
    number_cell(page, difference(use.floor_area, use.wanted_floor_area));
    number_cell(page, std::to_string(use.count), use.count == 0 ? "bad" : "");
    met_cell(page, use.volume, use.demand);
    page.close();
  }
  page.close().open("tfoot").open("tr").element("th", "All uses", {{"scope", "row"}});
  number_cell(page, readable(model.wanted_floor_area));
  number_cell(page, readable(model.floor_area));
  number_cell(page, difference(model.floor_area, model.wanted_floor_area));
  number_cell(page, std::to_string(model.volumes.size()));
  met_cell(page, model.volume, model.demand);
  page.close().close().close().close();
}

void write_volumes(Markup& page, const ReportModel& model, const Palette& palette) {
  page.element("h2", "Volumes", {{"id", "volumes"}});
  if (model.volumes.empty()) {
    page.element("p", "The scene has no volumes.");
    return;
  }
  open_table(page, "Volumes",
             "Every volume, numbered as in the drawings. Met: within " + percent(model.tolerance) + " of its demand.");
  page.open("thead").open("tr");
  head(page, "No.");
  head(page, "Name", "", false);
  head(page, "Use", "", false);
  head(page, "Demand", "m\xC2\xB3");
  head(page, "Volume", "m\xC2\xB3");
  head(page, "Error");
  head(page, "Floor area", "m\xC2\xB2");
  head(page, "Surface", "m\xC2\xB2");
  head(page, "Footprint", "m\xC2\xB2");
  head(page, "Height", "m");
  head(page, "State", "", false);
  head(page, "Reason", "", false);
  page.close().close().open("tbody");
  double surface = 0;
  for (const VolumeRow& volume : model.volumes) {
    volume_row(page, volume, palette, model.tolerance);
    surface += volume.surface_area;
  }
  page.close().open("tfoot").open("tr");
  page.element("th", "All", {{"scope", "row"}, {"colspan", "3"}});
  number_cell(page, readable(model.wanted));
  number_cell(page, readable(model.volume));
  number_cell(page, difference(model.volume, model.wanted));
  number_cell(page, readable(model.floor_area));
  number_cell(page, readable(surface));
  page.element("td", "", {{"colspan", "4"}});
  page.close().close().close().close();
}

void write_conflicts(Markup& page, const ReportModel& model) {
  page.element("h2", "Conflicts", {{"id", "conflicts"}});
  const std::string minor =
      model.minor_conflicts == 0 ? "" : counted(model.minor_conflicts, "port") + " under a tension too small to matter.";
  if (model.conflicts.empty()) {
    page.element("p", "No links pull against each other. " + minor);
    return;
  }
  const std::size_t shown = std::min(kMostConflicts, model.conflicts.size());
  std::string caption =
      "Tension is how far proposals disagree with what came of them; the hardest conflicts, measured against the size of what is "
      "pulled at, come first.";
  if (shown < model.conflicts.size())
    caption += " The first " + std::to_string(shown) + " of " + std::to_string(model.conflicts.size()) + ".";
  if (!minor.empty()) caption += " Besides, " + minor;
  open_table(page, "Conflicts", caption);
  page.open("thead").open("tr");
  head(page, "Node", "", false);
  head(page, "Port", "", false);
  head(page, "Tension");
  head(page, "Who pulls, and how", "", false);
  page.close().close().open("tbody");
  for (std::size_t i = 0; i < shown; ++i) {
    const ConflictRow& row = model.conflicts[i];
    page.open("tr").element("th", row.node, {{"scope", "row"}}).element("td", row.port);
    number_cell(page, row.tension);
    page.open("td").open("ul", {{"class", "plain"}});
    for (std::size_t k = 0; k < std::min<std::size_t>(row.pulls.size(), 8); ++k) page.element("li", row.pulls[k]);
    if (row.pulls.size() > 8) page.element("li", "and " + std::to_string(row.pulls.size() - 8) + " more");
    if (row.pulls.empty()) page.element("li", "a limit of the port itself");
    page.close().close().close();
  }
  page.close().close().close();
}

void write_problems(Markup& page, const ReportModel& model) {
  page.element("h2", "Problems", {{"id", "problems"}});
  if (model.problems.empty()) {
    page.element("p", "No node and no link reported an error.");
    return;
  }
  open_table(page, "Problems", "Nodes and links that failed keep their last good output; the rest runs on.");
  page.open("thead").open("tr");
  head(page, "Where", "", false);
  head(page, "What", "", false);
  page.close().close().open("tbody");
  for (const ProblemRow& row : model.problems)
    page.open("tr").element("th", row.place, {{"scope", "row"}}).element("td", row.message).close();
  page.close().close().close();
}

}  // namespace bl::report
