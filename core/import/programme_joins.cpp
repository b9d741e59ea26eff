// A name of several rows means all of them as neighbours, and the first of them as what carries or holds a volume.
#include "core/import/programme_joins.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "core/base/text.h"

namespace bl::importing {

namespace {

class Joiner {
 public:
  Joiner(ProgrammeImport& import, const std::vector<std::string>& written,
         const std::function<std::string(std::size_t, ProgrammeColumn)>& place, std::vector<Error>& errors)
      : import_(import), place_(place), errors_(errors) {
    for (std::size_t i = 0; i < import.rows.size(); ++i) {
      const ProgrammeRow& row = import.rows[i];
      rows_of_[lower_case(written[i])].push_back(i);
      if (written[i] != row.use) rows_of_[lower_case(row.use)].push_back(i);
      uses_.push_back(row.use);
      index_.emplace(row.use, i);
      by_use_.emplace(lower_case(row.use), i);
      names_[lower_case(row.name)].push_back(i);
    }
  }

  void neighbours(std::size_t i);
  void buildings();

 private:
  // A row of open space or of cellars is no body.
  static std::string why_no_body(const ProgrammeRow& row) {
    return row.is_open ? "is open space and no body" : "lies in cellars and is no body";
  }
  void note(const ProgrammeRow& row, const std::string& words) {
    import_.notes.push_back("Line " + std::to_string(row.line) + ": " + words);
  }
  std::optional<std::size_t> row_called(std::size_t i, const std::string& name, ProgrammeColumn column);
  void join(std::size_t i, std::string& name, ProgrammeColumn column);
  void look_for_circles();
  void give_to_building(ProgrammeRow& row, std::optional<double>& length, std::optional<double> ProgrammeRow::*which,
                        const char* label);
  void leave_to_building(ProgrammeRow& row);
  std::size_t row_of(const std::string& use) const {
    const auto found = index_.find(use);
    return found == index_.end() ? uses_.size() : found->second;
  }

