// Gives façades a style: the style dresses them from the next tick on.
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
    l.id("facade_style").label("Façade style").doc(
        "Gives façades a style, by which they are dressed. Orientations are told apart by the rows of the style; uses and heights "
        "can be told apart here. A façade that gets several styles takes the first by name and says so.");
    l.family(LinkFamily::facades);
    l.param(&In::uses, "uses").doc("Only volumes of these uses get the style; without any, all do.");
    l.param(&In::above, "above")
        .unit(Unit::metre)
        .range(0, 1e4)
        .soft(0, 100)
        .doc("Only volumes that are at least so high get the style.");
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
