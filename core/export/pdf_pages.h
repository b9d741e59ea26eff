// Sheets and tables as the pages of a PDF.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/export/plan_sheet.h"

namespace bl::exporting {

struct PdfBook {
  std::string bytes;
  bool lost_letters = false;  ///< texts had letters that its fonts lack; they are question marks
};

/// One page for each sheet. `title`, `about`: of the properties of the file.
Result<PdfBook> pdf_pages(const std::vector<PlanSheet>& sheets, const std::string& title, const std::string& about);

}  // namespace bl::exporting
