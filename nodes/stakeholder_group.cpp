// A stakeholder group: people with goals and a budget, and how far both are kept.
#include <string>
#include <vector>

#include "core/define/registry.h"
#include "core/define/typification_builder.h"

namespace bl {

namespace {

struct StakeholderGroup {
  struct In {
    std::string interest;
    Selection goals;
    double budget = 0, spent = 0;
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

  static Result<Out> evaluate(const In& in, const Sets& sets, const Tick&) {
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
