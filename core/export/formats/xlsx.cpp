// The area schedule as a workbook: storeys, buildings, programme against result, indices of the plots; formulas with their
// values.
#include <algorithm>

#include "core/base/text.h"
#include "core/export/format.h"
#include "core/export/identity.h"
#include "core/export/read_proposal.h"
#include "core/export/xlsx_book.h"

namespace bl::exporting {

namespace {

struct XlsxFormat {
  struct Options : FormOptions {
    bool formulas = true;
  };

  static void declare(FormatBuilder<XlsxFormat>& f) {
    f.id("xlsx").label("Area schedule (XLSX)");
    f.doc(
        "A workbook: storeys, buildings, programme against result, open space, plots with their indices, indicators with their "
        "targets, "
        "problems, and what scene and state it is of. "
        "Sums are formulas over the rows above, or over the sheets before, and bring their values along, so that programs which "
        "do not calculate read the same numbers.");
    f.ending(".xlsx").marked({"PK\x03\x04", "", kXlsxEnd});
    f.option(&Options::formulas, "formulas").doc("Sums as formulas; else as numbers alone.");
    declare_form_option(f);
  }

  using Cells = std::vector<XlsxCell>;
  struct XlsxTables {
    const Proposal& proposal;
    const Options& options;

    static XlsxCell w(std::string text) { return XlsxCell::words(std::move(text)); }
    static XlsxCell b(std::string text) { return XlsxCell::words(std::move(text), XlsxStyle::bold); }
    static XlsxCell n(double value) { return XlsxCell::value(value); }
    static Cells header(std::initializer_list<const char*> names) {
      Cells cells;
      for (const char* name : names) cells.push_back(b(name));
      return cells;
    }
    XlsxCell f(const std::string& formula, double value, XlsxStyle style = XlsxStyle::two_decimals) const {
      return XlsxCell::sum(options.formulas ? formula : "", value, style);
    }
    // Of the rows 2 to `last`, as a spreadsheet counts.
    static std::string range(const char* sheet, char column, std::size_t last) {
      const std::string c(1, column);
      return std::string(sheet) + "!$" + c + "$2:$" + c + "$" + std::to_string(last);
    }
    static std::string above(char column, std::size_t last) {
      const std::string c(1, column);
      return "SUM(" + c + "2:" + c + std::to_string(last) + ")";
    }

    // Of the rows that have that name: the equals sign of spreadsheets takes Office for office.
    static std::string sum_where(const std::string& names, const std::string& name, const std::string& numbers) {
      return "SUMPRODUCT(EXACT(" + names + "," + name + ")*" + numbers + ")";
    }
    // In the order of the rows that a formula adds up.
    static double sum_of_storeys(const Building& building) {
      double sum = building.mesh != nullptr ? 0 : building.floor_area;
      for (const Storey& s : building.storeys) sum += s.floor_area;
      return sum;
    }

    XlsxSheet storeys() const {
      XlsxSheet sheet{"Storeys", {18, 24, 18, 10, 10, 12, 12, 16}, {}};
      sheet.rows.push_back(header({"building", "label", "use", "storey", "level", "bottom [m]", "top [m]", "floor area [m2]"}));
      double total = 0;
      for (const Building& building : proposal.buildings)
        for (const Storey& s : building.storeys) {
          sheet.rows.push_back({w(building.id), w(building.label), w(building.use), XlsxCell::value(s.number, XlsxStyle::plain),
                                XlsxCell::value(s.level, XlsxStyle::plain), n(s.bottom), n(s.top), n(s.floor_area)});
          total += s.floor_area;
        }
      sheet.rows.push_back({b("all"), {}, {}, {}, {}, {}, {}, f(above('H', sheet.rows.size()), total)});
      return sheet;
    }

    XlsxSheet buildings(std::size_t last_storey) const {
      XlsxSheet sheet{"Buildings", {18, 24, 18, 12, 10, 16, 18, 16, 14, 16, 14, 12, 12}, {}};
      sheet.rows.push_back(
          header({"building", "label", "use", "form", "storeys", "floor area [m2]", "asked floor area [m2]", "difference [m2]",
                  "volume [m3]", "asked volume [m3]", "footprint [m2]", "bottom [m]", "top [m]"}));
      double area = 0, asked = 0, volume = 0, asked_volume = 0, footprint = 0;
      const auto add = [&](const Building& one, const char* form, XlsxCell floor) {
        const std::string row = std::to_string(sheet.rows.size() + 1);
        const double sum = floor.number;
        sheet.rows.push_back({w(one.id), w(one.label), w(one.use), w(form),
                              XlsxCell::value(static_cast<double>(one.storeys.size()), XlsxStyle::plain), std::move(floor),
                              n(one.asked_area), f("F" + row + "-G" + row, sum - one.asked_area), n(one.volume),
                              n(one.asked_volume), n(one.footprint), n(one.bottom), n(one.top)});
        area += sum, asked += one.asked_area, volume += one.volume, asked_volume += one.asked_volume, footprint += one.footprint;
      };
      for (const Building& one : proposal.buildings) {
        const std::string of_storeys = sum_where(range("Storeys", 'A', last_storey), "A" + std::to_string(sheet.rows.size() + 1),
                                                 range("Storeys", 'H', last_storey));
        add(one, one.is_standing ? "standing" : "rounded", f(of_storeys, sum_of_storeys(one)));
      }
      for (const Building& one : proposal.shapeless) add(one, "no shape", n(one.floor_area));
      const std::size_t last = sheet.rows.size();
      sheet.rows.push_back({b("all"),
                            {},
                            {},
                            {},
                            {},
                            f(above('F', last), area),
                            f(above('G', last), asked),
                            f(above('H', last), area - asked),
                            f(above('I', last), volume),
                            f(above('J', last), asked_volume),
                            f(above('K', last), footprint)});
      return sheet;
    }

