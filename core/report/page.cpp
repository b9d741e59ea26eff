// Puts the page together: what came out, how it looks, who got what, and how it can be had again.
#include "core/report/page.h"

#include <cmath>

#include "core/reading/figures.h"
#include "core/reading/views/solver.h"
#include "core/report/figure_tables.h"

namespace bl::report {

namespace {

std::string title_of(const reading::ReportModel& model, const ReportData& data) {
  if (!model.title.empty()) return model.title;
  const std::size_t slash = data.scene_path.find_last_of("/\\");
  const std::string name = slash == std::string::npos ? data.scene_path : data.scene_path.substr(slash + 1);
  return name.empty() ? "Untitled scene" : name;
}

void key(drawing::Markup& page, const std::string& label, const std::string& figure, const std::string& note) {
  page.open("div").element("dt", label).open("dd").text(figure).element("small", note).close().close();
}

// Of plots all land, of solvers what is left of it to build on: each figure says which it means.
void write_land(drawing::Markup& page, const reading::ReportModel& model, const State& state) {
  if (model.plots_area > 0)
    key(page, "Gross land", reading::quantity(model.plots_area, Unit::square_metre),
        "of all plots, with streets and water in them; buildings that stay are not counted as built");
  for (const auto& [node, ground] : reading::rows<reading::StandingFigures>(state))
    if (ground.plot_area > 0)
      key(page, "Net land", reading::quantity(ground.plot_area, Unit::square_metre),
          "that may be built on, with open space: FSI " + reading::grouped(ground.fsi, 2) + ", GSI " +
              reading::grouped(ground.gsi, 2) + " on it");
}

void write_keys(drawing::Markup& page, const reading::ReportModel& model, const State& state) {
  const bool has_site = model.plan_area > 0;
  const reading::UseAccount& all = model.accounts.all;
  page.open("dl", {{"class", "keys"}});
  key(page, "Plan area", has_site ? reading::quantity(model.plan_area, Unit::square_metre) : "\xE2\x80\x93",
      has_site ? std::string("inside the boundary, seen from above") + (model.accounts.open.empty() ? "" : ", with open space")
               : "no boundary");
  write_land(page, model, state);
  key(page, "Floor area asked for", reading::quantity(all.asked_area, Unit::square_metre),
      all.is_in_programme ? "by the programme and by people" : "what the volumes asked for make");
  key(page, "Floor area reached", reading::quantity(all.floor_area, Unit::square_metre),
      reading::share_of(all.floor_area, all.asked_area) + " of what is asked for");
  if (const reading::OpenAccount open = reading::sum_of(model.accounts.open); !model.accounts.open.empty())
    key(page, "Open space", reading::quantity(open.area, Unit::square_metre),
        open.is_in_programme ? "of " + reading::quantity(open.asked, Unit::square_metre) + " asked for"
                             : "kept open, without being asked for");
  // As in the table of plots, whose rules mean the whole plot, courts and gardens that nobody may build on included.
  const double land = model.plots_area > 0 ? model.plots_area : model.plan_area;
  key(page, "Floor space index", land > 0 ? reading::grouped(all.floor_area / land, 2) : "\xE2\x80\x93",
      model.plots_area > 0 ? "floor area to gross land" : "floor area to plan area");
  key(page, "Volume", reading::quantity(all.volume, Unit::cubic_metre),
      reading::share_of(all.volume, all.asked) + " of what is asked for");
  key(page, "Fill", reading::share_of(all.volume, model.site_volume), "of the space inside the boundary");
  key(page, "Volumes", reading::grouped(static_cast<double>(model.volumes.size())),
      model.shapes == model.volumes.size() ? "all have a shape"
                                           : std::to_string(model.volumes.size() - model.shapes) + " without a shape");
  const bool is_short = model.accounts.worst_short > model.accounts.tolerance;
  key(page, "Short", is_short ? reading::percent(model.accounts.worst_short) : "nobody",
      is_short ? model.accounts.worst + ", the worst" : "all have what is asked for");
  // An error against an aim of nothing is no percentage.
  const bool has_error = model.worst != nullptr && model.worst->limited > 1e-3;
  key(page, "Worst error", has_error ? reading::percent(std::abs(model.worst->error())) : "\xE2\x80\x93",
      model.worst ? model.worst->name : "no volumes");
  page.close();
}

void write_header(drawing::Markup& page, const reading::ReportModel& model, const ReportData& data) {
  page.open("header").element("h1", title_of(model, data));
  if (!model.about.empty()) page.element("p", model.about, {{"class", "about"}});
  page.open("div", {{"class", "outcome"}});
  page.element("span", model.is_settled ? "\xE2\x9C\x93 Settled" : "\xE2\x9C\x97 Not settled",
               {{"class", model.is_settled ? "badge good" : "badge bad"}});
  page.element("span", data.outcome).close();
  write_keys(page, model, *data.state);
  page.close();
}

void write_figure(drawing::Markup& page, const drawing::Picture& picture, const reading::ReportModel& model,
                  const drawing::Palette* legend) {
  page.open("figure").raw(picture.svg);
  if (legend != nullptr && !model.accounts.uses.empty()) {
    page.open("ul", {{"class", "uses"}, {"aria-label", "Colours and letters of the uses"}});
    for (const reading::UseAccount& use : model.accounts.uses) {
      page.open("li");
      write_use(page, use.use, *legend);
      page.close();
    }
    page.close();
  }
  if (!picture.caption.empty()) page.element("figcaption", picture.caption);
  page.close();
}

void write_notes(drawing::Markup& page, const reading::ReportModel& model, const drawing::Palette& palette) {
  page.element("h2", "Legend and how figures are measured", {{"id", "notes"}});
  page.open("ul", {{"class", "uses"}});
  for (const reading::UseAccount& use : model.accounts.uses) {
    page.open("li");
    write_use(page, use.use, palette);
    page.close();
  }
  page.close();
  const auto note = [&](const std::string& text) { page.element("p", text); };
  note(
      "Volume is that of the shape: the part of a volume's cell, its share of the space inside the boundary, that lies within "
      "reach of its position. "
      "Asked for is what the programme, people and links ask for together; limited to is what caps and other limits leave of it, "
      "and what the volume aims at. Short is what is missing against what was asked for, whoever asked: of the volume, and where "
      "a "
      "programme asks, of the floor area, whichever share is larger.");
  note(
      "Floor area is the sum of horizontal sections through the middle of each storey, gross, without deductions for walls, "
      "shafts or stairs. It follows the "
      "shape, so it differs a little from volume divided by storey height. Floor space index is floor area divided by the "
      "area of the plots, or by the plan area of the boundary where there are none.");
  note(
      "Footprint is what a volume covers seen from above, whether it stands on the ground or not; volumes above each other both "
      "count theirs. Surface is the "
      "whole outer surface with the parts shared with neighbours. Height is measured from the lowest to the highest point.");
  note("States: met, short and over compare with what was asked for, within the tolerance of " +
       reading::percent(model.tolerance) +
       "; hidden, outside, coincident and starved volumes have no shape, and the reason says why.");
  note("The shapes are massing studies: room for a building, not a building. All lengths are in metres.");
}

void write_footer(drawing::Markup& page, const reading::ReportModel& model, const ReportData& data) {
  page.open("footer").open("dl");
  const auto row = [&](const std::string& label, const std::string& text) { page.element("dt", label).element("dd", text); };
  row("Scene", data.scene_path.empty() ? "not from a file" : data.scene_path);
  row("Ticks", std::to_string(model.tick));
  row("State", "hash " + model.hash +
                   ": with the same version of the program, the same scene and log give this hash on every x86-64 machine");
  row("Made by",
      "BehaviourLinks, behaviourlinks run --report; beside this page lie shapes in volumes.obj and a table for spreadsheets "
      "of everything on it: volumes.csv, uses.csv, conflicts.csv and others");
  if (!model.mesh_note.empty()) row("Meshes", model.mesh_note);
  page.close().close();
}

}  // namespace

std::string write_page(const reading::ReportModel& model, const ReportData& data, const drawing::Palette& palette) {
  drawing::Markup page;
  page.raw("<!DOCTYPE html>\n");
  page.open("html", {{"xmlns", "http://www.w3.org/1999/xhtml"}, {"lang", "en"}}).open("head");
  page.leaf("meta", {{"charset", "utf-8"}})
      .leaf("meta", {{"name", "viewport"}, {"content", "width=device-width, initial-scale=1"}});
  page.element("title", title_of(model, data) + ": report");
  page.open("style").raw(page_style()).close().close();
  page.open("body");
  if (model.tick == 0) {
    // Nothing has been computed: figures would be those that volumes are born with.
    page.open("main").element("h1", title_of(model, data)).element("p", data.outcome).close();
    write_footer(page, model, data);
    page.close().close();
    return page.str();
  }
  write_header(page, model, data);
  page.open("main");
  page.element("h2", "The proposal");
  write_figure(page, draw_axonometry(model, palette), model, &palette);
  write_figure(page, draw_plan(*data.state, model, palette), model, &palette);
  page.element("h2", "The negotiation");
  write_figure(page, drawing::draw_error_chart(model, data.history), model, nullptr);
  write_programme(page, model, *data.state, palette);
  write_volumes(page, model, *data.state, palette);
  write_facades(page, model, *data.state);
  write_figure_tables(page, *data.state);
  write_pictures(page, *data.state);
  write_conflicts(page, model);
  write_pullers(page, model);
  write_problems(page, model);
  write_notes(page, model, palette);
  page.close();
  write_footer(page, model, data);
  page.close().close();
  return page.str();
}

}  // namespace bl::report
