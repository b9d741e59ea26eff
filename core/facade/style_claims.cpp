// The first by name wins, and the rest is said.
#include "core/facade/style_claims.h"

#include <algorithm>

#include "core/base/text.h"

namespace bl::facade {

StyleClaim settle_claims(std::span<const std::string> claims, std::span<const std::string> known) {
  StyleClaim out;
  if (claims.empty()) return {"", "no style dresses it: lay a link `facade_style` to it, or name a style in `style`"};
  std::string others, unknown, guess;
  for (const std::string& name : claims) {
    const bool is_known = std::find(known.begin(), known.end(), name) != known.end();
    if (is_known && out.dresser.empty()) {
      out.dresser = name;
      continue;
    }
    std::string& list = is_known ? others : unknown;
    list += (list.empty() ? "`" : ", `") + name + "`";
    if (!is_known && guess.empty()) guess = did_you_mean(name, known);
  }
  if (!others.empty())
    out.message = "claimed by " + others + " as well; `" + out.dresser + "` holds, because it comes first by name";
  if (!unknown.empty())
    out.message += (out.message.empty() ? "" : "; ") + std::string("there is no style named ") + unknown + guess;
  return out;
}

}  // namespace bl::facade
