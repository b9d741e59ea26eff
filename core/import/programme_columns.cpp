// The names that programme columns go by, and how headers are matched with them.
#include "core/import/programme_columns.h"

#include <algorithm>
#include <utility>

#include "core/base/text.h"

namespace bl::importing {

namespace {

// Ways to write a unit in a header → the symbol of the unit table.
constexpr std::array<std::pair<std::string_view, std::string_view>, 15> kUnits = {{{"m2", "m2"},
                                                                                   {"sqm", "m2"},
                                                                                   {"sq_m", "m2"},
                                                                                   {"qm", "m2"},
                                                                                   {"m_2", "m2"},
                                                                                   {"square_metres", "m2"},
                                                                                   {"m3", "m3"},
                                                                                   {"m_3", "m3"},
                                                                                   {"cubic_metres", "m3"},
                                                                                   {"ha", "ha"},
                                                                                   {"km2", "km2"},
                                                                                   {"m", "m"},
                                                                                   {"metres", "m"},
                                                                                   {"cm", "cm"},
                                                                                   {"mm", "mm"}}};

// Every word of two letters is nearly `on`.
constexpr std::size_t kShortName = 2;

std::string unit_symbol(std::string_view word) {
  for (const auto& [written, symbol] : kUnits)
    if (written == word) return std::string(symbol);
  return "";
}

// Lower case; ² and ³ as digits; letters beyond ASCII stay; every run of other characters is one `_`.
std::string folded(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool letter = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || static_cast<unsigned char>(c) >= 0x80;
    if (text.substr(i).starts_with("²") || text.substr(i).starts_with("³")) {
      out += text.substr(i).starts_with("²") ? '2' : '3';
      ++i;
    } else if (letter) {
      out += c;
    } else if (!out.empty() && out.back() != '_') {
      out += '_';
    }
  }
  while (!out.empty() && out.back() == '_') out.pop_back();
  return out;
}

std::string place_of(const csv::CsvRecord& record, std::size_t index) {
  return "line " + std::to_string(record.line) + ", column " + std::to_string(index + 1);
}

std::string list_of(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list.append(list.empty() ? "`" : ", `").append(name).append("`");
  return list;
}

// How the command line is told that a header is one of our columns; in quotation marks where the shell would part it.
std::string column_option(std::string_view ours, const std::string& header) {
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.';
  };
  const std::string choice = std::string(ours) + "=" + header;
  return "--column " + (std::all_of(header.begin(), header.end(), is_plain) ? choice : "\"" + choice + "\"");
}

const ProgrammeColumnInfo* column_called(std::string_view name) {
  for (const ProgrammeColumnInfo& info : programme_columns())
    if (info.name == name || info.aliases.front() == name) return &info;
  return nullptr;
}

class Matcher {
 public:
  explicit Matcher(const csv::CsvRecord& record) : record_(record), taken_(record.fields.size(), false) {}
  Result<void> take_chosen(const std::map<std::string, std::string>& chosen);
  Result<void> take_aliases();
  Result<ProgrammeHeader> finish();

 private:
  Result<void> take(const ProgrammeColumnInfo& info, std::size_t index);
  Error missing(const std::string& what, const std::vector<ProgrammeColumn>& accepted) const;

  const csv::CsvRecord& record_;
  std::vector<bool> taken_;
  ProgrammeHeader header_;
};

Result<void> Matcher::take(const ProgrammeColumnInfo& info, std::size_t index) {
  const std::string& text = record_.fields[index];
  auto& found = header_.columns[static_cast<std::size_t>(info.column)];
  if (found)
    return Error{ErrorCode::duplicate, place_of(record_, index),
                 "The columns `" + found->header + "` and `" + text + "` both read as " + std::string(info.name) +
                     ". Rename one, or say which by " + column_option(info.name, text) + "."};
  const NormalHeader normal = normal_header(text);
  const UnitInfo* unit = normal.unit.empty() ? nullptr : find_unit(normal.unit);
  const bool wrong = unit != nullptr && !(unit->dimension == bl::info(info.unit).dimension);
  if (info.unit != Unit::none && info.unit != Unit::count && (wrong || !normal.unknown_unit.empty()))
    return Error{ErrorCode::wrong_unit, place_of(record_, index),
                 "The unit `" + (wrong ? normal.unit : normal.unknown_unit) + "` in the header `" + text + "` is not read for " +
                     std::string(info.name) + ". Use " + (info.unit == Unit::metre ? "m, cm or mm." : "m2, ha or km2.")};
  found = FoundColumn{index, text, normal.unit};
  taken_[index] = true;
  return {};
}