    XlsxSheet programme(std::size_t last_building) const {
      XlsxSheet sheet{"Programme", {24, 12, 20, 16, 16, 12, 18, 14}, {}};
      sheet.rows.push_back(header({"use", "volumes", "asked floor area [m2]", "floor area [m2]", "difference [m2]", "met",
                                   "asked volume [m3]", "volume [m3]"}));
      double asked = 0, area = 0, asked_volume = 0, volume = 0, count = 0;
      for (const UseRow& use : proposal.uses) {
        const std::string row = std::to_string(sheet.rows.size() + 1);
        const auto sum_of = [&](char column) {
          return sum_where(range("Buildings", 'C', last_building), "A" + row, range("Buildings", column, last_building));
        };
        double got = 0, got_volume = 0;
        for (const auto* list : {&proposal.buildings, &proposal.shapeless})
          for (const Building& one : *list)
            if (one.use == use.use) got += sum_of_storeys(one), got_volume += one.volume;
        sheet.rows.push_back(
            {w(use.use), XlsxCell::value(static_cast<double>(use.buildings), XlsxStyle::plain), n(use.asked_area),
             f(sum_of('F'), got), f("D" + row + "-C" + row, got - use.asked_area),
             use.asked_area > 0 ? f("D" + row + "/C" + row, got / use.asked_area, XlsxStyle::percent) : XlsxCell(),
             n(use.asked_volume), f(sum_of('I'), got_volume)});
        asked += use.asked_area, area += got, asked_volume += use.asked_volume, volume += got_volume;
        count += static_cast<double>(use.buildings);
      }
      const std::size_t last = sheet.rows.size();
      sheet.rows.push_back({b("all"),
                            f(above('B', last), count, XlsxStyle::plain),
                            f(above('C', last), asked),
                            f(above('D', last), area),
                            f(above('E', last), area - asked),
                            {},
                            f(above('G', last), asked_volume),
                            f(above('H', last), volume)});
      return sheet;
    }

    // Rows of the programme that ask for ground; only where there are any.
    XlsxSheet open_space() const {
      XlsxSheet sheet{"Open space", {24, 16, 16, 16, 12, 100}, {}};
      sheet.rows.push_back(header({"use", "asked ground [m2]", "open ground [m2]", "difference [m2]", "met", "why"}));
      double asked = 0, area = 0;
      for (const OpenSpace& open : proposal.open_spaces) {
        const std::string row = std::to_string(sheet.rows.size() + 1);
        sheet.rows.push_back(
            {w(open.use), n(open.asked_area), n(open.area), f("C" + row + "-B" + row, open.area - open.asked_area),
             open.asked_area > 0 ? f("C" + row + "/B" + row, open.area / open.asked_area, XlsxStyle::percent) : XlsxCell(),
             w(open.why_short)});
        asked += open.asked_area, area += open.area;
      }
      const std::size_t last = sheet.rows.size();
      sheet.rows.push_back({b("all"), f(above('B', last), asked), f(above('C', last), area), f(above('D', last), area - asked)});
      return sheet;
    }

