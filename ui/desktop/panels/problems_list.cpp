// Collects problems from the state; bands with a margin keep rows from changing places in every tick.
#include "ui/desktop/panels/problems_list.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/reading/figures.h"
#include "core/reading/views/solver.h"
#include "core/reading/views/sun_need.h"
#include "ui/desktop/panels/inspector_quantity.h"

namespace bl::desktop {

namespace {

// A row changes its band when it is this far beyond the edge, in powers of two.
constexpr double kBandMargin = 0.35;

int band_of(double severity, const int* before) {
  const double exact = std::log2(severity / reading::kMinorSeverity);
  const int band = static_cast<int>(std::floor(exact));
  if (before == nullptr) return band;
  return exact > *before - kBandMargin && exact < *before + 1 + kBandMargin ? *before : band;
}

std::string number_word(std::size_t count) {
  constexpr const char* kWords[] = {"No",    "One",   "Two",  "Three", "Four",   "Five",  "Six",
                                    "Seven", "Eight", "Nine", "Ten",   "Eleven", "Twelve"};
  return count < std::size(kWords) ? kWords[count] : reading::grouped(static_cast<double>(count));
}

// What is missing, by the measure that was asked for.
std::string missing_words(const reading::Account& account) {
  const bool is_area = account.is_by_area;
  const Unit unit = is_area ? Unit::square_metre : Unit::cubic_metre;
  const double asked = is_area ? account.asked_area : account.asked, had = is_area ? account.floor_area : account.volume;
  return "asked for: " + reading::quantity(asked, unit) + (is_area ? " of floor area" : "") +
         ", available: " + reading::quantity(had, unit) + "; missing: " + reading::quantity(asked - had, unit) + " (" +
         reading::percent(account.short_share()) + ")";
}

// Names and reasons come from data, and data can be long: as much as errors quote.
void bound(ProblemItem& item) {
  Error cut = bounded({ErrorCode::internal, std::move(item.subject), std::move(item.text)});
  item.subject = std::move(cut.place);
  item.text = std::move(cut.message);
}

std::string lower_first(std::string text) {
  if (!text.empty() && text[0] >= 'A' && text[0] <= 'Z') text[0] = static_cast<char>(text[0] - 'A' + 'a');
  return text;
}

// A link that fails, or one that runs and says what it cannot reach.
std::string what_of(const State& state, const std::string& link) {
  if (const std::size_t l = reading::link_index(*state.plan, link); l < state.links.size() && state.links[l].remark)
    return state.links[l].remark == LinkRemark::unmet ? "A rule cannot be met" : "A demand is not met";
  return "Link " + link + " fails";
}

// What a solver of standing volumes says is often no want of room: who stands where, or which storeys vanish.
std::string what_is_short(const State& state, const reading::ProblemRow& row) {
  const std::uint32_t node = state.plan->node_index(row.node);
  const bool stands = reading::row_of<reading::StandingFigures>(state, node).has_value();
  if (!stands && reading::is_a<reading::SunNeed>(state, node)) return row.place.substr(5) + " is short of sun";
  return stands ? row.place.substr(5) + " builds otherwise than asked" : "The boundary is too small";
}

}  // namespace

const char* label_of(ProblemKind kind) {
  switch (kind) {
    case ProblemKind::conflict: return "Conflicts";
    case ProblemKind::rule: return "Rules";
    case ProblemKind::shortage: return "Shortages";
    case ProblemKind::failing: return "Failures";
    case ProblemKind::no_room: return "Without room";
    case ProblemKind::place: return "Places";
    case ProblemKind::idle: return "Switched off";
    case ProblemKind::file: return "File";
  }
  return "";
}

std::string all_is_well(bool has_run) {
  return has_run ? "No problems: no conflicts, no failures, and every volume has its room."
                 : "No problems so far; conflicts appear once the scene runs.";
}

std::size_t ProblemList::pressing() const { return items_.size() - count(ProblemKind::idle); }

void ProblemList::add_conflicts(const State& state) {
  std::map<PortRef, int> bands;
  std::vector<std::size_t> order;
  for (const reading::TensePort& tense : problems_.tense()) {
    // What was before decides on places in the list alone, never on what is listed.
    if (tense.is_minor) continue;
    const auto before = bands_.find(tense.ref);
    const int band = std::max(0, band_of(tense.severity, before != bands_.end() ? &before->second : nullptr));
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

namespace {

std::string reason_of_shortage(const State& state, const reading::Accounts& accounts, const std::string& key) {
  const std::string name = key.substr(key.find('/') + 1);
  if (key.starts_with("use/")) {
    for (const reading::UseAccount& use : accounts.uses)
      if (use.use == name) return reading::why_short(state, accounts, use);
  } else if (key.starts_with("volume/")) {
    if (const std::size_t row = accounts.row_of(state.plan->node_index(name)); row < accounts.volumes.size())
      return reading::why_short(state, accounts, accounts.volumes[row]);
  }
  return "";
}

}  // namespace

void write_problem(const State& state, const reading::Accounts& accounts, ProblemItem& item) {
  if (item.kind == ProblemKind::shortage && item.why.empty()) {
    item.why = reason_of_shortage(state, accounts, item.key);
    if (!item.why.empty()) item.text += "; " + item.why;
    bound(item);
  }
  if (item.kind != ProblemKind::conflict || !item.text.empty()) return;
  const reading::ConflictRow row = reading::conflict_row(state, item.tense);
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
  bound(item);
}

// Uses first; then volumes whose use is not listed, or all where a solver says that not everything can be had. One account
// decides who is short, here as in colours, statistics and report.
void ProblemList::add_shortages(const State& state, const reading::ReportModel& figures) {
  const reading::Accounts& accounts = figures.accounts;
  if (state.tick == 0) return;
  std::set<std::string> listed_uses;
  const bool is_too_small = std::any_of(items_.begin(), items_.end(),
                                        [](const ProblemItem& i) { return i.kind == ProblemKind::shortage && i.is_error; });
  const auto add = [&](const std::string& key, const reading::Account& account, const std::string& subject) -> ProblemItem* {
    if (!account.is_short(accounts.tolerance)) return nullptr;
    ProblemItem item;
    item.kind = ProblemKind::shortage;
    item.key = key;
    item.subject = subject;
    item.text = missing_words(account);
    return &items_.emplace_back(std::move(item));
  };
  for (const reading::UseAccount& use : accounts.uses) {
    ProblemItem* item =
        add("use/" + use.use, use, use.use.empty() ? "Not all without a use can be met" : "Not all " + use.use + " can be met");
    if (item == nullptr) continue;
    listed_uses.insert(use.use);
    item->text += ", in " + reading::counted(use.volumes, "volume");
    for (const reading::VolumeRow& volume : figures.volumes)
      if (volume.use == use.use && (use.short_volumes == 0 || volume.is_short(accounts.tolerance)))
        item->nodes.push_back(volume.id);
  }
  for (const reading::OpenAccount& open : accounts.open)
    if (std::string text = reading::shortage_of(open, accounts.tolerance); !text.empty()) {
      ProblemItem& item = items_.emplace_back();
      item.kind = ProblemKind::shortage;
      item.key = "open/" + open.use;
      item.subject = "Not enough open space for " + open.use;
      item.text = std::move(text);
    }
  if (accounts.all.short_volumes == 0) return;
  for (const reading::VolumeRow& volume : figures.volumes) {
    if (!volume.is_short(accounts.tolerance)) continue;
    // Who has no shape stands among those without room, with the reason.
    const bool is_told = (listed_uses.contains(volume.use) && !is_too_small) ||
                         (volume.figures.state != "alive" && !volume.figures.reason.empty());
    if (is_told) continue;
    if (ProblemItem* item = add("volume/" + volume.id, volume, volume.name + " falls short")) item->nodes = {volume.id};
  }
}

void ProblemList::add_failures(const State& state) {
  const std::vector<reading::ProblemRow> failures = problems_.failures();
  for (const bool is_shortage : {true, false})
    for (const reading::ProblemRow& row : failures) {
      if (row.is_shortage != is_shortage || (is_shortage && state.tick == 0)) continue;
      // Ghosts hinder nobody: they stand among what does not run.
      if (const auto& links = state.plan->scene.links;
          !row.link.empty() && links.contains(row.link) && !links.at(row.link).ghost.empty())
        continue;
      ProblemItem item;
      item.kind = row.is_rule ? ProblemKind::rule : is_shortage ? ProblemKind::shortage : ProblemKind::failing;
      item.key = row.place;
      item.is_error = true;
      item.text = row.message;
      item.subject = row.is_rule        ? row.place.substr(5) + " breaks a rule"
                     : is_shortage      ? what_is_short(state, row)
                     : row.node.empty() ? what_of(state, row.link)
                                        : row.place.substr(5) + " fails";
      if (!row.node.empty()) item.nodes = {row.node};
      item.nodes.insert(item.nodes.end(), row.others.begin(), row.others.end());
      if (!row.link.empty()) item.links = {row.link};
      items_.push_back(std::move(item));
    }
}

void ProblemList::add_volumes(const State& state, const reading::ReportModel& figures) {
  if (state.tick == 0) return;
  for (const reading::VolumeRow& volume : figures.volumes) {
    if (volume.is_alive || volume.figures.reason.empty()) continue;
    ProblemItem item;
    item.kind = ProblemKind::no_room;
    item.key = volume.id;
    item.subject = volume.name + " is " + volume.figures.state;
    item.text = volume.figures.reason;
    item.nodes = {volume.id};
    items_.push_back(std::move(item));
  }
}

void ProblemList::add_places() {
  const auto add = [&](const reading::PlaceProblem& problem) {
    // Heights change from tick to tick, who hangs does not.
    ProblemItem& item = items_.emplace_back();
    item.kind = ProblemKind::place;
    item.key = "place";
    item.subject = problem.subject;
    item.text = problem.text;
    item.nodes = problem.nodes;
    item.links = problem.links;
    for (const std::string& node : problem.nodes) item.key += "/" + node;
  };
  for (const reading::PlaceProblem& problem : problems_.collapsed()) add(problem);
  for (const auto& [node, problem] : problems_.hanging()) add(problem);
}

void ProblemList::add_idle(const State& state) {
  const auto add = [&](const LinkPlan& link, const std::string& standing, const std::string& text) {
    ProblemItem item;
    item.kind = ProblemKind::idle;
    item.key = link.id;
    item.subject = "Link " + link.id + standing;
    item.text = text;
    item.links = {link.id};
    items_.push_back(std::move(item));
  };
  for (const LinkPlan& link : state.plan->links) {
    if (link.definition == nullptr)
      add(link, " does not run", "this program does not know its kind; it is kept and saved unchanged");
    else if (!link.is_enabled) add(link, " is off", link.definition->label + ": it is not evaluated");
    else if (link.is_muted) add(link, " is muted", link.definition->label + ": it is evaluated, but its proposals do not count");
  }
}

void ProblemList::add_file(const Workbench& editor) {
  const std::string file = editor.problem_file.substr(editor.problem_file.find_last_of('/') + 1);
  for (std::size_t k = 0; k < editor.problems.size(); ++k) {
    const Problem& problem = editor.problems[k];
    const std::string& place = problem.error.place;
    const bool is_script = place.starts_with("scripts/");
    ProblemItem item;
    item.kind = ProblemKind::file;
    item.key = "file/" + std::to_string(k);
    item.band = problem.is_error ? 1 : 0;
    item.is_error = problem.is_error;
    item.subject = is_script ? place.substr(place.find('/') + 1) + ".lua" : file;
    item.text = is_script ? problem.error.message : problem.error.text();
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

void ProblemList::refresh(const Workbench& editor, const reading::ReportModel& figures) {
  const std::shared_ptr<const State> state = editor.moment ? editor.moment->state : nullptr;
  if (state == state_ && revision_ == editor.problems_revision) return;
  if (state && state->plan.get() != plan_) bands_.clear();
  plan_ = state ? state->plan.get() : nullptr;
  state_ = state;
  revision_ = editor.problems_revision;
  items_.clear();
  if (state) {
    problems_.read(state);
    add_conflicts(*state);
    add_failures(*state);
    add_shortages(*state, figures);
    add_volumes(*state, figures);
    add_places();
    add_idle(*state);
  }
  add_file(editor);
  const auto is_before = [](const ProblemItem& a, const ProblemItem& b) { return a.kind < b.kind; };
  // Thousands of items are sorted only where they are not: mostly they are.
  if (!std::is_sorted(items_.begin(), items_.end(), is_before)) std::stable_sort(items_.begin(), items_.end(), is_before);
  for (ProblemItem& item : items_) bound(item);
  counts_.fill(0);
  for (const ProblemItem& item : items_) ++counts_[static_cast<std::size_t>(item.kind)];
}

}  // namespace bl::desktop
