// The set of drawings as PDF: a page for each level at scale, and an overview before them.
#include "core/export/format.h"
#include "core/export/identity.h"
#include "core/export/overview_sheet.h"
#include "core/export/pdf_pages.h"
#include "core/export/sheet_options.h"

namespace bl::exporting {

namespace {

struct PdfFormat {
  struct Options : SheetOptions {};

  static void declare(FormatBuilder<PdfFormat>& f) {
    f.id("pdf").label("Set of drawings (PDF)");
    f.doc(
        "A page with the programme against the result, the figures of the land, goals and problems, then the plan of each cellar "
        "and each level at one scale, and a section, as the format svg draws them. Letters are "
        "those of western Europe; others become question marks, which is told.");
    f.ending(".pdf").marked({"%PDF", "/Creator (BehaviourLinks)", ""});
    declare_sheet_options(f);
  }

  static Result<ExportFiles> write(const Proposal& proposal, const Options& options) {
    std::vector<PlanSheet> sheets;
    for (const DrawnLevel& level : drawn_levels(proposal)) {
      auto sheet = plan_sheet(proposal, level, options);
      if (!sheet) return sheet.error();
      if (sheets.empty()) sheets.push_back(overview_sheet(proposal, options, sheet->scale));
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
