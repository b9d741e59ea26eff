// The list of formats, made once.
#include "core/export/format.h"

#include <algorithm>

namespace bl::exporting {

const FormatList& all_formats() {
  static const FormatList list = [] {
    FormatList made;
    register_formats(made);
    std::sort(made.begin(), made.end(), [](const FormatDefinition& a, const FormatDefinition& b) { return a.id < b.id; });
    return made;
  }();
  return list;
}

const FormatDefinition* find_format(std::string_view id) {
  const FormatList& list = all_formats();
  const auto found = std::find_if(list.begin(), list.end(), [&](const FormatDefinition& format) { return format.id == id; });
  return found == list.end() ? nullptr : &*found;
}

}  // namespace bl::exporting
