// The list of formats, made once.
#include "core/export/format.h"

#include <algorithm>
#include <string_view>

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

bool has_mark(const FormatDefinition& format, std::string_view head, std::string_view tail) {
  const std::string_view near = head.substr(0, kMarkReach);
  return std::any_of(format.marks.begin(), format.marks.end(), [&](const FileMark& mark) {
    return head.starts_with(mark.begin) && near.find(mark.within) != std::string_view::npos && tail.ends_with(mark.end);
  });
}

}  // namespace bl::exporting
