// Compares what receivers have with what they ask for, and looks for the links that hold it.
#include "core/reading/sun_problems.h"

#include <algorithm>
#include <cmath>

#include "core/base/text.h"
#include "core/reading/views/sun_need.h"

namespace bl::reading {

namespace {

constexpr double kHour = 3600;    // [s]
constexpr double kLeastSun = 18;  // [s] that a sentence shows: 0.01 h

std::string hours_of(double seconds) {
  return seconds > 0 && seconds < kLeastSun ? "less than 0.01 h" : fixed(seconds / kHour, 2) + " h";
}

// Never more than there is: 99.99 % are not all.
std::string percent_had(double share) { return shortest(std::floor(1000 * share + 1e-6) / 10) + " %"; }
std::string percent_asked(double share) { return shortest(std::round(1000 * share) / 10) + " %"; }

// What a link that holds it says or does.
std::string word_on_sun(const State& state, std::size_t link, const SunNeed& need) {
  const LinkState& now = state.links[link];
  if (state.plan->links[link].error || now.has_failed()) return ", and does not run";
  const auto right = parameters_of<SunRightParameters>(state.plan->links[link]);
  const double allowed = right ? right->tolerance * (1 + right->play) * need.required_sun : 0;
  const double unavoidable = std::max(0.0, need.required_sun - need.sun_possible);
  // What it says may be about another receiver that it holds.
  if (unavoidable == 0 && need.deficit <= allowed)
    return ", and lets them lack " + hours_of(allowed) + " (`tolerance` and `play`): lower these, or `required_sun`";
  if (now.remark == LinkRemark::unmet) return ", and cannot meet it: its own sentence says why";
  if (now.is_stuck) return ", and gets no further: its own sentence says where";
  return need.deficit - unavoidable <= allowed ? "" : ", and is still at work";
}

std::string found_of(const SunNeed& need) {
  const bool is_all = need.required_share > 1 - kSunRounding;
  return "has " + hours_of(need.required_sun) + " of sun on " + percent_had(need.share_met) + " of its area, where " +
         percent_asked(need.required_share) + " is asked for: " +
         (is_all ? "its points lack " : "the sunniest " + percent_asked(need.required_share) + " of its points lack ") +
         hours_of(need.deficit) + " in the mean, and the worst of them has " + hours_of(need.sun_of_share);
}

// Who holds it, as the end of the sentence; what to do where nobody does.
void find_links(const State& state, const SunNeed& need, SunShortage& shortage) {
  std::string idle;
  for (std::size_t l = 0; l < state.plan->links.size(); ++l) {
    const LinkPlan& link = state.plan->links[l];
    if (link.definition == nullptr || !is_a<SunRightParameters>(*link.definition) ||
        !std::binary_search(link.nodes[0].begin(), link.nodes[0].end(), shortage.receiver))
      continue;
    if (!link.is_enabled || link.is_muted) {
      idle += (idle.empty() ? "`" : ", `") + link.id + "`";
      continue;
    }
    shortage.links.push_back(link.id);
    shortage.text += "; link `" + link.id + "` holds it" + word_on_sun(state, l, need);
  }
  if (!shortage.links.empty()) return;
  if (!idle.empty()) shortage.text += "; nothing holds it, because link " + idle + " is switched off or muted";
  else if (need.sun_possible >= need.required_sun)
    shortage.text += "; nothing holds it: lay a link of the kind `solar_right` from `" + state.plan->nodes[shortage.receiver].id +
                     "` to the volumes";
}

}  // namespace

std::vector<SunShortage> sun_shortages(const State& state) {
  std::vector<SunShortage> all;
  if (state.tick == 0) return all;
  for (const auto& [node, need] : rows<SunNeed>(state)) {
    if (!(need.required_sun > 0) || need.columns == 0 || need.share_met >= need.required_share - kSunRounding) continue;
    SunShortage& shortage = all.emplace_back(SunShortage{node, need.share_met, need.required_share, {}, found_of(need)});
    if (need.sun_possible < need.required_sun - kLeastSun)
      shortage.text += "; it can have " + hours_of(need.sun_possible) +
                       " where nobody takes any: lower `required_sun`, or choose another period at the sun";
    find_links(state, need, shortage);
  }
  return all;
}

}  // namespace bl::reading
