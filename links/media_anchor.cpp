// Keeps a picture at an offset from a node.
#include <optional>

#include "core/define/link_builder.h"
#include "core/define/registry.h"

namespace bl {

namespace {

struct MediaAnchor {
  struct In {
    double x = 0, y = 0, z = 0, share = 0.5;
  };
  struct Ends {
    Point3 media, node;
    double opacity = 1;
  };
  struct Out {
    std::optional<Vector3> media;
  };

  static void declare(LinkBuilder<MediaAnchor>& l) {
    l.id("media_anchor")
        .label("Media anchor")
        .doc("Makes a picture follow a node: it stays at an offset from it, wherever the node moves. Only the picture moves.");
    l.family(LinkFamily::distance);
    const auto offset = [&](double In::*member, const char* id, const char* doc) {
      l.param(member, id).unit(Unit::metre).range(-1e5, 1e5).soft(-50, 50).doc(doc);
    };
    offset(&In::x, "x", "Offset from the node along the scene's x axis.");
    offset(&In::y, "y", "Offset along the y axis.");
    offset(&In::z, "z", "Offset upwards.");
    l.param(&In::share, "share")
        .unit(Unit::ratio)
        .range(0, 1)
        .soft(0.05, 1)
        .doc("The share of the distance to its place that the picture moves in one tick.");
    l.reads(&Ends::media, End::from, "node.position", Unit::metre).reads(&Ends::node, End::to, "node.position", Unit::metre);
    l.reads(&Ends::opacity, End::from, "media.opacity", Unit::ratio);
    l.proposes(&Out::media, End::from, "node.position", Unit::metre);
  }

  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick&) {
    const Vector3 way = ends.node + Vector3{in.x, in.y, in.z} - ends.media;
    if (!(norm(way) > 1e-6)) return Out{};
    return Out{in.share * way};
  }
};

}  // namespace

}  // namespace bl

BL_LINK(media_anchor, MediaAnchor)
