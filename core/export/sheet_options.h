// The options of all formats that draw plans on paper.
#pragma once

#include "core/export/format.h"
#include "core/export/plan_sheet.h"

namespace bl::exporting {

/// The options of the format begin with SheetOptions.
template <class T>
void declare_sheet_options(FormatBuilder<T>& f) {
  f.option(&SheetOptions::paper, "paper", paper_choices()).doc("Size of the sheet, in landscape.");
  f.option(&SheetOptions::scale, "scale")
      .unit(Unit::ratio)
      .range(0, 1000000)
      .doc("The n of 1:n; 0: the largest usual one that fits.");
  f.option(&SheetOptions::extent, "extent",
           {{DrawnExtent::site, "site", "Plots and boundaries with what is proposed; surroundings are cut off at the frame."},
            {DrawnExtent::all, "all", "All existing buildings and streets as well, as far as `surroundings` shows them."}})
      .doc("What fits on the sheet of a plan.");
  f.option(&SheetOptions::surroundings, "surroundings").doc("With existing buildings and streets.");
  f.option(&SheetOptions::section, "section")
      .doc(
          "Where the section is cut: X1,Y1,X2,Y2 in metres, one height for a level cut, `auto` along the longest side through "
          "the highest "
          "volume, or "
          "`none`.");
  f.option(&SheetOptions::labels, "labels").doc("With the name and floor area of each storey.");
  declare_form_option(f);
}

}  // namespace bl::exporting