    XlsxSheet plots() const {
      XlsxSheet sheet{"Plots", {24, 12, 14, 10, 10, 14, 14, 16, 14, 10, 10}, {}};
      sheet.rows.push_back(header({"plot", "kind", "land [m2]", "FSI", "GSI", "largest FSI", "largest GSI", "largest height [m]",
                                   "kept open [m2]", "OSR", "storeys"}));
      for (const Land& land : proposal.lands) {
        Cells row = {w(land.name), w(land.is_boundary ? "boundary" : "plot"), n(land.area)};
        if (!land.is_boundary)
          for (const std::optional<double>& value :
               {std::optional(land.fsi), std::optional(land.gsi), land.fsi_max, land.gsi_max, land.height_max})
            row.push_back(value ? n(*value) : XlsxCell());
        if (land.is_boundary && land.open_area > 0) row.resize(8), row.push_back(n(land.open_area));
        if (!land.is_boundary) row.resize(9), row.push_back(n(land.osr)), row.push_back(n(land.storeys));
        sheet.rows.push_back(std::move(row));
      }
      for (const NetGround& ground : proposal.grounds)
        sheet.rows.push_back({w(ground.name),
                              w("net land"),
                              n(ground.area),
                              n(ground.fsi),
                              n(ground.gsi),
                              {},
                              {},
                              {},
                              n(ground.open_area),
                              n(ground.osr),
                              n(ground.storeys)});
      return sheet;
    }

    // Only where there are any: what lies below the ground is no floor area of the schedule.
    XlsxSheet cellars() const {
      XlsxSheet sheet{"Cellars", {18, 24, 18, 10, 12, 12, 16}, {}};
      sheet.rows.push_back(header({"building", "label", "use", "storey", "bottom [m]", "top [m]", "area [m2]"}));
      double total = 0;
      for (const Building& building : proposal.buildings)
        for (const Storey& s : building.cellars) {
          sheet.rows.push_back({w(building.id), w(building.label), w(building.use), XlsxCell::value(s.number, XlsxStyle::plain),
                                n(s.bottom), n(s.top), n(s.floor_area)});
          total += s.floor_area;
        }
      sheet.rows.push_back({b("all"), {}, {}, {}, {}, {}, f(above('G', sheet.rows.size()), total)});
      return sheet;
    }

    XlsxSheet indicators() const {
      XlsxSheet sheet{"Indicators", {30, 14, 12, 14, 10, 14, 10, 10}, {}};
      sheet.rows.push_back(header({"indicator", "value", "goal", "target", "unit", "difference", "status", "score"}));
      for (const Indicator& one : proposal.indicators) {
        const std::string row = std::to_string(sheet.rows.size() + 1);
        sheet.rows.push_back({w(one.name), n(one.value), w(one.direction), n(one.target), w(one.unit),
                              f("B" + row + "-D" + row, one.value - one.target), w(one.status), n(one.score)});
      }
      // The share of a garden's area that has the sun it requires.
      for (const SunPlace& sun : proposal.suns) {
        const std::string row = std::to_string(sheet.rows.size() + 1);
        sheet.rows.push_back({w(sun.name + ": share of the area with " + fixed(sun.required_hours, 1) + " h of sun"),
                              n(sun.share), w("at_least"), n(sun.required_share), w(""),
                              f("B" + row + "-D" + row, sun.share - sun.required_share), w(sun.is_met() ? "met" : "short"),
                              n(sun.required_share > 0 ? std::min(1.0, sun.share / sun.required_share) : 1)});
      }
      return sheet;
    }

    // What failed, what cannot be met, and rules of plots that are broken, as everywhere.
    XlsxSheet problems() const {
      XlsxSheet sheet{"Problems", {30, 120}, {}};
      sheet.rows.push_back(header({"where", "what"}));
      for (const Trouble& one : proposal.troubles) sheet.rows.push_back({w(one.place), w(one.message)});
      return sheet;
    }

    XlsxSheet about() const {
      XlsxSheet sheet{"About", {24, 60}, {}};
      sheet.rows.push_back(header({"what", "value"}));
      for (const auto& [name, value] : identity_of(proposal)) sheet.rows.push_back({w(name), w(value)});
      for (const Building& volume : proposal.shapeless)
        sheet.rows.push_back({w("no shape"), w(volume.label + ": " + volume.why_shapeless)});
      return sheet;
    }
  };

  static Result<ExportFiles> write(const Proposal& proposal, const Options& options) {
    const XlsxTables tables{proposal, options};
    // Without their header and their sum: the row numbers of the last building and storey.
    const XlsxSheet storeys = tables.storeys();
    const XlsxSheet buildings = tables.buildings(storeys.rows.size() - 1);
    std::vector<XlsxSheet> sheets = {tables.programme(buildings.rows.size() - 1),
                                     buildings,
                                     storeys,
                                     tables.plots(),
                                     tables.indicators(),
                                     tables.problems(),
                                     tables.about()};
    if (XlsxSheet cellars = tables.cellars(); cellars.rows.size() > 2) sheets.insert(sheets.begin() + 3, std::move(cellars));
    if (!proposal.open_spaces.empty()) sheets.insert(sheets.begin() + 1, tables.open_space());
    auto book = xlsx_book(sheets, proposal.name(), identity_line(proposal));
    if (!book) return book.error();
    return ExportFiles{{{"schedule.xlsx", std::move(*book)}}, {}};
  }
};

}  // namespace

BL_FORMAT(xlsx, XlsxFormat)

}  // namespace bl::exporting
