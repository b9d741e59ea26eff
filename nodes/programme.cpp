// The programme of a project: the wanted floor area of each use, and the totals.
#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "core/base/text.h"
#include "core/define/registry.h"
#include "core/define/typification_builder.h"
#include "core/demand/brief_sums.h"

namespace bl {

namespace {

struct Programme {
  struct In {
    Table rows;
    Selection known_uses{{}, "use", {}};
  };
  struct Named {
    std::string use;
    bool is_open = false;
  };
  struct Sets {
    std::vector<Named> uses;
  };

  struct Out {
    double total_floor_area = 0, total_floor_area_min = 0, total_volume = 0, total_open_area = 0;
    std::int64_t items = 0, uses = 0;
    std::vector<std::string> open_uses;
  };

  static void declare(TypificationBuilder<Programme>& t) {
    t.id("programme").label("Programme");
    t.column(CanvasColumn::first).icon(Icon::file);
    t.doc(
        "A brief as a table: one row for each use, with the floor area of one item and the number of items. Links divide these "
        "demands among the SmartVolumes of the same use. A row whose use is open space asks for ground that nobody builds on.");
    const std::string area = "Floor area of one item";
    t.in(&In::rows, "rows")
        .column({.id = "use",
                 .is_text = true,
                 .is_required = true,
                 .is_key = true,
                 .default_value = std::string(),
                 .doc = "The use, such as `housing`."})
        .column({.id = "floor_area",
                 .is_required = true,
                 .unit = Unit::square_metre,
                 .minimum = 0,
                 .maximum = 1e8,
                 .doc = area + " that is aimed at."})
        .column({.id = "floor_area_min",
                 .unit = Unit::square_metre,
                 .minimum = 0,
                 .maximum = 1e8,
                 .doc = area + " that is insisted on; 0 means that there is none."})
        .column({.id = "floor_area_max",
                 .unit = Unit::square_metre,
                 .minimum = 0,
                 .maximum = 1e8,
                 .doc = area + " that is not exceeded; 0 means that there is none."})
        .column({.id = "storey_height",
                 .unit = Unit::metre,
                 .default_value = 3.2,
                 .minimum = 1,
                 .maximum = 50,
                 .doc = "Height from floor to floor."})
        .column({.id = "count",
                 .unit = Unit::count,
                 .default_value = 1.0,
                 .minimum = 1,
                 .maximum = 1e6,
                 .doc = "Number of items, a whole number."})
        .column({.id = "standing",
                 .is_text = true,
                 .default_value = std::string("stack"),
                 .doc = "What new volumes of the use may stand on: `ground`, `stack` (also on others) or `bridge` (also between "
                        "two)."})
        .column({.id = "note", .is_text = true, .default_value = std::string(), .doc = "A remark for people."})
        .doc("The uses that are wanted; each use stands in one row. Of open space, floor area means area of ground.");
    t.in(&In::known_uses, "known_uses").doc("The nodes of uses that say which uses are open space.");
    declare_totals(t);
    t.set("known_uses", &Sets::uses).reads(&Named::use, "use.use").reads(&Named::is_open, "use.is_open");
  }

  static void declare_totals(TypificationBuilder<Programme>& t) {
    t.out(&Out::total_floor_area, "total_floor_area")
        .shown_first()
        .unit(Unit::square_metre)
        .doc("Floor area that is aimed at, of all rows and items.");
    t.out(&Out::total_floor_area_min, "total_floor_area_min")
        .unit(Unit::square_metre)
        .doc("Floor area that is insisted on, of all rows and items; a row without a minimum adds nothing.");
    t.out(&Out::total_volume, "total_volume")
        .unit(Unit::cubic_metre)
        .doc("Volume that the floor area aimed at takes: area times storey height, of all rows and items.");
    t.out(&Out::total_open_area, "total_open_area")
        .unit(Unit::square_metre)
        .doc("Ground that rows of open space ask for; it is no part of the floor areas and the volume.");
    t.out(&Out::items, "items").shown_first().unit(Unit::count).doc("Number of items of all rows.");
    t.out(&Out::uses, "uses").shown_first().unit(Unit::count).doc("Number of uses, which is the number of rows.");
    t.out(&Out::open_uses, "open_uses").doc("The uses of rows that are open space, sorted.");
  }

  // An empty sentence where the row is sound; otherwise `column` is where the fault stands.
  static std::string fault_of(const Table& rows, std::size_t row, std::string& column) {
    const double area = rows.number(row, "floor_area"), least = rows.number(row, "floor_area_min"),
                 most = rows.number(row, "floor_area_max");
    column = "use";
    if (rows.text(row, "use").empty()) return "is empty: name the use";
    column = "floor_area";
    if (!(area > 0)) return "must be more than 0 m², found " + shortest(area);
    column = "floor_area_min";
    if (least > area)
      return "is " + shortest(least) + " m², more than the floor area aimed at (" + shortest(area) + " m²): lower it";
    column = "floor_area_max";
    if (most > 0 && most < area)
      return "is " + shortest(most) + " m², less than the floor area aimed at (" + shortest(area) +
             " m²): raise it, or write 0 for none";
    column = "count";
    const double count = rows.number(row, "count");
    if (!(count >= 1) || std::floor(count) != count)
      return "must be a whole number of items, at least 1, found " + shortest(count);
    column = "standing";
    const std::string& standing = rows.text(row, "standing");
    if (!standing.empty() && standing != "ground" && standing != "stack" && standing != "bridge")
      return "`" + standing + "` is none of `ground`, `stack` and `bridge`: write one of them";
    return {};
  }

  static Result<Out> evaluate(const In& in, const Sets& sets, const Tick&) {
    const Table& rows = in.rows;
    std::set<std::string> open;
    for (const Named& known : sets.uses)
      if (known.is_open) open.insert(lower_case(known.use));
    Out out;
    std::set<std::string> seen;
    for (std::size_t row = 0; row < rows.rows.size(); ++row) {
      const std::string place = "rows/" + std::to_string(row) + "/";
      std::string column;
      if (const std::string fault = fault_of(rows, row, column); !fault.empty())
        return Error{ErrorCode::out_of_range, place + column, (column == "use" ? "the use " : "the value ") + fault};
      const std::string& use = rows.text(row, "use");
      if (!seen.insert(use).second)
        return Error{ErrorCode::duplicate, place + "use",
                     "the use `" + use + "` stands in an earlier row too: put both into one row, or name one otherwise"};
      const demand::BriefSums sums = demand::brief_sums(rows, row);
      const bool is_open = open.contains(lower_case(use));
      if (is_open) out.open_uses.push_back(use);
      out.total_open_area += is_open ? sums.area : 0;
      out.total_floor_area += is_open ? 0 : sums.area;
      out.total_floor_area_min += is_open ? 0 : sums.area_min;
      out.total_volume += is_open ? 0 : sums.volume;
      out.items += static_cast<std::int64_t>(rows.number(row, "count"));
    }
    out.uses = static_cast<std::int64_t>(rows.rows.size());
    std::sort(out.open_uses.begin(), out.open_uses.end());
    return out;
  }
};

}  // namespace

}  // namespace bl

BL_TYPIFICATION(programme, Programme)
