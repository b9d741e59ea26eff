// The facilitator says which part of the scene an area is.
#include "core/base/text.h"
#include "core/room/event_builder.h"

namespace bl::room {

namespace {

struct DefineArea {
  struct In {
    std::string area;
    Selection nodes;
    std::vector<Point3> outline;
  };
  static constexpr Rights kRights{};
  static void declare(EventBuilder<DefineArea>& e) {
    e.id("define_area")
        .label("Define area")
        .doc(
            "An area is a part of the scene that some people may change: nodes that are named, those of a type or tag, and those "
            "that stand inside an outline.");
    e.argument(&In::area, "area").required().doc("Name of the area.");
    e.argument(&In::nodes, "nodes").doc("Nodes by name, type or tag.");
    e.argument(&In::outline, "outline").unit(Unit::metre).doc("Corners of a polygon in plan, in order; no corners for none.");
  }
  static Result<void> apply(RoomState& state, const In& in, const EventPlace&) {
    if (!is_identifier(in.area))
      return Error{ErrorCode::parse, "area", "a name has 1 to 64 of a-z, 0-9, _ and -, and begins with a letter or digit"};
    if (!in.outline.empty() && in.outline.size() < 3)
      return Error{ErrorCode::geometry, "outline", "has fewer than three corners"};
    if (in.outline.empty() && in.nodes.is_empty()) return Error{ErrorCode::missing, "nodes", "name nodes or draw an outline"};
    Area& area = state.areas[in.area];
    area.nodes = in.nodes;
    area.outline = in.outline;
    return {};
  }
};

}  // namespace

}  // namespace bl::room

BL_EVENT(define_area, DefineArea)
