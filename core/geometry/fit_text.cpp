// Sentences about fits.
#include "core/geometry/fit_text.h"

#include <algorithm>

#include "core/base/text.h"

namespace bl {

std::string with_names(std::string sentence, std::span<const std::string> names) {
  const std::size_t at = sentence.find("site "), begin = at + 5;
  if (at == std::string::npos) return sentence;
  const std::size_t end = std::min(sentence.find_first_not_of("0123456789", begin), sentence.size());
  const double site = parse_number(sentence.substr(begin, end - begin)).value_or(1e300);
  if (!(site < static_cast<double>(names.size()))) return sentence;
  return sentence.replace(at, end - at, "`" + names[static_cast<std::size_t>(site)] + "`");
}

std::string losses_text(std::span<const DemandLoss> losses, double total_demand, std::span<const std::string> names) {
  constexpr std::size_t kNamed = 5;
  if (losses.empty()) return "";
  std::vector<DemandLoss> sorted(losses.begin(), losses.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.demand - a.granted > b.demand - b.granted; });
  double missing = 0;
  std::string who;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const double loss = sorted[i].demand - sorted[i].granted;
    missing += loss;
    if (i < kNamed) who += (i > 0 ? ", `" : "`") + names[sorted[i].site] + "` by " + fixed(loss, 1) + " m³";
  }
  if (sorted.size() > kNamed) who += " and " + std::to_string(sorted.size() - kNamed) + " more";
  return fixed(total_demand, 1) + " m³ are wanted, " + fixed(missing, 1) + " m³ more than can be had; short of it fall " + who;
}

}  // namespace bl
