// Sentences about fits.
#include "core/geometry/fit_text.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

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
  // Only those that are named are put in order: a tick that changes a little may have a thousand losses to tell of.
  std::vector<std::uint32_t> order(losses.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto loss_of = [&](std::uint32_t k) { return losses[k].demand - losses[k].granted; };
  const std::size_t named = std::min(kNamed, order.size());
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(named), order.end(),
                    [&](std::uint32_t a, std::uint32_t b) {
                      const double of_a = loss_of(a), of_b = loss_of(b);
                      return of_a != of_b ? of_a > of_b : a < b;
                    });
  std::string who;
  for (const DemandLoss& loss : losses) missing += loss.demand - loss.granted;
  for (std::size_t i = 0; i < named; ++i) {
    who += (i > 0 ? ", `" : "`") + names[losses[order[i]].site] + "` by " + fixed(loss_of(order[i]), 1) + " m³";
  }
  if (order.size() > kNamed) who += " and " + std::to_string(order.size() - kNamed) + " more";
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
