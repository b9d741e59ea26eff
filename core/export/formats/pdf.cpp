// The set of drawings as PDF: a page for each level at scale, and the area schedule before them.
#include <algorithm>

#include "core/base/text.h"
#include "core/export/format.h"
#include "core/export/identity.h"
#include "core/export/pdf_pages.h"
#include "core/export/sheet_options.h"
#include "core/reading/figures.h"

namespace bl::exporting {

namespace {

struct PdfFormat {
  struct Options : SheetOptions {};

  static void declare(FormatBuilder<PdfFormat>& f) {
    f.id("pdf").label("Set of drawings (PDF)");
    f.doc(
        "A page with the area schedule by use, then the plan of each cellar and each level at one scale, and a section, as the "
        "format svg draws "
        "them. Letters are "
        "those of western Europe; others become question marks, which is told.");
    f.ending(".pdf").marked({"%PDF", "/Creator (BehaviourLinks)", ""});
    declare_sheet_options(f);
  }

  static void cell(SheetGroup& group, double x, double y, std::string words, bool is_number, bool is_bold = false) {
    group.texts.push_back({{x, y}, 3, is_number ? SheetAnchor::end : SheetAnchor::start, is_bold, std::move(words)});
  }

  // The first page: what was asked for and got, in the frame of the plans.
  static PlanSheet schedule_of(const Proposal& proposal, const PlanSheet& like) {
    PlanSheet sheet = like;
    sheet.groups.clear();
    for (const SheetGroup& group : like.groups)
      if (group.id == "title") sheet.groups.push_back(group);
    SheetText& line = sheet.groups.front().texts[1];
    const int cellars = cellar_levels(proposal);
    line.words = "Area schedule, and plans of " + std::to_string(proposal.levels) + " levels" +
                 (cellars > 0 ? " and " + reading::counted(static_cast<std::size_t>(cellars), "cellar") : "") +
                 " at 1:" + shortest(like.scale);
    sheet.groups.front().texts.pop_back();
    SheetGroup table{"schedule", "Area schedule", false, {}, {}};
    const double x = like.window_low.x + 6;
    double y = like.window_low.y + 12;
    const auto row = [&](const std::string& name, const UseRow& use, bool is_bold) {
      cell(table, x, y, name, false, is_bold);
      const double values[] = {use.asked_area, use.floor_area, use.floor_area - use.asked_area, use.asked_volume, use.volume};
      cell(table, x + 90, y, std::to_string(use.buildings), true, is_bold);
      for (int k = 0; k < 5; ++k) cell(table, x + 120 + 30 * k, y, fixed(values[k], 1), true, is_bold);
      y += 6;
    };
    const char* heads[] = {"asked m²", "floor m²", "difference m²", "asked m³", "volume m³"};
    cell(table, x, y, "Use", false, true);
    cell(table, x + 90, y, "Volumes", true, true);
    for (int k = 0; k < 5; ++k) cell(table, x + 120 + 30 * k, y, heads[k], true, true);
    y += 7;
    // What has no place on this page is in the tables of xlsx and csv.
    const double after = 20 + 6 * static_cast<double>(proposal.open_spaces.size());
    const auto room = static_cast<std::size_t>(std::max(0.0, (like.window_high.y - y - after) / 6));
    for (std::size_t k = 0; k < std::min(room, proposal.uses.size()); ++k)
      row(use_name(proposal.uses[k].use), proposal.uses[k], false);
    if (room < proposal.uses.size())
      cell(table, x, y, "and " + std::to_string(proposal.uses.size() - room) + " more uses", false), y += 6;
    row("all", proposal.all, true);
    for (const OpenSpace& open : proposal.open_spaces) {
      if (y > like.window_high.y - 12) break;
      cell(table, x, y, open.use + ", open space", false);
      const double ground[] = {open.asked_area, open.area, open.area - open.asked_area};
      for (int k = 0; k < 3; ++k) cell(table, x + 120 + 30 * k, y, fixed(ground[k], 1), true);
      y += 6;
    }
    UseRow below;
    for (const Building& b : proposal.buildings) {
      for (const Storey& s : b.cellars) below.floor_area += s.floor_area;
      below.buildings += b.cellars.empty() ? 0 : 1;
    }
    if (below.buildings > 0) {
      cell(table, x, y, "cellars, not counted above", false);
      cell(table, x + 90, y, std::to_string(below.buildings), true);
      cell(table, x + 150, y, fixed(below.floor_area, 1), true);
    }
    sheet.groups.push_back(std::move(table));
    return sheet;
  }

  static Result<ExportFiles> write(const Proposal& proposal, const Options& options) {
    std::vector<PlanSheet> sheets;
    for (const DrawnLevel& level : drawn_levels(proposal)) {
      auto sheet = plan_sheet(proposal, level, options);
      if (!sheet) return sheet.error();
      if (sheets.empty()) sheets.push_back(schedule_of(proposal, *sheet));
      sheets.push_back(std::move(*sheet));
    }
    if (options.section != "none") {
      auto sheet = section_sheet(proposal, options);
      if (!sheet) return sheet.error();
      sheets.push_back(std::move(*sheet));
    }
    auto book = pdf_pages(sheets, proposal.name(), identity_line(proposal));
    if (!book) return book.error();
    ExportFiles made;
    if (book->lost_letters) made.notes.push_back("letters that western fonts lack are question marks in this file");
    made.files.push_back({"drawings.pdf", std::move(book->bytes)});
    return made;
  }
};

}  // namespace

BL_FORMAT(pdf, PdfFormat)

}  // namespace bl::exporting
