// Underscores are spaces, and the first letter is a capital.
#include "ui/desktop/view/labels.h"

#include <algorithm>
#include <cctype>

namespace bl::desktop {

std::string label_of(std::string_view id) {
  std::string text(id);
  std::replace(text.begin(), text.end(), '_', ' ');
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

std::string label_of_use(std::string_view use) { return use.empty() ? "No use" : label_of(use); }

}  // namespace bl::desktop
