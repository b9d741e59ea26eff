// Sentences about fits.
#include "core/geometry/fit_text.h"

#include <algorithm>

#include "core/base/text.h"

namespace bl::geometry {

std::string with_names(std::string sentence, std::span<const std::string> names) {
  const std::size_t at = sentence.find("site "), begin = at + 5;
  if (at == std::string::npos) return sentence;
  const std::size_t end = std::min(sentence.find_first_not_of("0123456789", begin), sentence.size());
  const double site = parse_number(sentence.substr(begin, end - begin)).value_or(1e300);
  if (!(site < static_cast<double>(names.size()))) return sentence;
  return sentence.replace(at, end - at, "`" + names[static_cast<std::size_t>(site)] + "`");
}

namespace {

constexpr std::string_view kShortOfIt = "; short of it fall ";

// The greatest loss first; `missing` is all of them together.
std::string list_of_losses(std::span<const DemandLoss> losses, std::span<const std::string> names, double& missing) {
  constexpr std::size_t kNamed = 5;
  std::vector<DemandLoss> sorted(losses.begin(), losses.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.demand - a.granted > b.demand - b.granted; });
  std::string who;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const double loss = sorted[i].demand - sorted[i].granted;
    missing += loss;
    if (i < kNamed) who += (i > 0 ? ", `" : "`") + names[sorted[i].site] + "` by " + fixed(loss, 1) + " m³";
  }
  if (sorted.size() > kNamed) who += " and " + std::to_string(sorted.size() - kNamed) + " more";
  return who;
}

}  // namespace

std::string losses_text(std::span<const DemandLoss> losses, double total_demand, std::span<const std::string> names) {
  if (losses.empty()) return "";
  double missing = 0;
  const std::string who = list_of_losses(losses, names, missing);
  return fixed(total_demand, 1) + " m³ are wanted, " + fixed(missing, 1) + " m³ more than can be had" + std::string(kShortOfIt) +
         who;
}

std::string with_losses(std::string sentence, std::span<const DemandLoss> losses, std::span<const std::string> names) {
  const std::size_t at = sentence.find(kShortOfIt);
  if (at == std::string::npos) return sentence;
  const std::size_t end = std::min(sentence.find("; ", at + kShortOfIt.size()), sentence.size());
  double missing = 0;
  const std::string who = list_of_losses(losses, names, missing);
  return sentence.replace(at, end - at, who.empty() ? "" : std::string(kShortOfIt) + who);
}

}  // namespace bl::geometry