  ProgrammeImport& import_;
  const std::function<std::string(std::size_t, ProgrammeColumn)>& place_;
  std::vector<Error>& errors_;
  std::vector<std::string> uses_;
  std::map<std::string, std::size_t> index_, by_use_;  // by the use; by it in small letters
  std::map<std::string, std::vector<std::size_t>> rows_of_, names_;
};

void Joiner::neighbours(std::size_t i) {
  ProgrammeRow& row = import_.rows[i];
  std::vector<std::string> joined;
  for (const std::string& name : row.adjacent_to) {
    const auto found = rows_of_.find(lower_case(name));
    if (found == rows_of_.end()) {
      errors_.push_back(
          {ErrorCode::not_found, place_(i, ProgrammeColumn::adjacent_to),
           "`" + name + "` is no use of this table" +
               (did_you_mean(name, uses_).empty() ? ". Write the name of another row." : did_you_mean(name, uses_))});
      continue;
    }
    for (const std::size_t other : found->second) {
      if (other == i && row.count == 1 && found->second.size() == 1)
        note(row, "`" + row.use + "` cannot be adjacent to itself alone; this was left out.");
      const ProgrammeRow& partner = import_.rows[other];
      if (!row.has_volumes() || !partner.has_volumes()) {
        const ProgrammeRow &without = row.has_volumes() ? partner : row, &with = row.has_volumes() ? row : partner;
        note(row, "`" + without.use + "` " + why_no_body(without) + " that `" + with.use + "` could touch; this was left out.");
        continue;
      }
      const bool wanted = other != i || row.count > 1;
      if (wanted && std::find(joined.begin(), joined.end(), partner.use) == joined.end()) joined.push_back(partner.use);
    }
  }
  row.adjacent_to = std::move(joined);
}

std::optional<std::size_t> Joiner::row_called(std::size_t i, const std::string& name, ProgrammeColumn column) {
  const std::string lower = lower_case(name);
  // A use that stands in several rows is the first of them: the others have got numbers.
  if (const auto exact = by_use_.find(lower); exact != by_use_.end()) {
    if (rows_of_[lower].size() > 1)
      note(import_.rows[i], "`" + name + "` is the use of " + std::to_string(rows_of_[lower].size()) +
                                " rows; the first of them, `" + uses_[exact->second] + "`, was taken.");
    return exact->second;
  }
  if (const auto named = names_.find(lower); named != names_.end()) return named->second.front();
  errors_.push_back({ErrorCode::not_found, place_(i, column),
                     "`" + name + "` is no row of this table" +
                         (did_you_mean(name, uses_).empty() ? ". Write the use of another row." : did_you_mean(name, uses_))});
  return std::nullopt;
}

// The name becomes the use of a row, or nothing.
void Joiner::join(std::size_t i, std::string& name, ProgrammeColumn column) {
  if (name.empty()) return;
  const ProgrammeRow& row = import_.rows[i];
  const auto found = row_called(i, std::exchange(name, ""), column);
  if (!found) return;
  const ProgrammeRow& other = import_.rows[*found];
  const bool is_cellar_of = row.is_below_ground && column == ProgrammeColumn::shares;
  if (*found == i) {
    errors_.push_back({ErrorCode::conflict, place_(i, column), "`" + row.use + "` names itself: write the use of another row."});
  } else if (!other.has_volumes() || (!row.has_volumes() && !is_cellar_of)) {
    const ProgrammeRow& without = other.has_volumes() ? row : other;
    note(row, "`" + without.use + "` " + why_no_body(without) +
                  (!other.has_volumes()                ? " that `" + row.use + "` could stand on or share"
                   : column == ProgrammeColumn::shares ? ": it shares no building"
                                                       : ": it stands on no roof") +
                  "; this was left out.");
  } else {
    name = other.use;
  }
}

void Joiner::look_for_circles() {
  for (std::size_t i = 0; i < import_.rows.size(); ++i) {
    if (import_.rows[i].on.empty() && import_.rows[i].shares.empty()) continue;
    std::size_t at = i;
    std::string way;
    for (std::size_t step = 0; step <= import_.rows.size() && at < import_.rows.size(); ++step) {
      const ProgrammeRow& row = import_.rows[at];
      at = row_of(row.on.empty() ? row.shares : row.on);
      if (at == i) break;
      if (at < import_.rows.size()) way += (way.empty() ? " by way of `" : "`, `") + import_.rows[at].use;
    }
    if (at != i) continue;
    const bool is_sharing = import_.rows[i].on.empty();
    const ProgrammeColumn column = is_sharing ? ProgrammeColumn::shares : ProgrammeColumn::on;
    errors_.push_back({ErrorCode::conflict, place_(i, column),
                       "`" + import_.rows[i].use + (is_sharing ? "` would share its own building" : "` would stand upon itself") +
                           way + (way.empty() ? "" : "`") + ": leave out one of the names."});
    import_.rows[i].on.clear();
    import_.rows[i].shares.clear();
  }
}

// A building has one footprint: what a row says of it counts where the row whose building it shares says nothing.
void Joiner::give_to_building(ProgrammeRow& row, std::optional<double>& length, std::optional<double> ProgrammeRow::*which,
                              const char* label) {
  if (!length) return;
  if (row.is_below_ground) {
    note(row, std::string("the ") + label + " of `" + row.use + "` was left out: what lies below the ground has none.");
    return length.reset();
  }
  ProgrammeRow* host = &import_.rows[row_of(row.shares)];
  while (!host->shares.empty()) host = &import_.rows[row_of(host->shares)];
  const std::string begin = std::string("the ") + label + " of `" + row.use + "`";
  if (!(host->*which)) {
    host->*which = length;
    note(row, begin + ", " + shortest(*length) + " m, holds for the building of `" + host->use + "` that it shares.");
  } else if (host->*which != length) {
    note(row, begin + " was left out: it shares the building of `" + host->use + "`, which has a " + label + " of " +
                  shortest(*(host->*which)) + " m.");
  }
  length.reset();
}

// What a row says of its own footprint or ground has no place where another row decides.
void Joiner::leave_to_building(ProgrammeRow& row) {
  // The set-back that comes of it would hold from the edges of the roof, too, and nothing be left of a slim tower.
  if (!row.on.empty() && row.distance) {
    note(row, "the distance of `" + row.use + "` was left out: on the roof of `" + row.on + "` it keeps none.");
    row.distance.reset();
  }
  if (!row.on.empty() && row.cellar_storeys > 0) {
    note(row, "the cellars of `" + row.use + "` were left out: it stands on the roof of `" + row.on + "`.");
    row.cellar_storeys = 0;
  }
}

void Joiner::buildings() {
  for (std::size_t i = 0; i < import_.rows.size(); ++i) {
    ProgrammeRow& row = import_.rows[i];
    if (!row.on.empty() && !row.shares.empty()) {
      errors_.push_back({ErrorCode::conflict, place_(i, ProgrammeColumn::shares),
                         "`" + row.use + "` cannot stand on the roof of `" + row.on + "` and share the building of `" +
                             row.shares + "`: give one of the two. What shares a building stands where that building stands."});
      row.shares.clear();
    }
    join(i, row.on, ProgrammeColumn::on);
    join(i, row.shares, ProgrammeColumn::shares);
  }
  look_for_circles();
  for (ProgrammeRow& row : import_.rows) {
    if (row.shares.empty()) continue;
    give_to_building(row, row.depth, &ProgrammeRow::depth, "depth");
    give_to_building(row, row.distance, &ProgrammeRow::distance, "distance");
  }
  for (ProgrammeRow& row : import_.rows) leave_to_building(row);
  // Who shares with one that shares takes part in the same building.
  for (ProgrammeRow& row : import_.rows)
    while (!row.shares.empty() && !import_.rows[row_of(row.shares)].shares.empty())
      row.shares = import_.rows[row_of(row.shares)].shares;
}

}  // namespace

void join_rows(ProgrammeImport& import, const std::vector<std::string>& written_uses,
               const std::function<std::string(std::size_t, ProgrammeColumn)>& place, std::vector<Error>& errors) {
  Joiner joiner(import, written_uses, place, errors);
  for (std::size_t i = 0; i < import.rows.size(); ++i) joiner.neighbours(i);
  joiner.buildings();
}

}  // namespace bl::importing
