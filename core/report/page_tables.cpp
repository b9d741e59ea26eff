// The tables of the page; every row that the model has is in one of them.
#include <algorithm>
#include <cmath>

#include "core/reading/figures.h"
#include "core/report/page.h"

namespace bl::report {

namespace {

constexpr std::size_t kMostConflicts = 60;

void head(drawing::Markup& page, std::string_view label, std::string_view unit = "", bool is_number = true) {
  page.open("th", {{"scope", "col"}, {"class", is_number ? "n" : "t"}}).text(label);
  if (!unit.empty()) page.element("small", unit);
  page.close();
}

void number_cell(drawing::Markup& page, const std::string& text, const std::string& more = "") {
  page.element("td", text, {{"class", more.empty() ? "n" : "n " + more}});
}

void open_table(drawing::Markup& page, const std::string& label, const std::string& caption) {
  page.open("div", {{"class", "wide"}, {"role", "region"}, {"aria-label", label}, {"tabindex", "0"}}).open("table");
  page.element("caption", caption);
}

// As a bar and in words; more than all fills the bar, the words say how much.
void met_cell(drawing::Markup& page, const reading::Account& account) {
  const std::string words = reading::share_of(account.volume, account.asked);
  page.open("td");
  if (account.asked > 0 && words.find('%') != std::string::npos) {
    page.open("span", {{"class", "bar"}, {"aria-hidden", "true"}});
    page.open("span", {{"style", "width:" + drawing::pixels(std::clamp(account.volume / account.asked, 0.0, 1.0) * 100) + "%"}})
        .close()
        .close();
  }
  page.text(words).close();
}

// What is missing by the measure that was asked for.
std::string short_text(const reading::Account& account, double tolerance) {
  return account.is_short(tolerance) ? reading::percent(account.short_share()) : "\xE2\x80\x93";
}

// Caps and other limits lower demands before the solver sees them.
std::string held_back(const reading::Account& all) {
  return all.withheld() > 0.001 * all.asked
             ? " Limits hold " + reading::quantity(all.withheld(), Unit::cubic_metre) + " of the demand back."
             : "";
}

void volume_row(drawing::Markup& page, const State& state, const reading::ReportModel& model, const reading::VolumeRow& volume,
                const drawing::Palette& palette) {
  const double tolerance = model.accounts.tolerance;
  const std::string standing = standing_of(volume, tolerance);
  const bool is_good = standing == "met";
  page.open("tr");
  number_cell(page, std::to_string(volume.number));
  page.element("th", volume.name, {{"scope", "row"}});
  page.open("td");
  write_use(page, volume.use, palette);
  page.close();
  number_cell(page, reading::readable(volume.asked));
  number_cell(page, reading::readable(volume.limited));
  number_cell(page, reading::readable(volume.volume));
  number_cell(page, reading::difference_of(volume.volume, volume.asked), is_good ? "" : "bad");
  number_cell(page, reading::readable(volume.floor_area));
  number_cell(page, volume.is_by_area ? reading::difference_of(volume.floor_area, volume.asked_area) : "\xE2\x80\x93",
              is_good ? "" : "bad");
  number_cell(page, reading::readable(volume.figures.surface_area));
  number_cell(page, reading::readable(volume.figures.footprint));
  number_cell(page, reading::readable(volume.figures.height));
  page.element("td", standing, {{"class", is_good ? "good" : "bad"}});
  const std::string why = volume.figures.state == "alive" ? why_short(state, model.accounts, volume) : "";
  page.element("td", volume.figures.reason + (volume.figures.reason.empty() || why.empty() ? "" : "; ") + why,
               {{"class", "reason"}})
      .close();
}

void use_row(drawing::Markup& page, const State& state, const reading::ReportModel& model, const reading::UseAccount& use,
             const drawing::Palette& palette) {
  const double tolerance = model.accounts.tolerance;
  page.open("tr").open("th", {{"scope", "row"}});
  write_use(page, use.use, palette);
  if (!use.is_in_programme) page.text(" *");
  page.close();
  number_cell(page, reading::readable(use.asked_area));
  number_cell(page, reading::readable(use.limited_area));
  number_cell(page, reading::readable(use.floor_area));
  number_cell(page, reading::difference_of(use.floor_area, use.asked_area));
  number_cell(page, std::to_string(use.volumes), use.volumes == 0 ? "bad" : "");
  met_cell(page, use);
  number_cell(page, short_text(use, tolerance), use.is_short(tolerance) ? "bad" : "");
  page.element("td", why_short(state, model.accounts, use), {{"class", "reason"}}).close();
}

// Rows of the programme that ask for ground; nothing where there are none.
void write_open_space(drawing::Markup& page, const reading::Accounts& accounts) {
  if (accounts.open.empty()) return;
  open_table(page, "Open space",
             "Ground that nobody builds on, by use. It counts as open in the figures of plots, and is no floor area.");
  page.open("thead").open("tr");
  head(page, "Use", "", false);
  head(page, "Asked for", "m\xC2\xB2");
  head(page, "Open", "m\xC2\xB2");
  head(page, "Difference");
  head(page, "Short");
  head(page, "Why", "", false);
  page.close().close().open("tbody");
  for (const reading::OpenAccount& open : accounts.open) {
    const bool is_short = open.is_short(accounts.tolerance);
    page.open("tr").element("th", open.use + (open.is_in_programme ? "" : " *"), {{"scope", "row"}});
    number_cell(page, reading::readable(open.asked));
    number_cell(page, reading::readable(open.area));
    number_cell(page, reading::difference_of(open.area, open.asked));
    number_cell(page, is_short ? reading::percent(open.missing_share()) : "\xE2\x80\x93", is_short ? "bad" : "");
    page.element("td", why_short(open, accounts.tolerance), {{"class", "reason"}}).close();
  }
  page.close().close().close();
}

}  // namespace

std::string standing_of(const reading::VolumeRow& volume, double tolerance) {
  if (volume.figures.state != "alive") return volume.figures.state.empty() ? "unknown" : volume.figures.state;
  return volume.is_short(tolerance) ? "short" : volume.difference() > tolerance ? "over" : "met";
}

void write_use(drawing::Markup& page, const std::string& use, const drawing::Palette& palette) {
  page.open("span", {{"class", "use"}});
  page.element("span", palette.letter(use), {{"class", "swatch"}, {"style", "background:" + hex(palette.colour(use))}});
  page.text(use.empty() ? "no use given" : use).close();
}

void write_programme(drawing::Markup& page, const reading::ReportModel& model, const State& state,
                     const drawing::Palette& palette) {
  const reading::Accounts& accounts = model.accounts;
  page.element("h2", "Programme", {{"id", "programme"}});
  if (accounts.uses.empty()) {
    page.element("p", "The scene has no programme and no volumes.");
    write_open_space(page, accounts);
    return;
  }
  const bool has_own = std::any_of(accounts.uses.begin(), accounts.uses.end(),
                                   [](const reading::UseAccount& use) { return !use.is_in_programme; });
  open_table(
      page, "Programme",
      "Floor area by use. The bar shows how much of the volume asked for there is." + held_back(accounts.all) +
          std::string(has_own ? " Uses with * stand in no programme; their area follows from what their volumes ask for." : ""));
  page.open("thead").open("tr");
  head(page, "Use", "", false);
  head(page, "Asked for", "m\xC2\xB2");
  head(page, "Limited to", "m\xC2\xB2");
  head(page, "Reached", "m\xC2\xB2");
  head(page, "Difference");
  head(page, "Volumes");
  head(page, "Volume met", "", false);
  head(page, "Short");
  head(page, "Why", "", false);
  page.close().close().open("tbody");
  for (const reading::UseAccount& use : accounts.uses) use_row(page, state, model, use, palette);
  page.close().open("tfoot").open("tr").element("th", "All uses", {{"scope", "row"}});
  number_cell(page, reading::readable(accounts.all.asked_area));
  number_cell(page, reading::readable(accounts.all.limited_area));
  number_cell(page, reading::readable(accounts.all.floor_area));
  number_cell(page, reading::difference_of(accounts.all.floor_area, accounts.all.asked_area));
  number_cell(page, std::to_string(model.volumes.size()));
  met_cell(page, accounts.all);
  number_cell(page, short_text(accounts.all, accounts.tolerance));
  page.element("td", "").close().close().close().close();
  write_open_space(page, accounts);
}

void write_volumes(drawing::Markup& page, const reading::ReportModel& model, const State& state,
                   const drawing::Palette& palette) {
  page.element("h2", "Volumes", {{"id", "volumes"}});
  if (model.volumes.empty()) {
    page.element("p", "The scene has no volumes.");
    return;
  }
  open_table(page, "Volumes",
             "Every volume, numbered as in the drawings. Met: within " + reading::percent(model.accounts.tolerance) +
                 " of what was asked for; where a programme asks, of its floor area too.");
  page.open("thead").open("tr");
  head(page, "No.");
  head(page, "Name", "", false);
  head(page, "Use", "", false);
  head(page, "Asked for", "m\xC2\xB3");
  head(page, "Limited to", "m\xC2\xB3");
  head(page, "Volume", "m\xC2\xB3");
  head(page, "Difference");
  head(page, "Floor area", "m\xC2\xB2");
  head(page, "Difference");
  head(page, "Surface", "m\xC2\xB2");
  head(page, "Footprint", "m\xC2\xB2");
  head(page, "Height", "m");
  head(page, "State", "", false);
  head(page, "Reason", "", false);
  page.close().close().open("tbody");
  double surface = 0;
  for (const reading::VolumeRow& volume : model.volumes) {
    volume_row(page, state, model, volume, palette);
    surface += volume.figures.surface_area;
  }
  // Of the volumes alone: a use that no volume has asks in the programme's table.
  reading::Account sum;
  for (const reading::VolumeRow& volume : model.volumes) sum.add(volume);
  page.close().open("tfoot").open("tr");
  page.element("th", "All", {{"scope", "row"}, {"colspan", "3"}});
  number_cell(page, reading::readable(sum.asked));
  number_cell(page, reading::readable(sum.limited));
  number_cell(page, reading::readable(sum.volume));
  number_cell(page, reading::difference_of(sum.volume, sum.asked));
  number_cell(page, reading::readable(sum.floor_area));
  number_cell(page, "");
  number_cell(page, reading::readable(surface));
  page.element("td", "", {{"colspan", "4"}});
  page.close().close().close().close();
}

void write_conflicts(drawing::Markup& page, const reading::ReportModel& model) {
  page.element("h2", "Conflicts", {{"id", "conflicts"}});
  const std::string minor =
      model.minor_conflicts == 0 ? "" : reading::counted(model.minor_conflicts, "port") + " under a tension too small to matter.";
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
    const reading::ConflictRow& row = model.conflicts[i];
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

// Everybody who pulls, with how often and how hard: who stands in most conflicts stands first.
void write_pullers(drawing::Markup& page, const reading::ReportModel& model) {
  if (model.pullers.empty()) return;
  open_table(
      page, "Conflicts by link and person",
      "Who stands in these conflicts, in how many of them, and how hard: tension against the size of what is pulled at, shared "
      "evenly among those who pull.");
  page.open("thead").open("tr");
  head(page, "Who", "", false);
  head(page, "Kind", "", false);
  head(page, "Conflicts");
  head(page, "Share");
  page.close().close().open("tbody");
  for (const reading::PullerRow& row : model.pullers) {
    page.open("tr").element("th", row.link.empty() ? "People, by hand" : row.link, {{"scope", "row"}}).element("td", row.kind);
    number_cell(page, std::to_string(row.conflicts));
    number_cell(page, reading::percent(row.share));
    page.close();
  }
  page.close().close().close();
}

void write_problems(drawing::Markup& page, const reading::ReportModel& model) {
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
  for (const reading::ProblemRow& row : model.problems)
    page.open("tr").element("th", row.place, {{"scope", "row"}}).element("td", row.message).close();
  page.close().close().close();
}

}  // namespace bl::report
