// Collects problems from the state; bands with a margin keep rows from changing places in every tick.
#include "ui/desktop/panels/problems_list.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "ui/cli/report/figures.h"
#include "ui/cli/report/place_problems.h"
#include "ui/desktop/panels/inspector_quantity.h"

namespace bl::desktop {

namespace {

// A row changes its band when it is this far beyond the edge, in powers of two; it comes in at 0 and goes at -1.
constexpr double kMargin = 0.35;
// A use is short when this share of it is missing; it stays listed until only half of that is.
constexpr double kShort = 0.02;

int band_of(double severity, const int* before) {
  const double exact = std::log2(severity / report::kMinorSeverity);
  const int band = static_cast<int>(std::floor(exact));
  if (before == nullptr) return band;
  return exact > *before - kMargin && exact < *before + 1 + kMargin ? *before : band;
}

std::string number_word(std::size_t count) {
  constexpr const char* kWords[] = {"No",    "One",   "Two",  "Three", "Four",   "Five",  "Six",
                                    "Seven", "Eight", "Nine", "Ten",   "Eleven", "Twelve"};
  return count < std::size(kWords) ? kWords[count] : report::grouped(static_cast<double>(count));
}

std::string lower_first(std::string text) {
  if (!text.empty() && text[0] >= 'A' && text[0] <= 'Z') text[0] = static_cast<char>(text[0] - 'A' + 'a');
  return text;
}

// A link that fails, or one that runs and says what it cannot reach.
std::string what_of(const State& state, const std::string& link) {
  for (std::size_t l = 0; l < state.links.size(); ++l)
    if (state.plan->links[l].id == link && state.links[l].remark)
      return state.links[l].remark == LinkRemark::unmet ? "A rule cannot be met"
                                                        : "Not everything that is asked for has a volume";
  return "Link " + link + " fails";
}

}  // namespace

const char* label_of(ProblemKind kind) {
  switch (kind) {
    case ProblemKind::conflict: return "Conflicts";
    case ProblemKind::shortage: return "Shortages";
    case ProblemKind::failing: return "Failures";
    case ProblemKind::no_room: return "Without room";
    case ProblemKind::place: return "Places";
    case ProblemKind::idle: return "Switched off";
    case ProblemKind::file: return "File";
  }
  return "";
}

std::size_t ProblemList::pressing() const { return items_.size() - count(ProblemKind::idle); }

void ProblemList::add_conflicts(const State& state) {
  std::map<PortRef, int> bands;
  std::vector<std::size_t> order;
  for (const report::TensePort& tense : report::tense_ports(state)) {
    const auto before = bands_.find(tense.ref);
    const bool was_there = before != bands_.end();
    if (tense.severity < report::kMinorSeverity * (was_there ? 0.5 : 1)) continue;
    const int band = std::max(0, band_of(tense.severity, was_there ? &before->second : nullptr));
    bands.emplace(tense.ref, band);
    ProblemItem item;
    item.kind = ProblemKind::conflict;
    item.band = band;
    item.tense = tense;
    item.nodes = {state.plan->nodes[tense.ref.node].id};
    items_.push_back(std::move(item));
  }
  bands_ = std::move(bands);
  // Ascending ports within a band: ids do not change, severities do.
  std::stable_sort(items_.begin(), items_.end(), [](const ProblemItem& a, const ProblemItem& b) { return a.band > b.band; });
}

void ProblemList::write(const State& state, ProblemItem& item) const {
  if (item.kind != ProblemKind::conflict || !item.text.empty()) return;
  const report::ConflictRow row = report::conflict_row(state, item.tense);
  const PortDefinition& port = state.plan->port(item.tense.ref);
  std::set<std::string> links(row.links.begin(), row.links.end());
  links.erase("");
  const std::string what = lower_first(label_of(port.id)) + " of " + row.node;
  item.subject = links.empty()
                     ? "A limit holds the " + what
                     : number_word(links.size()) + (links.size() == 1 ? " link pulls" : " links pull") + " on the " + what;
  for (const std::string& pull : row.pulls) item.text += (item.text.empty() ? "" : "; ") + pull;
  item.text += (item.text.empty() ? "" : "; ") + std::string("tension ") + row.tension;
  item.links.assign(links.begin(), links.end());
}

void ProblemList::add_shortages(const State& state, const report::ReportModel& figures) {
  if (state.tick == 0) return;
  std::map<std::string, bool> now_short;
  for (const report::UseRow& use : figures.uses) {
    if (!use.is_in_programme || !(use.wanted_floor_area > 0)) continue;
    const double missing = use.wanted_floor_area - use.floor_area, share = missing / use.wanted_floor_area;
    if (share < kShort * (short_uses_.contains(use.use) ? 0.5 : 1)) continue;
    now_short[use.use] = true;
    ProblemItem item{ProblemKind::shortage, "use/" + use.use, 0, false, "Not all " + use.use + " can be had", "", {}, {}, {}};
    item.text = "the brief asks for " + report::quantity(use.wanted_floor_area, Unit::square_metre) + ", there are " +
                report::quantity(use.floor_area, Unit::square_metre) + ": " + report::quantity(missing, Unit::square_metre) +
                " (" + report::percent(share) + ") go without, in " + report::counted(use.count, "volume");
    for (const report::VolumeRow& volume : figures.volumes)
      if (volume.use == use.use) item.nodes.push_back(volume.id);
    items_.push_back(std::move(item));
  }
  short_uses_ = std::move(now_short);
}

// Where a solver says that not everything can be had: each volume that gets less than it wants.
void ProblemList::add_losers(const State& state, const report::ReportModel& figures) {
  const bool is_short = std::any_of(items_.begin(), items_.end(),
                                    [](const ProblemItem& i) { return i.kind == ProblemKind::shortage && i.is_error; });
  if (!is_short) return;
  const double tolerance = std::max(state.plan->settings.tolerance, 1e-6);
  for (const report::VolumeRow& volume : figures.volumes) {
    const double missing = volume.wanted - volume.volume;
    if (!(volume.wanted > 0) || missing <= tolerance * volume.wanted) continue;
    ProblemItem item{
        ProblemKind::shortage, "volume/" + volume.id, 0, false, volume.name + " falls short", "", {}, {volume.id}, {}};
    item.text = "it has " + report::quantity(volume.volume, Unit::cubic_metre) + " of the " +
                report::quantity(volume.wanted, Unit::cubic_metre) +
                " that it wants: " + report::quantity(missing, Unit::cubic_metre) + " (" +
                report::percent(missing / volume.wanted) + ") are missing";
    items_.push_back(std::move(item));
  }
}

void ProblemList::add_failures(const State& state, const report::ReportModel& problems) {
  for (const bool is_shortage : {true, false})
    for (const report::ProblemRow& row : problems.problems) {
      if (row.is_place || row.is_shortage != is_shortage || (is_shortage && state.tick == 0)) continue;
      // Ghosts hinder nobody: they stand among what does not run.
      if (const auto& links = state.plan->scene.links;
          !row.link.empty() && links.contains(row.link) && !links.at(row.link).ghost.empty())
        continue;
      ProblemItem item{
          is_shortage ? ProblemKind::shortage : ProblemKind::failing, row.place, 0, true, "", row.message, {}, {}, {}};
      item.subject = is_shortage        ? "The boundary is too small"
                     : row.node.empty() ? what_of(state, row.link)
                                        : row.place.substr(5) + " fails";
      if (!row.node.empty()) item.nodes = {row.node};
      if (!row.link.empty()) item.links = {row.link};
      items_.push_back(std::move(item));
    }
}

void ProblemList::add_volumes(const State& state, const report::ReportModel& figures) {
  if (state.tick == 0) return;
  for (const report::VolumeRow& volume : figures.volumes) {
    if (volume.state == "alive" || volume.reason.empty()) continue;
    items_.push_back(
        {ProblemKind::no_room, volume.id, 0, false, volume.name + " is " + volume.state, volume.reason, {}, {volume.id}, {}});
  }
}

void ProblemList::add_places(const State& state) {
  for (report::PlaceProblem& problem : report::place_problems(state)) {
    // Heights change from tick to tick, who hangs does not.
    ProblemItem item{ProblemKind::place, "place", 0, false, problem.subject, problem.text, {}, problem.nodes, problem.links};
    for (const std::string& node : problem.nodes) item.key += "/" + node;
    items_.push_back(std::move(item));
  }
}

void ProblemList::add_idle(const State& state) {
  for (const LinkPlan& link : state.plan->links) {
    if (link.definition == nullptr) {
      items_.push_back({ProblemKind::idle,
                        link.id,
                        0,
                        false,
                        "Link " + link.id + " does not run",
                        "this program does not know its kind; it is kept and saved as it is",
                        {},
                        {},
                        {link.id}});
      continue;
    }
    if (link.is_enabled && !link.is_muted) continue;
    const std::string& kind = link.definition->label;
    items_.push_back(
        {ProblemKind::idle,
         link.id,
         0,
         false,
         "Link " + link.id + (link.is_enabled ? " is muted" : " is off"),
         kind + (link.is_enabled ? ": it is evaluated, but what it says does not count" : ": it is not evaluated at all"),
         {},
         {},
         {link.id}});
  }
}

void ProblemList::add_file(const Editor& editor) {
  const std::string file = editor.problem_file.substr(editor.problem_file.find_last_of('/') + 1);
  for (std::size_t k = 0; k < editor.problems.size(); ++k) {
    const Problem& problem = editor.problems[k];
    const std::string& place = problem.error.place;
    const bool is_script = place.starts_with("scripts/");
    ProblemItem item{ProblemKind::file,
                     "file/" + std::to_string(k),
                     problem.is_error ? 1 : 0,
                     problem.is_error,
                     is_script ? place.substr(place.find('/') + 1) + ".lua" : file,
                     is_script ? problem.error.message : problem.error.text(),
                     {},
                     {},
                     {}};
    const auto id_in = [&](const std::string& folder) {
      const std::string rest = place.substr(folder.size());
      return rest.substr(0, rest.find('/'));
    };
    if (editor.document && place.starts_with("nodes/") && editor.scene().nodes.contains(id_in("nodes/")))
      item.nodes = {id_in("nodes/")};
    if (editor.document && place.starts_with("links/") && editor.scene().links.contains(id_in("links/")))
      item.links = {id_in("links/")};
    items_.push_back(std::move(item));
  }
}

void ProblemList::refresh(const Editor& editor, const report::ReportModel& figures) {
  const std::shared_ptr<const State> state = editor.moment ? editor.moment->state : nullptr;
  if (state == state_ && revision_ == editor.problems_revision) return;
  if (state && state->plan.get() != plan_) bands_.clear();
  plan_ = state ? state->plan.get() : nullptr;
  state_ = state;
  revision_ = editor.problems_revision;
  items_.clear();
  if (state) {
    add_conflicts(*state);
    report::ReportModel problems;
    report::read_problems(*state, problems);
    add_failures(*state, problems);
    add_shortages(*state, figures);
    add_losers(*state, figures);
    add_volumes(*state, figures);
    add_places(*state);
    add_idle(*state);
  }
  add_file(editor);
  std::stable_sort(items_.begin(), items_.end(), [](const ProblemItem& a, const ProblemItem& b) { return a.kind < b.kind; });
  counts_.fill(0);
  for (const ProblemItem& item : items_) ++counts_[static_cast<std::size_t>(item.kind)];
}

}  // namespace bl::desktop
