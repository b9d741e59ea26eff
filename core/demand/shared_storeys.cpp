// Buildings of several volumes as rows of tables, and as rules read them.
#include "core/demand/shared_storeys.h"

#include <algorithm>

namespace bl::demand {

namespace {

constexpr double kMostMetres = 1e9, kLeastStorey = 0.1;  // [m]
constexpr int kMostCount = 1000;

}  // namespace

Table table_of(const std::optional<Building>& building) {
  Table table{{"host", "storeys", "least", "held", "storey_height", "bottom", "top", "limit", "part", "limited_by"}, {}};
  if (!building) return table;
  auto& row = table.rows.emplace_back();
  row.emplace_back(building->host);
  for (const double number :
       {static_cast<double>(building->wished), static_cast<double>(building->least), static_cast<double>(building->held),
        building->storey_height, building->bottom, building->top, building->limit, building->part})
    row.emplace_back(number);
  row.emplace_back(building->limited_by);
  return table;
}

std::optional<Building> building_in(const std::optional<Shared<Table>>& table) {
  if (!table || (*table)->rows.empty()) return std::nullopt;
  // A table may hold any numbers; what is reckoned with has to stay finite.
  const auto metres = [&](const char* name, double least) { return std::clamp((*table)->number(0, name), least, kMostMetres); };
  const auto count = [&](const char* name) {
    return static_cast<int>(std::clamp((*table)->number(0, name), 0.0, static_cast<double>(kMostCount)));
  };
  return Building{(*table)->text(0, "host"),
                  count("storeys"),
                  count("least"),
                  count("held"),
                  metres("storey_height", kLeastStorey),
                  metres("bottom", -kMostMetres),
                  metres("top", -kMostMetres),
                  metres("limit", 0),
                  std::clamp((*table)->number(0, "part"), 0.0, 1.0),
                  (*table)->text(0, "limited_by")};
}

StandingVolume standing_in(StandingVolume own, const std::optional<Building>& building) {
  if (!building) return own;
  return {building->held, building->wished, building->least, building->storey_height, building->limit, own.is_locked};
}

double ground_below(const std::optional<Building>& building, double own) { return building ? building->bottom : own; }

const std::string& holder_of(const std::optional<Building>& building, const std::string& own) {
  return building ? building->host : own;
}

std::string named_holder(const std::optional<Building>& building, const std::string& own) {
  return building ? "the building of `" + building->host + "`" : "`" + own + "`";
}

std::string why_it_stays(const std::optional<Building>& building, const std::string& own) {
  if (!building || building->host == own) return "";
  return "`" + own + "` stands where `" + building->host + "` does, whose footprint it shares";
}

}  // namespace bl::demand
