// Shares out each storey's façade.
#include "core/facade/dressing.h"

#include <algorithm>
#include <cmath>

#include "core/base/text.h"

namespace bl::facade {

WindowBand band_of(const FacadeRule& rule, double storey_height) {
  const double sill = std::clamp(rule.sill, 0.0, storey_height);
  return {sill, std::max(sill, storey_height - std::max(0.0, rule.band))};
}

std::array<WindowBand, kOrientations> bands_of(const FacadeRules& rules, double storey_height) {
  std::array<WindowBand, kOrientations> bands;
  for (std::size_t k = 0; k < kOrientations; ++k) bands[k] = band_of(rules[k], storey_height);
  return bands;
}

double most_glazing(const FacadeRule& rule, double storey_height) {
  const WindowBand band = band_of(rule, storey_height);
  return storey_height > 0 ? (band.head - band.sill) / storey_height : 0;
}

double window_width(const FacadeRule& rule, double factor, double storey_height) {
  const double most = most_glazing(rule, storey_height);
  return most > 0 ? std::clamp(rule.glazing * factor, 0.0, most) / most : 0;
}

DressedArea& DressedArea::operator+=(const DressedArea& other) {
  glazed += other.glazed;
  opaque += other.opaque;
  cost += other.cost;
  panels += other.panels;
  return *this;
}

Dressing dress(const FacadeSurvey& survey, const FacadeRules& rules, double factor, double storey_height) {
  Dressing out;
  for (const FacadeRow& row : survey.rows) {
    const FacadeRule& rule = rules[static_cast<std::size_t>(row.orientation)];
    const double area = row.area(), wanted = std::clamp(rule.glazing * factor, 0.0, 1.0) * area;
    DressedArea part;
    part.glazed = std::min(wanted, row.band);
    part.opaque = area - part.glazed;
    part.cost = part.glazed * rule.cost_glazed + part.opaque * rule.cost_opaque;
    if (rule.module > 0 && storey_height > 0) part.panels = area / (rule.module * storey_height);
    out.missing += std::max(0.0, wanted - most_glazing(rule, storey_height) * area);
    out.all += part;
    out.by_orientation[static_cast<std::size_t>(row.orientation)] += part;
    const auto storey = static_cast<std::size_t>(row.storey);
    if (out.by_storey.size() <= storey) out.by_storey.resize(storey + 1);
    out.by_storey[storey] += part;
  }
  return out;
}

void add_missing_text(const Dressing& dressing, std::string& message) {
  if (!(dressing.missing > 1e-9 * dressing.all.area())) return;
  message += (message.empty() ? "" : "; ") + fixed(dressing.missing, 1) +
             " m² of the glazing that is asked for find no room between sills and bands";
}

}  // namespace bl::facade
