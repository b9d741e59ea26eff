// Footprints against the plans of boundaries; the shares decide, and the sites' tables of exclusions grow.
#include "core/making/site_buildings.h"

#include <algorithm>
#include <cmath>

#include "core/base/plural.h"
#include "core/base/text.h"
#include "core/geometry/domain_table.h"
#include "core/import/plan_cover.h"
#include "core/making/named_list.h"
#include "core/making/site_grounds.h"

namespace bl::making {

namespace {

// Lines of maps and of plots differ by some decimetres: what reaches in by no more than this stands beside the site.
constexpr double kInexactArea = 1;      // [m²]
constexpr double kSliver = 1e-3;        // [m²] of one piece of an area that reaches in by more than that in all
constexpr double kInexactShare = 0.01;  // [ratio] of the footprint
// Of a building of which less lies inside, the site is not the place.
constexpr double kOwnShare = 0.5;  // [ratio]
// An area of the map that covers more of a site is what the site lies in, not something in it.
constexpr double kMostLeftOut = 0.9;  // [ratio]

importing::PlanShape shape_of(const importing::ContextBuilding& building) {
  importing::PlanShape shape{&building.outer};
  for (const geometry::Ring& hole : building.holes) shape.push_back(&hole);
  return shape;
}

double footprint_of(const importing::ContextBuilding& building) {
  double area = std::abs(geometry::signed_area(building.outer));
  for (const geometry::Ring& hole : building.holes) area -= std::abs(geometry::signed_area(hole));
  return area;
}

// Names of exclusions: kind and element, the source, and the number of each part where there are several.
constexpr const char *kOf = " of ", *kPart = " part ";

// Is it the name of that exclusion, or of a part of it?
bool is_named(const std::string& name, const std::string& exclusion) {
  if (!name.starts_with(exclusion)) return false;
  const std::string rest = name.substr(exclusion.size());
  return rest.empty() ||
         (rest.starts_with(kPart) && rest.find_first_not_of("0123456789", std::string(kPart).size()) == std::string::npos);
}

std::string share_text(double share) { return fixed(std::min(100.0, 100 * share), 0) + " %"; }

}  // namespace

SiteBuildings::SiteBuildings(const Scene& scene, const Registry& registry, InsideChoice choice, AskToClear ask)
    : choice_(choice), ask_(std::move(ask)) {
  for (Site& site : sites_of(scene, registry)) static_cast<Site&>(sites_.emplace_back()) = std::move(site);
}

// What of a building lies inside of a site [m²], where it stands in its heights at all.
double SiteBuildings::inside(const Site& site, const importing::ContextBuilding& building) const {
  if (building.base >= site.top || building.base + building.height <= site.bottom) return 0;
  double area = 0;
  for (const std::vector<geometry::Ring>& ground : site.grounds) area = std::max(area, area_on(ground, shape_of(building)));
  return area;
}

bool SiteBuildings::clears(std::size_t buildings, const std::string& site) {
  if (choice_ == InsideChoice::unsaid) {
    is_assumed_ = !ask_;
    choice_ = ask_ && ask_(buildings, site) ? InsideChoice::clear : InsideChoice::keep;
  }
  return choice_ == InsideChoice::clear;
}

void SiteBuildings::judge(const importing::Context& context) {
  stays_.clear();
  for (std::size_t s = 0; s < sites_.size(); ++s) {
    // Parts share the fate of their building.
    struct Whole {
      std::vector<std::size_t> buildings;
      double inside = 0, footprint = 0;
    };
    std::map<std::string, Whole> wholes;
    std::map<std::size_t, double> areas;
    for (std::size_t b = 0; b < context.buildings.size(); ++b) {
      const importing::ContextBuilding& building = context.buildings[b];
      const double area = inside(sites_[s], building);
      if (area > 0) areas[b] = area;
      if (area <= 0 && building.whole.empty()) continue;
      Whole& whole = wholes[building.whole.empty() ? "building " + std::to_string(b) : "whole " + building.whole];
      whole.buildings.push_back(b);
      whole.inside += area;
      whole.footprint += footprint_of(building);
    }
    std::erase_if(wholes, [](const auto& entry) {
      return entry.second.inside <= kInexactArea && entry.second.inside <= kInexactShare * entry.second.footprint;
    });
    const auto own = static_cast<std::size_t>(std::count_if(wholes.begin(), wholes.end(), [](const auto& entry) {
      return entry.second.inside >= kOwnShare * entry.second.footprint;
    }));
    const bool is_clearing = own > 0 && clears(own, sites_[s].id);
    for (const auto& [name, whole] : wholes) {
      const double share = whole.inside / whole.footprint;
      const bool is_own = share >= kOwnShare, is_cleared = is_own && is_clearing;
      const std::size_t number = ++judged_;
      sites_[s].cleared += is_cleared ? 1 : 0;
      for (const std::size_t b : whole.buildings)
        if (is_cleared || areas.contains(b)) stays_[b].push_back({s, share, number, is_own, is_cleared});
    }
  }
}

bool SiteBuildings::is_cleared(std::size_t building) const {
  const auto stays = stays_.find(building);
  return stays != stays_.end() &&
         std::any_of(stays->second.begin(), stays->second.end(), [](const Stay& stay) { return stay.is_cleared; });
}

// What of the ground lies in the site; nothing where that is nearly all of it.
std::vector<Exclusion> SiteBuildings::left_out(const Site& site, const Ground& ground) {
  std::vector<Exclusion> inside;
  double area = 0, whole = 0;
  for (const std::vector<geometry::Ring>& outline : site.grounds) whole += std::abs(geometry::signed_area(outline.front()));
  const std::vector<geometry::Ring> rings = ground.rings();
  if (rings.empty()) ground_notes_.push_back("`" + ground.name + "` is not kept clear: its outline encloses no ground.");
  for (const geometry::Ring& ring : rings) {
    double common = 0;
    for (const std::vector<geometry::Ring>& outline : site.grounds) common += area_on(outline, {&ring});
    area += common;
    if (common > kSliver) inside.push_back({ground.name, ground.use, ring, site.bottom, site.top});
  }
  if (area <= kInexactArea) return {};
  if (area <= kMostLeftOut * whole) return inside;
  ground_notes_.push_back("`" + ground.name + "` covers " + share_text(area / whole) + " of the site `" + site.id +
                          "`, and the site keeps that ground: nothing would be left to build on.");
  return {};
}

// Its exclusions replace those of an import before; of a name that this import has had already they are further ones.
void SiteBuildings::put(Judged& site, const Ground& ground, std::vector<Exclusion> exclusions, const GroundSource& from) {
  const std::string name = ground.name + kOf + from.name;
  std::size_t& number = site.brought[name];
  const bool is_first = number == 0, is_alone = is_first && exclusions.size() == 1;
  for (Exclusion& exclusion : exclusions) {
    ++number;
    exclusion.name = is_alone ? name : name + kPart + std::to_string(number);
  }
  if (!exclusions.empty()) ++site.grounds_left_out[ground.kind];
  const auto is_old = [&](const std::string& other) {
    return is_named(other, name) || (from.has_lasting_ids && other.starts_with(ground.name + kOf));
  };
  if (!is_first) return site.extend(is_old, exclusions);
  if (site.replace(is_old, exclusions) && exclusions.empty()) ++site.grounds_given_back[ground.kind];
}

// What of a file can be kept clear.
std::vector<SiteBuildings::Ground> SiteBuildings::grounds_of(const importing::Context& context, const ClearWish& wish) {
  std::vector<Ground> grounds;
  for (const importing::ContextStreet& street : context.streets)
    if (street.for_cars || wish.takes_all_streets)
      grounds.push_back({"streets", "street " + street.id, "", importing::kNoRow, street.id, false,
                         [&street] { return street_ground(street); }});
  for (const importing::ContextRail& rail : context.rails)
    grounds.push_back({"rails", "rail " + rail.id, "", rail.row, rail.id, false, [&rail] { return rail_ground(rail); }});
  for (const importing::ContextArea& area : context.areas) {
    const std::string kind(ground_kind(area.use));
    if (area.is_plot || kind.empty()) continue;
    const std::string word = kind == "streets" ? "street" : kind == "rails" ? "rail" : kind;
    const bool is_small = kind == "green" && std::abs(geometry::signed_area(area.outer)) < wish.least_green;
    grounds.push_back({kind, word + " " + area.id, kind == "green" ? open_use_of(area.use) : "", area.row, area.id, is_small,
                       [&area] { return area_ground(area); }});
  }
  return grounds;
}

void SiteBuildings::clear_grounds(const importing::Context& context, const ClearWish& wish, const GroundSource& from) {
  left_out_.clear();
  if (sites_.empty()) {
    if (!wish.kinds.empty())
      ground_notes_.push_back("The scene has no site, so that nothing is kept clear: add one, and import again.");
    return;
  }
  sources_.insert(from.name);
  least_green_ = wish.least_green;
  const std::vector<Ground> grounds = grounds_of(context, wish);
  for (const std::string& kind : wish.kinds)
    asked_[kind].found += static_cast<std::size_t>(
        std::count_if(grounds.begin(), grounds.end(), [&kind](const Ground& ground) { return ground.kind == kind; }));
  for (Judged& site : sites_) clear_site(site, grounds, wish, from);
}

// What is wanted now, and what is known: that may have moved.
void SiteBuildings::clear_site(Judged& site, const std::vector<Ground>& grounds, const ClearWish& wish,
                               const GroundSource& from) {
  std::set<std::string> had;
  for (std::size_t row = 0; row < site.rows.rows.size(); ++row) {
    const std::string& name = site.rows.text(row, "name");
    had.insert(name);
    is_again_ = is_again_ || name.find(kOf + from.name) != std::string::npos;
  }
  // An import before has left it out, or an import of another source the same element.
  const auto is_known = [&](const std::string& ground) {
    const std::string name = ground + kOf + from.name, prefix = from.has_lasting_ids ? ground + kOf : name;
    for (auto other = had.lower_bound(prefix); other != had.end() && other->starts_with(prefix); ++other)
      if (from.has_lasting_ids || is_named(*other, name)) return true;
    return false;
  };
  for (const Ground& ground : grounds) {
    site.brought.try_emplace(ground.name + kOf + from.name, 0);
    const bool was_left_out = is_known(ground.name);
    if (!was_left_out && !wish.kinds.contains(ground.kind)) continue;
    std::vector<Exclusion> exclusions = left_out(site, ground);
    if (ground.is_small && !exclusions.empty()) {
      site.small.insert(ground.name + kOf + from.name);
      exclusions.clear();
    }
    const bool is_left_out = !exclusions.empty();
    if (is_left_out || was_left_out) put(site, ground, std::move(exclusions), from);
    if (!is_left_out) continue;
    if (const auto asked = asked_.find(ground.kind); asked != asked_.end()) asked->second.is_used = true;
    if (ground.row != importing::kNoRow) left_out_[{ground.row, ground.id}] = site.id;
  }
}

std::string SiteBuildings::site_without(std::size_t row, const std::string& id) const {
  const auto site = left_out_.find({row, id});
  return site == left_out_.end() ? "" : site->second;
}

std::vector<std::string> SiteBuildings::warnings() const {
  std::vector<std::string> warnings;
  for (const auto& [kind, asked] : asked_) {
    if (asked.is_used) continue;
    const bool has_small = kind == "green" && std::ranges::any_of(sites_, [](const Judged& site) { return !site.small.empty(); });
    warnings.push_back(
        "No ground of `" + kind + "` is kept clear, although that was asked for: " +
        (asked.found == 0 ? "the files hold none"
         : has_small      ? "what reaches into a site is smaller than " + shortest(least_green_) + " m²"
                     : "of " + std::to_string(asked.found) + " in the files none reaches into a site, or it covers all of it") +
        ".");
  }
  return warnings;
}

bool SiteBuildings::has_cleared() const {
  return std::any_of(sites_.begin(), sites_.end(), [](const Judged& site) { return site.cleared > 0; });
}

void SiteBuildings::keep(std::size_t building, const importing::ContextBuilding& made, const std::string& node, bool is_changed,
                         importing::ImportReport& report) {
  const auto found = stays_.find(building);
  const std::vector<Stay> stays = found == stays_.end() ? std::vector<Stay>() : found->second;
  for (std::size_t s = 0; s < sites_.size(); ++s) {
    Judged& site = sites_[s];
    const auto stay = std::find_if(stays.begin(), stays.end(), [s](const Stay& one) { return one.site == s; });
    if (stay == stays.end()) {
      if (is_changed && site.replace(node)) site.left.push_back(node);
      continue;
    }
    if (made.row != importing::kNoRow)
      report.remark(made.row, share_text(stay->share) + " of it inside the site `" + site.id + "`, which leaves its ground out");
    // Only now: another site may have cleared what this one would keep.
    (stay->is_own ? site.kept : site.reaching).insert(stay->whole);
    if (!is_changed && site.rows.row_of("name", node) < site.rows.rows.size()) continue;
    // From the underside of the site: nothing is built below a building that stays.
    site.replace(node, {{node, "", made.outer, std::min(made.base, site.bottom), made.base + made.height}});
  }
}

void SiteBuildings::remove(std::size_t building, const std::string& node) {
  for (Judged& site : sites_) site.replace(node);
  for (const Stay& stay : stays_.at(building))
    if (stay.is_cleared) sites_[stay.site].removed.push_back(node);
}

void SiteBuildings::spare(std::size_t building, const std::string& node) {
  for (const Stay& stay : stays_.at(building))
    if (stay.is_cleared) {
      sites_[stay.site].spared.push_back(node);
      sites_[stay.site].spared_wholes.insert(stay.whole);
    }
}

std::vector<std::pair<std::string, Table>> SiteBuildings::exclusions() const {
  std::vector<std::pair<std::string, Table>> changed;
  for (const Site& site : sites_)
    if (site.rows != site.rows_before) changed.emplace_back(site.id, site.rows);
  return changed;
}

// How many of each kind: "2 pieces of street, 1 area of green".
std::string SiteBuildings::grounds_text(const std::map<std::string, std::size_t>& grounds) {
  std::string text;
  for (const auto& [kind, number] : grounds)
    text += (text.empty() ? "" : ", ") + (kind == "streets" ? how_many(number, "piece") + " of street"
                                          : kind == "rails" ? how_many(number, "piece") + " of railway"
                                                            : how_many(number, "area") + " of " + kind);
  return text;
}

void SiteBuildings::note_grounds(const Judged& site, std::vector<std::string>& notes) const {
  if (!site.grounds_left_out.empty())
    notes.push_back("The site `" + site.id + "` leaves out the ground of " + grounds_text(site.grounds_left_out) +
                    " (streets: in the width that the file gives, else by their lanes with a path on each side).");
  if (!site.grounds_given_back.empty())
    notes.push_back("The site `" + site.id + "` leaves out the ground of " + grounds_text(site.grounds_given_back) +
                    " no longer: it does not reach into the site any more" + (site.small.empty() ? "" : ", or is too small") +
                    ".");
  if (const std::size_t small = site.small.size(); small > 0)
    notes.push_back("The site `" + site.id + "` does not leave out " + how_many(small, "area") + " of green with less than " +
                    shortest(least_green_) + " m² of ground" + by_number(small, "", " each") + " (--least-green).");
  std::vector<std::string> gone;
  for (const geometry::NamedRing& ring : geometry::read_rings(site.rows)) {
    std::string name = ring.name;
    if (const std::size_t part = name.rfind(kPart); part != std::string::npos && is_named(name, name.substr(0, part)))
      name.resize(part);
    const bool is_ours =
        std::any_of(sources_.begin(), sources_.end(), [&](const std::string& source) { return name.ends_with(kOf + source); });
    if (is_ours && !site.brought.contains(name) && std::find(gone.begin(), gone.end(), name) == gone.end()) gone.push_back(name);
  }
  if (!gone.empty())
    notes.push_back("The site `" + site.id +
                    "` still leaves out what this import does not bring any more (it left the file, or " +
                    "the options leave it out): " + named_list(gone) + ". Where that ground is free, remove its rows from the " +
                    "exclusions of the site.");
}

void SiteBuildings::note_cleared(const Judged& site, std::vector<std::string>& notes) const {
  const std::string where = " inside the site `" + site.id + "`";
  if (const std::size_t cleared = site.cleared - site.spared_wholes.size(); cleared > 0)
    notes.push_back(how_many(cleared, "building") + by_number(cleared, " that stands", " that stand") + where +
                    by_number(cleared, " was left out.", " were left out.") +
                    (site.removed.empty() ? ""
                                          : " Removed, with the ground that the site left out for " +
                                                std::string(by_number(site.removed.size(), "it", "them")) + ": " +
                                                named_list(site.removed) + "."));
  if (const std::size_t spared = site.spared.size(); spared > 0)
    notes.push_back(named_list(site.spared) + by_number(spared, " stands", " stand") + where + " and" +
                    by_number(spared, " stays", " stay") + ", because people have changed " + by_number(spared, "it", "them") +
                    " since the import: remove " + by_number(spared, "the node", "the nodes") + " by hand to clear the site.");
}

std::vector<std::string> SiteBuildings::notes() const {
  std::vector<std::string> notes = ground_notes_;
  for (const Judged& site : sites_) {
    note_grounds(site, notes);
    note_cleared(site, notes);
    if (const std::size_t kept = site.kept.size(); kept > 0)
      notes.push_back(how_many(kept, "building") + by_number(kept, " stands", " stand") + " inside the site `" + site.id + "`" +
                      by_number(kept, " and stays", " and stay") + ": the site leaves out the ground under " +
                      by_number(kept, "it", "them") + ", courts included, up to " + by_number(kept, "its roof.", "their roofs.") +
                      (is_assumed_ ? " That is what --keep does; --clear leaves such buildings out of the scene." : ""));
    if (const std::size_t reaching = site.reaching.size(); reaching > 0)
      notes.push_back(how_many(reaching, "building") + by_number(reaching, " reaches", " reach") + " into the site `" + site.id +
                      "` with less than half of " + by_number(reaching, "its", "their") + " ground and " +
                      by_number(reaching, "stays", "stay") + ": the site leaves that ground out.");
    if (const std::size_t left = site.left.size(); left > 0)
      notes.push_back(named_list(site.left) + by_number(left, " does", " do") + " not reach into the site `" + site.id +
                      "` any more, and the site leaves nothing out for " + by_number(left, "it", "them") + ".");
  }
  return notes;
}

}  // namespace bl::making
