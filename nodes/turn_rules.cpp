// Turn rules: the forbidden and mandatory turns at a junction; a second role of a junction.
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
        "Turns at a junction that are forbidden or mandatory for cars, such as a left turn. All other turns are allowed, U-turns "
        "as well. People on foot and trips that begin here may go anywhere.");
    t.in(&In::turns, "turns")
        .column({.id = "from",
                 .is_text = true,
                 .is_required = true,
                 .default_value = std::string(),
                 .doc = "Id of the street that the turn comes from."})
        .column({.id = "to",
                 .is_text = true,
                 .is_required = true,
                 .default_value = std::string(),
                 .doc = "Id of the street that the turn leads to; the same street means a U-turn."})
        .column({.id = "rule",
                 .is_text = true,
                 .default_value = std::string("no"),
                 .doc = "`no` forbids this turn; `only` forbids all others from that street, U-turns as well. Several rows with "
                        "`only` allow all of their turns."})
        .doc("The rules, one in each row.");
    t.out(&Out::forbidden, "forbidden").unit(Unit::count).doc("Number of turns that these rules forbid on streets open to cars.");
    t.out(&Out::reason, "reason").doc("Rows that have no effect, and why, as sentences; empty where all rows apply.");
  }
};

}  // namespace

}  // namespace bl

BL_TYPIFICATION(turn_rules, TurnRules)
