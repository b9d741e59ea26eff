// Somebody says something about a node, a place, a tick, a scenario or the whole.
#include "core/base/text.h"
#include "core/room/event_builder.h"

namespace bl::room {

namespace {

struct CommentEvent {
  struct In {
    std::string id, text, node, scenario, parent;
    std::vector<Point3> place;
    std::int64_t tick = -1;
  };
  static constexpr Rights kRights{.designer = Ground::always,
                                  .stakeholder = Ground::always,
                                  .participant = Ground::always,
                                  .recorder = Ground::always,
                                  .activity = Activity::comment};
  static void declare(EventBuilder<CommentEvent>& e) {
    e.id("comment").label("Comment").doc("Something that a person says about the scene.");
    e.argument(&In::id, "id").required().doc("Name of the comment, made by who sends it; must not be taken.");
    e.words(&In::text, "text").required().doc("What is said, at most 2000 characters.");
    e.argument(&In::node, "node").doc("The node that it is about; empty for none.");
    e.argument(&In::place, "place").unit(Unit::metre).doc("The place that it is about: a list with one point, or with none.");
    e.argument(&In::tick, "tick").min(-1).doc("The tick that it is about; -1 for none.");
    e.argument(&In::scenario, "scenario").doc("The scenario that it is about; empty for none.");
    e.argument(&In::parent, "parent").doc("The comment that it answers; empty for none.");
  }
  static Result<void> apply(RoomState& state, const In& in, const EventPlace& place) {
    if (!is_identifier(in.id)) return Error{ErrorCode::parse, "id", "`" + in.id + "` cannot be a name"};
    if (state.comments.contains(in.id)) return Error{ErrorCode::duplicate, "id", "there is a comment `" + in.id + "` already"};
    if (!in.node.empty() && !place.scene.nodes.contains(in.node))
      return Error{ErrorCode::not_found, "node", "there is no node `" + in.node + "`"};
    if (!in.scenario.empty() && !state.scenarios.contains(in.scenario))
      return Error{ErrorCode::not_found, "scenario", "there is no scenario `" + in.scenario + "`"};
    if (!in.parent.empty() && !state.comments.contains(in.parent))
      return Error{ErrorCode::not_found, "parent", "there is no comment `" + in.parent + "`"};
    if (in.place.size() > 1) return Error{ErrorCode::out_of_range, "place", "a comment has one place at most"};
    Comment comment{
        .seat = place.seat, .text = in.text, .parent = in.parent, .anchor = {.node = in.node, .scenario = in.scenario}};
    if (!in.place.empty()) comment.anchor.place = Vector3{in.place[0].x, in.place[0].y, in.place[0].z};
    if (in.tick >= 0) comment.anchor.tick = in.tick;
    state.comments[in.id] = std::move(comment);
    return {};
  }
};

}  // namespace

}  // namespace bl::room

BL_EVENT(comment, CommentEvent)
