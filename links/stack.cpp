// Sets one volume on top of another, or on the same level.
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "core/define/link_builder.h"
#include "core/define/registry.h"

namespace bl {

namespace {

struct Stack {
  enum class Relation { on_top, same_level };
  struct In {
    Relation relation = Relation::on_top;
    double gap = 0, stiffness = 0.2;
    bool centred = true;
  };
  struct Ends {
    Point3 from, to;
    double from_bottom = 0, from_height = 0, to_bottom = 0, to_height = 0;
    std::string id;
    std::optional<int> from_storeys, to_storeys;
  };
  struct Out {
    Vector3 to;
    std::optional<std::vector<std::string>> bases;
  };

  static void declare(LinkBuilder<Stack>& l) {
    l.family(LinkFamily::order);
    l.id("stack").label("Stack").doc(
        "Sets a volume on top of another one, or on the same level. Only the second volume moves. While one of the two has no "
        "shape yet, heights do not change. Where both stand in storeys, on top means that the second one stands on the roof of "
        "the "
        "first: its footprint is clipped to that roof, and the two do not compete for ground.");
    l.param(&In::relation, "relation",
            {{Relation::on_top, "on_top", "The lowest point of the second volume meets the highest point of the first."},
             {Relation::same_level, "same_level", "The lowest points of both volumes are on one level."}})
        .doc("How the two volumes stand to each other.");
    l.param(&In::gap, "gap")
        .unit(Unit::metre)
        .min(0)
        .soft(0, 20)
        .doc("The clear height between the two volumes; used on top only, and not between volumes that stand in storeys.");
    l.param(&In::centred, "centred").doc("When on, the second volume also moves over the middle of the first; used on top only.");
    l.param(&In::stiffness, "stiffness")
        .unit(Unit::ratio)
        .range(0, 1)
        .soft(0, 0.5)
        .doc("The share of the deviation that is corrected in one tick.");
    l.reads(&Ends::from, End::from, "node.position", Unit::metre).reads(&Ends::to, End::to, "node.position", Unit::metre);
    l.reads(&Ends::from_bottom, End::from, "smart_volume.bottom", Unit::metre);
    l.reads(&Ends::from_height, End::from, "smart_volume.height", Unit::metre);
    l.reads(&Ends::to_bottom, End::to, "smart_volume.bottom", Unit::metre);
    l.reads(&Ends::to_height, End::to, "smart_volume.height", Unit::metre);
    l.reads(&Ends::id, End::from, "node.id");
    l.reads_if_there(&Ends::from_storeys, End::from, "footprint.storeys_built");
    l.reads_if_there(&Ends::to_storeys, End::to, "footprint.storeys_built");
    l.proposes(&Out::to, End::to, "node.position", Unit::metre);
    l.proposes_if_there(&Out::bases, End::to, "footprint.bases");
  }

  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick&) {
    const bool is_on_top = in.relation == Relation::on_top;
    Vector3 error;
    if (is_on_top && in.centred) error = {ends.from.x - ends.to.x, ends.from.y - ends.to.y, 0};
    // What stands has its height from what it stands on, not from its position.
    if (ends.from_storeys && ends.to_storeys) {
      if (!is_on_top) return Out{};
      return Out{error * in.stiffness, std::vector<std::string>{ends.id}};
    }
    if (ends.from_height > 0 && ends.to_height > 0) {
      const double level = is_on_top ? ends.from_bottom + ends.from_height + in.gap : ends.from_bottom;
      error.z = beyond(level - ends.to_bottom, 0.01);
    }
    return Out{error * in.stiffness, std::nullopt};
  }

 private:
  // Shapes that follow their positions never rest on a level exactly; a centimetre is near enough.
  static double beyond(double error, double band) { return error - std::clamp(error, -band, band); }
};

}  // namespace

}  // namespace bl

BL_LINK(stack, Stack)