Result<void> Matcher::take_chosen(const std::map<std::string, std::string>& chosen) {
  std::vector<std::string> ours;
  for (const ProgrammeColumnInfo& info : programme_columns()) ours.emplace_back(info.name);
  for (const auto& [name, wanted] : chosen) {
    const ProgrammeColumnInfo* info = column_called(name);
    if (info == nullptr)
      return Error{ErrorCode::unknown_field, "columns",
                   "`" + name + "` is no column of a programme" +
                       (did_you_mean(name, ours).empty() ? "." : did_you_mean(name, ours)) + " There are: " + list_of(ours) +
                       "."};
    std::size_t index = record_.fields.size();
    for (std::size_t i = record_.fields.size(); i-- > 0;)
      if (record_.fields[i] == wanted ||
          (index == record_.fields.size() && folded(lower_case(record_.fields[i])) == folded(lower_case(wanted))))
        index = i;
    if (index == record_.fields.size())
      return Error{ErrorCode::not_found, "line " + std::to_string(record_.line),
                   "There is no column `" + wanted + "` for " + name + did_you_mean(wanted, record_.fields) +
                       " The header has: " + list_of(record_.fields) + "."};
    if (taken_[index])
      return Error{ErrorCode::conflict, place_of(record_, index),
                   "The column `" + wanted + "` is chosen twice. Choose another one for " + name + "."};
    if (auto done = take(*info, index); !done) return done;
  }
  return {};
}

Result<void> Matcher::take_aliases() {
  std::array<bool, kProgrammeColumns> chosen{};
  for (std::size_t k = 0; k < kProgrammeColumns; ++k) chosen[k] = header_.columns[k].has_value();
  for (std::size_t i = 0; i < record_.fields.size(); ++i) {
    if (taken_[i]) continue;
    const std::string name = normal_header(record_.fields[i]).name;
    for (const ProgrammeColumnInfo& info : programme_columns()) {
      if (chosen[static_cast<std::size_t>(info.column)]) continue;
      if (std::find(info.aliases.begin(), info.aliases.end(), name) == info.aliases.end()) continue;
      if (info.column == ProgrammeColumn::note && header_.at(info.column)) continue;  // a second one is left out below
      if (auto done = take(info, i); !done) return done;
    }
  }
  auto &use = header_.columns[static_cast<std::size_t>(ProgrammeColumn::use)],
       &name = header_.columns[static_cast<std::size_t>(ProgrammeColumn::name)];
  if (!use && name) {
    header_.notes.push_back("There is no column `use`; the column `" + name->header + "` was taken for it.");
    use = std::exchange(name, std::nullopt);
  }
  return {};
}

Error Matcher::missing(const std::string& what, const std::vector<ProgrammeColumn>& accepted) const {
  std::vector<std::string> names;
  for (const ProgrammeColumn column : accepted)
    for (const std::string_view alias : programme_columns()[static_cast<std::size_t>(column)].aliases) names.emplace_back(alias);
  const std::string place = "line " + std::to_string(record_.line);
  for (std::size_t i = 0; i < record_.fields.size(); ++i)
    if (!taken_[i] && !nearest_name(normal_header(record_.fields[i]).name, names).empty())
      return Error{ErrorCode::missing, place,
                   "There is no column " + what + ". If `" + record_.fields[i] + "` is meant, correct it, or give " +
                       column_option(what, record_.fields[i]) + ". The header has: " + list_of(record_.fields) + "."};
  return Error{ErrorCode::missing, place,
               "There is no column " + what + ". The header has: " + list_of(record_.fields) +
                   ". Accepted are: " + list_of(names) + ", or name the column by " + column_option(what, "HEADER")};
}

Result<ProgrammeHeader> Matcher::finish() {
  if (!header_.at(ProgrammeColumn::use)) return missing("use", {ProgrammeColumn::use, ProgrammeColumn::name});
  if (!header_.at(ProgrammeColumn::floor_area) &&
      !(header_.at(ProgrammeColumn::floor_area_min) && header_.at(ProgrammeColumn::floor_area_max)))
    return missing("floor_area_m2", {ProgrammeColumn::floor_area});
  std::vector<std::string> ours;
  for (const ProgrammeColumnInfo& info : programme_columns())
    if (!header_.at(info.column) && info.aliases.front().size() > kShortName) ours.emplace_back(info.aliases.front());
  for (std::size_t i = 0; i < record_.fields.size(); ++i) {
    if (taken_[i]) continue;
    const std::string hint = did_you_mean(normal_header(record_.fields[i]).name, ours);
    (hint.empty() ? header_.notes : header_.warnings)
        .push_back("Column " + std::to_string(i + 1) + " `" + record_.fields[i] + "` was left out" + (hint.empty() ? "." : hint));
  }
  return std::move(header_);
}

}  // namespace

