// Buildings of several volumes as rows of tables, and as rules read them.
#include "core/demand/shared_storeys.h"

namespace bl::demand {

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
  const auto number = [&](const char* name) { return (*table)->number(0, name); };
  return Building{(*table)->text(0, "host"),
                  static_cast<int>(number("storeys")),
                  static_cast<int>(number("least")),
                  static_cast<int>(number("held")),
                  number("storey_height"),
                  number("bottom"),
                  number("top"),
                  number("limit"),
                  number("part"),
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
