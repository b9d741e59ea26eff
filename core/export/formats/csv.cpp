// The area schedule as one table: a row for each storey, building and use, and one for all.
#include "core/csv/csv_table.h"
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
        "each indicator and each use of open space with its target. The floor "
        "areas of the storeys add up to that of their building, and buildings to uses. The last columns name the scene, its "
        "state, and the form that was measured.");
    f.ending(".csv").begins("row,building,");
    f.option(&Options::storeys, "storeys").doc("With a row for each storey.");
    declare_form_option(f);
  }

  using Row = std::vector<csv::CsvCell>;
  static constexpr std::size_t kBuildingColumns = 16, kIndicatorColumns = 4;

  static Row row_of_use(const UseRow& use, const char* kind) {
    return {kind, "", "", use.use, "", "", "", "", use.floor_area, "", use.asked_area, use.volume, use.asked_volume, "", "", ""};
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
      rows.push_back({"building", b.id, b.label, b.use, form, b.storeys.size(), b.bottom, b.top, b.floor_area, std::move(drawn),
                      b.asked_area, b.volume, b.asked_volume, b.footprint, b.position.x, b.position.y});
    };
    for (const Building& b : proposal.buildings) {
      const char* form = b.is_standing ? "standing" : "rounded";
      double drawn = 0;
      const auto add_storey = [&](const Storey& s, const char* kind) {
        if (options.storeys)
          rows.push_back({kind, b.id, b.label, b.use, form, s.number, s.bottom, s.top, s.floor_area, area_of(s.faces), "", "", "",
                          "", "", ""});
      };
      for (const Storey& s : b.storeys) {
        drawn += area_of(s.faces);
        add_storey(s, "storey");
      }
      for (const Storey& s : b.cellars) add_storey(s, "cellar");
      add_building(b, form, drawn);
    }
    for (const Building& b : proposal.shapeless) add_building(b, "no shape", "");
    for (const UseRow& use : proposal.uses) rows.push_back(row_of_use(use, "use"));
    rows.push_back(row_of_use(proposal.all, "all"));
    for (const Indicator& one : proposal.indicators) {
      Row row = {"indicator", "", one.name};
      row.resize(kBuildingColumns, "");
      for (csv::CsvCell& cell : Row{one.value, one.target, one.unit, one.status}) row.push_back(std::move(cell));
      rows.push_back(std::move(row));
    }
    for (const OpenSpace& open : proposal.open_spaces) {
      Row row = {"open space", "", "", open.use};
      row.resize(kBuildingColumns, "");
      for (csv::CsvCell& cell : Row{open.area, open.asked_area, "m2", open.why_short.empty() ? "met" : "short"})
        row.push_back(std::move(cell));
      rows.push_back(std::move(row));
    }
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