const std::array<ProgrammeColumnInfo, kProgrammeColumns>& programme_columns() {
  static const std::array<ProgrammeColumnInfo, kProgrammeColumns> columns = {{
      {ProgrammeColumn::use, "use", Unit::none, {"use", "function", "usage", "program", "programme", "activity"}},
      {ProgrammeColumn::name, "name", Unit::none, {"name", "room", "room_name", "space", "space_name", "title"}},
      {ProgrammeColumn::floor_area,
       "floor_area_m2",
       Unit::square_metre,
       {"floor_area", "area", "floorarea", "target_area", "area_target", "floor_area_target", "floor_space", "size"}},
      {ProgrammeColumn::floor_area_min,
       "floor_area_min_m2",
       Unit::square_metre,
       {"floor_area_min", "min_floor_area", "area_min", "min_area", "minimum_area", "minimum_floor_area"}},
      {ProgrammeColumn::floor_area_max,
       "floor_area_max_m2",
       Unit::square_metre,
       {"floor_area_max", "max_floor_area", "area_max", "max_area", "maximum_area", "maximum_floor_area"}},
      {ProgrammeColumn::count,
       "count",
       Unit::count,
       {"count", "quantity", "room_quantity", "number_of_rooms", "amount", "items", "pieces"}},
      {ProgrammeColumn::storey_height,
       "storey_height_m",
       Unit::metre,
       {"storey_height", "story_height", "floor_height", "room_height", "height", "clear_height"}},
      {ProgrammeColumn::adjacent_to,
       "adjacent_to",
       Unit::none,
       {"adjacent_to", "adjacent", "adjacency", "adjacencies", "next_to", "near", "neighbours", "neighbors"}},
      {ProgrammeColumn::tags, "tags", Unit::none, {"tags", "tag", "labels", "keywords"}},
      {ProgrammeColumn::standing, "standing", Unit::none, {"standing", "stands_on", "support"}},
      {ProgrammeColumn::storeys, "storeys", Unit::count, {"storeys", "stories", "floors", "levels", "number_of_storeys"}},
      {ProgrammeColumn::open, "open", Unit::none, {"open", "is_open", "open_space", "unbuilt"}},
      {ProgrammeColumn::on, "on", Unit::none, {"on", "on_top_of", "on_roof_of", "upon"}},
      {ProgrammeColumn::shares, "shares", Unit::none, {"shares", "shares_with", "shared_with", "same_building"}},
      {ProgrammeColumn::below_ground,
       "below_ground",
       Unit::none,
       {"below_ground", "underground", "cellar", "cellars", "cellar_storeys", "basement", "basements"}},
      {ProgrammeColumn::depth, "depth_m", Unit::metre, {"depth", "building_depth"}},
      {ProgrammeColumn::distance, "distance_m", Unit::metre, {"distance", "building_distance", "separation", "spacing"}},
      {ProgrammeColumn::note,
       "note",
       Unit::none,
       {"note", "notes", "remark", "remarks", "comment", "comments", "description", "explanation"}},
  }};
  return columns;
}

NormalHeader normal_header(std::string_view header) {
  const std::string lower = lower_case(header);
  NormalHeader normal;
  const std::size_t open = lower.find_first_of("[("), close = lower.find_last_of("])");
  if (open != std::string::npos && close != std::string::npos && close > open) {
    const std::string inside = lower.substr(open + 1, close - open - 1);
    normal.unit = unit_symbol(folded(inside));
    if (normal.unit.empty()) normal.unknown_unit = inside;
    normal.name = folded(lower.substr(0, open) + " " + lower.substr(close + 1));
    return normal;
  }
  normal.name = folded(lower);
  for (const auto& [written, symbol] : kUnits) {
    const std::string_view name = normal.name;
    if (name.size() > written.size() + 1 && name.ends_with(written) && name[name.size() - written.size() - 1] == '_') {
      normal.unit = symbol;
      normal.name.resize(name.size() - written.size() - 1);
      if (normal.name.ends_with("_in")) normal.name.resize(normal.name.size() - 3);  // "area in m2"
      break;
    }
  }
  return normal;
}

Result<ProgrammeHeader> match_programme_header(const csv::CsvRecord& record, const std::map<std::string, std::string>& chosen) {
  Matcher matcher(record);
  if (auto done = matcher.take_chosen(chosen); !done) return done.error();
  if (auto done = matcher.take_aliases(); !done) return done.error();
  return matcher.finish();
}

}  // namespace bl::importing
