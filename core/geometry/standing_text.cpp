// Sentences about volumes that stand, with people's names of them.
#include "core/geometry/standing_text.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <string_view>
#include <vector>

#include "core/base/plural.h"
#include "core/base/text.h"

namespace bl::geometry {

Error error_of_wish(const Error& error, std::span<const std::uint32_t> members) {
  constexpr std::string_view kSites = "sites/";
  const auto site = error.place.starts_with(kSites) ? parse_number(error.place.substr(kSites.size())) : std::nullopt;
  if (!site || !(*site < static_cast<double>(members.size()))) return error;
  return {error.code, "", "site " + std::to_string(members[static_cast<std::size_t>(*site)]) + " cannot stand: " + error.message};
}

namespace {

// What to say of who is placed outside of the boundary; empty where it has something, or stands inside.
std::string why_outside(const StandingWish& wish, const StandingResult& result, const Domain& domain) {
  constexpr double kNearly = 0.01;  // [m]
  if (!(wish.volume > 0) || result.floor_area > 0 || wish.base >= 0 || wish.host >= 0 || domain.pieces.empty()) return "";
  const Point3 at{wish.site.site.position.x, wish.site.site.position.y, domain.minimum.z + kNearly};
  if (domain.contains(at, kNearly)) return "";
  return "is placed outside of the boundary, where there is no ground for it: move it inside";
}

}  // namespace

std::string outside_text(std::span<const StandingWish> wishes, std::span<const StandingResult> results, const Domain& domain,
                         std::span<const std::string> names) {
  std::string words;
  for (std::size_t i = 0; i < results.size(); ++i)
    if (const std::string why = why_outside(wishes[i], results[i], domain); !why.empty()) words += "; `" + names[i] + "` " + why;
  return words;
}

std::string missing_text(const StandingWish& wish, const StandingResult& result, std::span<const std::string> names) {
  if (!(wish.volume > 0)) return "wants nothing: raise its demand to give it a volume";
  if (result.state == SiteState::coincident) return "stands in the place of a heavier volume: move one of them";
  if (result.floor_area > 0) return "";
  if (wish.base >= 0)
    return "has no footprint: `" + names[static_cast<std::size_t>(wish.base)] + "`, on which it stands, its neighbours and its " +
           "set-backs leave it no roof where it stands";
  return "has no footprint: its neighbours, its set-backs and the plot leave it nothing where it stands";
}

namespace {

// Of a footprint that streets, water or its neighbours part. Slivers are no pieces: borders that nearly meet leave them beside a
// footprint that stands in one.
std::string pieces_text(const StandingBody& body, const std::string& name) {
  if (body.stacks.empty() || body.stacks.front().outlines.size() < 2) return "";
  constexpr double kChords = 0.01;  // [m] between arcs and their chords
  constexpr double kSliver = 1;     // [m²]
  double least = 0, most = 0;
  std::size_t pieces = 0;
  for (const PlateFace& piece : faces_of(body.stacks.front(), body.centre, kChords)) {
    const double area = area_of(std::span(&piece, 1));
    if (area < kSliver) continue;
    least = pieces == 0 ? area : std::min(least, area);
    most = std::max(most, area);
    ++pieces;
  }
  if (pieces < 2) return "";
  return "; `" + name + "` stands in " + std::to_string(pieces) + " pieces of " + fixed(least, 0) + " to " + fixed(most, 0) +
         " m²: something that stays open parts its footprint; move it to where it fits in " +
         "one, by hand or by `run SCENE --set " + name + "/node.position='[x,y,0]' --save SCENE`";
}

// A set-back of all storeys makes the footprint larger by as much, but for what it keeps from a border, and from neighbours whose
// walls do not touch.
bool has_idle_setback(const StandingWish& wish, const StandingResult& whole) {
  if (!(wish.setback > 0) || wish.full_storeys > 0 || !wish.site.has_party_walls || whole.storeys.count < 2) return false;
  if (!whole.body || whole.body->stacks.empty()) return false;
  if (wish.base >= 0) return false;  // it keeps its set-back from the edge of the roof
  for (const PlateRing& outline : whole.body->stacks.front().outlines)
    for (const PlateRing::Corner& corner : outline.corners)
      if (corner.beyond == PlateRing::kPlot) return false;
  return true;
}

constexpr double kAnyDepth = 1000;  // [m]; the default of the port, which asks for no courtyard

// The shorter side of the rectangle around the ground [m].
double breadth_of(const Domain& domain) {
  return std::min(domain.maximum.x - domain.minimum.x, domain.maximum.y - domain.minimum.y);
}

}  // namespace

std::string other_storeys_text(std::span<const StandingWish> wishes, std::span<const StandingResult> results,
                               std::span<const StandingResult> buildings, const Domain& domain, double tolerance,
                               std::span<const std::string> names) {
  std::string words;
  const double top = domain.maximum.z, breadth = breadth_of(domain);
  for (std::size_t i = 0; i < results.size(); ++i) {
    const StandingWish& wish = wishes[i];
    if (!(wish.volume > 0)) continue;
    if (wish.host >= 0) continue;
    // Of a building that several share, all of it.
    const StandingResult& whole = results[i].is_shared ? buildings[i] : results[i];
    if (wish.storeys < wish.least)
      words += "; `" + names[i] + "` has " + how_many(static_cast<std::size_t>(wish.least), "storey") +
               ", the least that it may have, and not " + std::to_string(wish.storeys) +
               ": lower `storeys_min`, or raise `storeys`";
    if (wish.base < 0 && whole.bottom < wish.ground && whole.body)
      words += "; `" + names[i] + "` stands at " + fixed(whole.bottom, 1) + " m and not at " + fixed(wish.ground, 1) +
               " m, because the boundary leaves no storey above that";
    if (whole.body && whole.bottom + whole.height > top + 1e-6)
      words += "; `" + names[i] + "` reaches " + fixed(whole.bottom + whole.height, 1) + " m, and the boundary " + fixed(top, 1) +
               " m: the least of its storeys need more height than there is";
    else if (whole.outside.storey > 0)
      words += "; `" + names[i] + "` reaches out of the boundary from storey " + std::to_string(whole.outside.storey) + " on, " +
               fixed(whole.outside.height, 1) + " m high, by up to " + fixed(whole.outside.area, 1) +
               " m² of a plate: lower its `storeys`, or move it";
    if (whole.body) words += pieces_text(*whole.body, names[i]);
    if (wish.site.depth < kAnyDepth && wish.site.depth > breadth)
      words += "; the `depth` of `" + names[i] + "`, " + shortest(wish.site.depth) +
               " m, is larger than the ground of the site, " + fixed(breadth, 1) +
               " m: it leaves no courtyard anywhere, and changes nothing";
    if (has_idle_setback(wish, whole))
      words += "; the set-back of `" + names[i] + "` holds for all of its " +
               how_many(static_cast<std::size_t>(whole.storeys.count), "storey") +
               " alike, and changes nothing: set `full_storeys`, above which it begins";
    // On their way to what they want, volumes are smaller.
    if (!whole.body || error_of(wish, results[i]) > tolerance) continue;
    int with_area = 0;
    for (const PlateStack& stack : whole.body->stacks) with_area += stack.storeys;
    // Without a set-back there are plates, and a courtyard as large as they are.
    const bool is_by_courtyard = !(wish.setback > 0) || wish.courtyard_setback >= wish.site.depth;
    if (with_area < whole.storeys.count)
      words += (is_by_courtyard ? "; the `courtyard_setback` of `" : "; the set-back of `") + names[i] +
               "` leaves nothing of its upper " + how_many(static_cast<std::size_t>(whole.storeys.count - with_area), "storey") +
               ": lower it, or the number of storeys";
  }
  return words;
}

std::string floor_losses_text(std::span<const FloorLoss> losses, std::span<const std::string> names) {
  constexpr std::size_t kNamed = 3;
  std::vector<std::uint32_t> order(losses.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto loss_of = [&](std::uint32_t k) { return losses[k].wanted - losses[k].had; };
  const std::size_t named = std::min(kNamed, order.size());
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(named), order.end(),
                    [&](std::uint32_t a, std::uint32_t b) {
                      return loss_of(a) != loss_of(b) ? loss_of(a) > loss_of(b) : losses[a].demand < losses[b].demand;
                    });
  std::string words;
  for (std::size_t k = 0; k < named; ++k) {
    const FloorLoss& loss = losses[order[k]];
    words += "; " + names[loss.demand] + " has " + fixed(loss.had, 0) + " of " + fixed(loss.wanted, 0) + " m²";
  }
  return losses.size() > named ? words + " and " + std::to_string(losses.size() - named) + " more have too little" : words;
}

std::string lost_cellar_text(const StandingResult& result, std::size_t i, std::span<const std::string> names) {
  if (result.stands_on < 0) return "";
  return "; `" + names[i] + "` has no cellar, because it stands on `" + names[static_cast<std::size_t>(result.stands_on)] +
         "`: set its `cellar_storeys` to 0";
}

}  // namespace bl::geometry
