// Turn rules: which turns nobody may take at a junction; a second role of a junction.
#include "core/define/registry.h"
#include "core/define/typification_builder.h"

namespace bl {

namespace {

struct TurnRules {
  struct In {
    Table turns{{"from", "to", "rule"}, {}};
  };
  struct Out {
    std::int64_t forbidden = 0;
    std::string reason = "no traffic network takes care of it, or its network fails";
  };

  static void declare(TypificationBuilder<TurnRules>& t) {
    t.id("turn_rules").label("Turn rules");
    t.doc(
        "Turns that nobody may take by car at a junction, such as to the left, or that everybody has to take. People on foot, "
        "and "
        "trips that begin here, may go anywhere. All other turns are allowed, turning round as well.");
    t.in(&In::turns, "turns")
        .column({.id = "from",
                 .is_text = true,
                 .is_required = true,
                 .default_value = std::string(),
                 .doc = "Id of the street by which one arrives."})
        .column({.id = "to",
                 .is_text = true,
                 .is_required = true,
                 .default_value = std::string(),
                 .doc = "Id of the street by which one would leave; the same street means turning round."})
        .column({.id = "rule",
                 .is_text = true,
                 .default_value = std::string("no"),
                 .doc = "`no` forbids this turn; `only` forbids all others from there, turning round as well. Several rows with "
                        "`only` leave the choice among them."})
        .doc("The rules, one in each row.");
    t.out(&Out::forbidden, "forbidden").unit(Unit::count).doc("Number of turns that these rules forbid on streets open to cars.");
    t.out(&Out::reason, "reason").doc("Which rows do not hold, and why, as sentences; empty where all do.");
  }
};

}  // namespace

}  // namespace bl

BL_TYPIFICATION(turn_rules, TurnRules)
