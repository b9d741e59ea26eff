// The area schedule as one table: a row for each storey, building and use, and one for all.
#include <initializer_list>

#include "core/base/text.h"
#include "core/csv/csv_table.h"
#include "core/export/digits.h"
#include "core/export/format.h"
#include "core/export/identity.h"
#include "core/export/read_proposal.h"

namespace bl::exporting {

namespace {

struct CsvFormat {
  struct Options : FormOptions {
    bool storeys = true;
  };

  static void declare(FormatBuilder<CsvFormat>& f) {
    f.id("csv").label("Area schedule (CSV)");
    f.doc(
        "One table by RFC 4180 with decimal points: a row for each storey, each building, each use, one for all, and one for "
        "each indicator, each garden with the share of its area that has its sun, and each use of open space, with its target. "
        "Lengths are written in millimetres, areas and volumes with six decimals; the floor "
        "areas of the storeys add up to that of their building, and buildings to uses. The last columns name the scene, its "
        "state, and the form that was measured.");
    f.ending(".csv").begins("row,building,");
    f.option(&Options::storeys, "storeys").doc("With a row for each storey.");
    declare_form_option(f);
  }

  using Row = std::vector<csv::CsvCell>;
  static constexpr std::size_t kBuildingColumns = 16, kIndicatorColumns = 4;

  static Row row_of_use(const UseRow& use, const char* kind, double floor_area) {
    return {kind,
            "",
            "",
            use.use,
            "",
            "",
            "",
            "",
            floor_area,
            "",
            to_millionths(use.asked_area),
            to_millionths(use.volume),
            to_millionths(use.asked_volume),
            "",
            "",
            ""};
  }

  // Of the storeys as they are written, so that rows add up to the last digit.
  static double written_area(const Building& b) {
    if (b.storeys.empty()) return to_millionths(b.floor_area);
    double sum = 0;
    for (const Storey& s : b.storeys) sum += to_millionths(s.floor_area);
    return to_millionths(sum);
  }
  // Of the buildings as they are written: those of a use, or all.
  static double written_area(const Proposal& proposal, const std::string* use) {
    double sum = 0;
    for (const auto* list : {&proposal.buildings, &proposal.shapeless})
      for (const Building& b : *list)
        if (use == nullptr || b.use == *use) sum += written_area(b);
    return to_millionths(sum);
  }

  static Row indicator_row(const char* kind, const std::string& label, const std::string& use,
                           std::initializer_list<csv::CsvCell> values) {
    Row row = {kind, "", label, use};
    row.resize(kBuildingColumns, "");
    row.insert(row.end(), values.begin(), values.end());
    return row;
  }

  static void add_goals(const Proposal& proposal, std::vector<Row>& rows) {
    for (const Indicator& one : proposal.indicators)
      rows.push_back(
          indicator_row("indicator", one.name, "", {to_millionths(one.value), to_millionths(one.target), one.unit, one.status}));
    for (const SunPlace& sun : proposal.suns)
      rows.push_back(indicator_row(
          "sun", sun.name, "",
          {to_millionths(sun.share), to_millionths(sun.required_share),
           "share of the area with " + shortest(to_millimetres(sun.required_hours)) + " h", sun.is_met() ? "met" : "short"}));
    for (const OpenSpace& open : proposal.open_spaces)
      rows.push_back(indicator_row(
          "open space", "", open.use,
          {to_millionths(open.area), to_millionths(open.asked_area), "m2", open.why_short.empty() ? "met" : "short"}));
  }

  static std::vector<std::string> header() {
    return {"row",
            "building",
            "label",
            "use",
            "form",
            "storey",
            "bottom [m]",
            "top [m]",
            "floor_area [m2]",
            "drawn_area [m2]",
            "asked_floor_area [m2]",
            "volume [m3]",
            "asked_volume [m3]",
            "footprint [m2]",
            "x [m]",
            "y [m]",
            "value",
            "target",
            "unit",
            "status",
            "scene",
            "hash",
            "tick",
            "place",
            "measured"};
  }

  static Result<ExportFiles> write(const Proposal& proposal, const Options& options) {
    std::vector<Row> rows;
    const auto add_building = [&](const Building& b, const char* form, csv::CsvCell drawn) {
      rows.push_back({"building", b.id, b.label, b.use, form, b.storeys.size(), to_millimetres(b.bottom), to_millimetres(b.top),
                      written_area(b), std::move(drawn), to_millionths(b.asked_area), to_millionths(b.volume),
                      to_millionths(b.asked_volume), to_millionths(b.footprint), to_millimetres(b.place.x),
                      to_millimetres(b.place.y)});
    };
    for (const Building& b : proposal.buildings) {
      const char* form = b.is_standing ? "standing" : "rounded";
      double drawn = 0;
      const auto add_storey = [&](const Storey& s, const char* kind) {
        if (options.storeys)
          rows.push_back({kind, b.id, b.label, b.use, form, s.number, to_millimetres(s.bottom), to_millimetres(s.top),
                          to_millionths(s.floor_area), to_millionths(area_of(s.faces)), "", "", "", "", "", ""});
      };
      for (const Storey& s : b.storeys) {
        drawn += to_millionths(area_of(s.faces));
        add_storey(s, "storey");
      }
      for (const Storey& s : b.cellars) add_storey(s, "cellar");
      add_building(b, form, to_millionths(drawn));
    }
    for (const Building& b : proposal.shapeless) add_building(b, "no shape", "");
    for (const UseRow& use : proposal.uses) rows.push_back(row_of_use(use, "use", written_area(proposal, &use.use)));
    rows.push_back(row_of_use(proposal.all, "all", written_area(proposal, nullptr)));
    add_goals(proposal, rows);
    for (Row& row : rows) row.resize(kBuildingColumns + kIndicatorColumns, "");
    for (Row& row : rows)
      for (csv::CsvCell& cell :
           Row{proposal.name(), proposal.hash, proposal.tick, place_text(proposal), reading::choice_of(proposal.form).measured})
        row.push_back(std::move(cell));
    return ExportFiles{{{"schedule.csv", csv::write_csv(header(), rows)}}, {}};
  }
};

}  // namespace

BL_FORMAT(csv, CsvFormat)

}  // namespace bl::exporting
