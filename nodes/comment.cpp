// A comment: what somebody said about a node, a place, a moment or a scenario, and what became of it.
#include <string>

#include "core/define/registry.h"
#include "core/define/typification_builder.h"

namespace bl {

namespace {

struct Comment {
  enum class State { open, accepted, rejected };
  struct In {
    std::string text, author, answer;
    Selection about, scenario;
    Point3 place;
    bool is_at_place = false;
    std::int64_t tick = -1, rating = 0;
    State state = State::open;
  };
  struct Out {
    std::string message;
  };

  static void declare(TypificationBuilder<Comment>& t) {
    t.id("comment").label("Comment");
    t.column(CanvasColumn::second).icon(Icon::file);
    t.doc(
        "A remark that is kept in the scene, with what it is about and the answer to it. No link reads it, and nothing follows "
        "from "
        "it.");
    t.in(&In::text, "text").doc("What was said.");
    t.in(&In::author, "author").doc("Who said it, as a pseudonym or a role.");
    t.in(&In::about, "about").doc("The nodes that it is about; empty for none.");
    t.in(&In::is_at_place, "is_at_place").doc("On: it is about the place `place`.");
    t.in(&In::place, "place").unit(Unit::metre).doc("The place that it is about; used only where `is_at_place` is on.");
    t.in(&In::tick, "tick")
        .unit(Unit::count)
        .range(-1, 1000000000000)
        .soft(-1, 10000)
        .doc("The tick that it is about; -1: none.");
    t.in(&In::scenario, "scenario").doc("The scenario that it is about; empty for none.");
    t.in(&In::state, "state",
         {{State::open, "open", "Nobody has decided yet."},
          {State::accepted, "accepted", "It is taken up."},
          {State::rejected, "rejected", "It is not taken up."}})
        .doc("What became of it.");
    t.in(&In::answer, "answer").doc("The answer to its author: what is done about it, or why nothing is.");
    t.in(&In::rating, "rating")
        .unit(Unit::count)
        .range(-1000000, 1000000)
        .soft(-20, 20)
        .doc("How many more people agree with it than disagree.");
    t.out(&Out::message, "message").doc("What is missing, as a sentence; empty where nothing is.");
  }

  static Result<Out> evaluate(const In& in, const Tick&) {
    if (in.text.empty()) return Out{"the comment has no text"};
    if (in.state == State::rejected && in.answer.empty()) return Out{"the comment is rejected without an answer: say why"};
    return Out{};
  }
};

}  // namespace

}  // namespace bl

BL_TYPIFICATION(comment, Comment)
