// Plans of before as one view.
#include "core/wire/past_view.h"

namespace bl::wire {

View past_view(const ViewSources& sources) {
  View view;
  if (sources.past == nullptr) return view;
  for (const auto& [seq, plan] : *sources.past)
    for (const auto& [key, content] : *plan) view[std::to_string(seq) + "/" + key] = content;
  return view;
}

}  // namespace bl::wire
