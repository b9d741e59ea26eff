// The words stand in `core/serve/readiness`, so that the window has the same.
#include "ui/cli/finding_lines.h"

#include <algorithm>

#include "ui/cli/terminal.h"

namespace bl::cli {

bool print_findings(const std::vector<serve::Finding>& findings) {
  using serve::Verdict;
  const auto colour_of = [](Verdict verdict) {
    return verdict == Verdict::good ? Colour::green : verdict == Verdict::look ? Colour::yellow : Colour::red;
  };
  for (const serve::Finding& finding : findings) print_line(serve::line_of(finding), colour_of(finding.verdict));
  return std::any_of(findings.begin(), findings.end(), [](const serve::Finding& f) { return f.verdict == Verdict::bad; });
}

}  // namespace bl::cli
