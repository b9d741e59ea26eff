// A stakeholder group: people with goals and a budget, how far both are kept, and the role card of whoever speaks for it.
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/base/text.h"
#include "core/define/registry.h"
#include "core/define/typification_builder.h"

namespace bl {

namespace {

struct StakeholderGroup {
  struct In {
    std::string interest;
    Selection goals;
    double budget = 0, spent = 0;
    Table controls{{"node", "port", "label", "minimum", "maximum", "step", "costs_whom"}, {}}, allowed{{"command"}, {}};
    std::vector<std::string> areas;
  };
  struct Goal {
    double score = 0;
    std::string status;
  };
  struct Sets {
    std::vector<Goal> goals;
  };
  struct Out {
    double budget_left = 0, goals_met = 1, mean_score = 1;
    std::int64_t goals = 0;
    bool is_within_budget = true;
  };

  static void declare(TypificationBuilder<StakeholderGroup>& t) {
    t.id("stakeholder_group").label("Stakeholder group");
    t.column(CanvasColumn::second).icon(Icon::balance);
    t.doc(
        "A party in the negotiation: residents, the city, an investor. Its goals are indicators, and links of cost add up what "
        "the "
        "scene spends of its budget.");
    t.in(&In::interest, "interest").doc("What the group wants, in its own words.");
    t.in(&In::goals, "goals").doc("The indicators that are this group's goals.");
    t.in(&In::budget, "budget").unit(Unit::euro).min(0).soft(0, 1e8).doc("What the group can spend.");
    t.in(&In::spent, "spent")
        .unit(Unit::euro)
        .combine(CombineRule::total)
        .doc("What is spent: what people have set, and all that links of cost add to it.");
    declare_role_card(t);
    t.out(&Out::budget_left, "budget_left")
        .traced()
        .shown_first()
        .unit(Unit::euro)
        .doc("Budget minus what is spent; may be negative.");
    t.out(&Out::is_within_budget, "is_within_budget").doc("On where no more is spent than there is.");
    t.out(&Out::goals_met, "goals_met")
        .shown_first()
        .unit(Unit::ratio)
        .doc("The share of its goals that are met; 1 without goals. A goal that cannot be read is not met.");
    t.out(&Out::mean_score, "mean_score").unit(Unit::ratio).doc("The mean score of its goals; 1 without goals.");
    t.out(&Out::goals, "goal_count").unit(Unit::count).doc("Number of goals.");
    t.set("goals", &Sets::goals).reads(&Goal::score, "indicator.score", Unit::ratio).reads(&Goal::status, "indicator.status");
  }

  static void declare_role_card(TypificationBuilder<StakeholderGroup>& t) {
    t.in(&In::controls, "controls")
        .column({.id = "node",
                 .is_text = true,
                 .is_required = true,
                 .names = NameOf::node,
                 .default_value = std::string(),
                 .doc = "Id of the node that is controlled, or of a link."})
        .column({.id = "port",
                 .is_text = true,
                 .is_required = true,
                 .names = NameOf::port,
                 .default_value = std::string(),
                 .doc = "The port that is controlled, written `typification.port`; of a link `strength` or a parameter."})
        .column({.id = "label", .is_text = true, .default_value = std::string(), .doc = "What it is called on the card."})
        .column({.id = "minimum", .doc = "The smallest number that may be set, in the unit of the port."})
        .column({.id = "maximum", .is_required = true, .doc = "The largest number that may be set; above the smallest."})
        .column({.id = "step", .minimum = 0, .doc = "Step, counted from the smallest number; 0 for none."})
        .column({.id = "costs_whom",
                 .is_text = true,
                 .default_value = std::string(),
                 .doc = "Who pays or loses when this number grows, in words."})
        .doc("The role card: the numbers that whoever speaks for the group may set, and how far.");
    t.in(&In::allowed, "allowed")
        .column({.id = "command",
                 .is_text = true,
                 .is_required = true,
                 .is_key = true,
                 .names = NameOf::command,
                 .default_value = std::string(),
                 .doc = "Id of a command, such as `add_node`."})
        .doc("The role card: what else whoever speaks for the group may do.");
    t.in(&In::areas, "areas").doc("The role card: the areas in which this holds, each the tag of its nodes.");
  }

  static Result<void> check_card(const Table& controls) {
    std::set<std::pair<std::string, std::string>> seen;
    for (std::size_t row = 0; row < controls.rows.size(); ++row) {
      const std::string place = "controls/" + std::to_string(row) + "/";
      const double minimum = controls.number(row, "minimum"), maximum = controls.number(row, "maximum"),
                   step = controls.number(row, "step");
      if (!(minimum < maximum))
        return Error{ErrorCode::out_of_range, place + "maximum",
                     "the maximum (" + shortest(maximum) + ") has to lie above the minimum (" + shortest(minimum) + ")"};
      if (step > maximum - minimum)
        return Error{ErrorCode::out_of_range, place + "step",
                     "the step (" + shortest(step) + ") is larger than the range (" + shortest(maximum - minimum) +
                         "): make it smaller, or 0 for none"};
      if (!seen.emplace(controls.text(row, "node"), controls.text(row, "port")).second)
        return Error{ErrorCode::duplicate, place + "port",
                     "this port of `" + controls.text(row, "node") + "` stands in an earlier row too: keep one of them"};
    }
    return {};
  }

  static Result<Out> evaluate(const In& in, const Sets& sets, const Tick&) {
    if (auto card = check_card(in.controls); !card) return card.error();
    Out out;
    out.budget_left = in.budget - in.spent;
    out.is_within_budget = out.budget_left >= 0;
    out.goals = static_cast<std::int64_t>(sets.goals.size());
    if (sets.goals.empty()) return out;
    double met = 0, sum = 0;
    for (const Goal& goal : sets.goals) {
      met += goal.status == "met" ? 1 : 0;
      sum += goal.score;
    }
    out.goals_met = met / static_cast<double>(sets.goals.size());
    out.mean_score = sum / static_cast<double>(sets.goals.size());
    return out;
  }
};

}  // namespace

}  // namespace bl

BL_TYPIFICATION(stakeholder_group, StakeholderGroup)
