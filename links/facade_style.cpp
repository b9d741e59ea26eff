// Gives façades a style, which applies from the next tick on.
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "core/define/link_builder.h"
#include "core/define/registry.h"

namespace bl {

namespace {

struct FacadeStyleLink {
  struct In {
    std::vector<std::string> uses;
    double above = 0;
  };
  struct Ends {
    std::string name, use;
    double height = 0;
  };
  struct Out {
    std::optional<std::vector<std::string>> style;
  };

  static void declare(LinkBuilder<FacadeStyleLink>& l) {
    l.id("facade_style")
        .label("Façade style")
        .doc(
            "Gives façades a style. The rows of the style distinguish orientations; this link can select volumes by use and "
            "height. A façade that gets several styles takes the first by name and reports it.");
    l.family(LinkFamily::facades);
    l.param(&In::uses, "uses").doc("Only volumes of these uses get the style; without any use, all volumes do.");
    l.param(&In::above, "above")
        .unit(Unit::metre)
        .range(0, 1e4)
        .soft(0, 100)
        .doc("Only volumes of at least this height get the style.");
    l.reads(&Ends::name, End::from, "facade_style.name");
    l.reads(&Ends::use, End::to, "smart_volume.use").reads(&Ends::height, End::to, "smart_volume.height", Unit::metre);
    l.proposes(&Out::style, End::to, "facade.style");
  }

  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick&) {
    const bool is_meant = in.uses.empty() || std::find(in.uses.begin(), in.uses.end(), ends.use) != in.uses.end();
    if (!is_meant || ends.height < in.above || ends.name.empty()) return Out{};
    return Out{std::vector<std::string>{ends.name}};
  }
};

}  // namespace

}  // namespace bl

BL_LINK(facade_style, FacadeStyleLink)
