// Carries a choice of people to a number of other nodes: the mean of what they chose, by their weights.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/text.h"
#include "core/define/link_builder.h"
#include "core/define/link_remark.h"
#include "core/define/registry.h"

namespace bl {

namespace {

struct UserToNode {
  struct In {
    std::string choice;
    PortChoice target{"smart_volume.demand"};
    std::vector<std::string> roles{"facilitator", "designer", "stakeholder", "participant"};
    bool only_present = true;
  };
  struct Ends {
    All<std::string> ids, roles;
    All<double> weights;
    All<bool> present;
    All<Table> values;
  };
  struct Out {
    std::optional<double> value;
  };

  static void declare(LinkBuilder<UserToNode>& l) {
    l.family(LinkFamily::numbers);
    l.id("user_to_node").label("User to node");
    l.doc(
        "Proposes what people have chosen to a number of other nodes. Several people are one voice: the mean of their choices, "
        "in "
        "which each counts by their weight.");
    l.param(&In::choice, "choice").doc("The id of the choice, as it stands in the users' tables.");
    l.param(&In::target, "target")
        .doc("The port that the number is proposed to, written `typification.port`. The choice is in its unit.");
    l.param(&In::roles, "roles").doc("The roles that have the right to this; the choices of others are not looked at.");
    l.param(&In::only_present, "only_present").doc("On: only people who are present count.");
    l.reads(&Ends::ids, End::from, "node.id");
    l.reads(&Ends::roles, End::from, "user.role");
    l.reads(&Ends::weights, End::from, "user.weight", Unit::ratio);
    l.reads(&Ends::present, End::from, "user.is_present");
    l.reads(&Ends::values, End::from, "user.values");
    l.proposes_chosen(&Out::value, End::to, "target");
  }

  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick& tick) {
    if (in.choice.empty())
      return Error{ErrorCode::missing, "choice", "no choice is named: write the id of one, such as `height`"};
    if (auto known = check_roles(in); !known) return known.error();
    double sum = 0, weights = 0;
    std::string without;
    std::optional<std::string> unit;
    for (std::size_t user = 0; user < ends.ids.values.size(); ++user) {
      if (!may(in, ends, user)) continue;
      const Table& values = ends.values.values[user];
      const std::size_t row = values.row_of("id", in.choice);
      if (row == values.rows.size()) {
        without += (without.empty() ? "`" : ", `") + ends.ids.values[user] + "`";
        continue;
      }
      if (!unit) unit = values.text(row, "unit");
      if (*unit != values.text(row, "unit"))
        return Error{ErrorCode::wrong_unit, "choice",
                     "the users have chosen in different units (`" + *unit + "` and `" + values.text(row, "unit") +
                         "`): give the choice one unit"};
      sum += ends.weights.values[user] * values.number(row, "value");
      weights += ends.weights.values[user];
    }
    if (!without.empty())
      remark(tick, LinkRemark::short_of, {ErrorCode::missing, "choice", "there is no choice `" + in.choice + "` at " + without});
    else if (!(weights > 0))
      remark(tick, LinkRemark::short_of, {ErrorCode::infeasible, "from", "nobody with the right to it has a say now"});
    if (!(weights > 0)) return Out{};
    if (!std::isfinite(sum / weights))
      return Error{ErrorCode::not_finite, "choice", "the chosen numbers are too large: choose smaller ones"};
    return Out{sum / weights};
  }

 private:
  static constexpr std::array<std::string_view, 6> kRoles = {"facilitator", "designer", "stakeholder",
                                                             "participant", "viewer",   "recorder"};

  static bool may(const In& in, const Ends& ends, std::size_t user) {
    if (in.only_present && !ends.present.values[user]) return false;
    return std::find(in.roles.begin(), in.roles.end(), ends.roles.values[user]) != in.roles.end();
  }

  static Result<void> check_roles(const In& in) {
    const std::vector<std::string> known(kRoles.begin(), kRoles.end());
    for (std::size_t i = 0; i < in.roles.size(); ++i)
      if (std::find(known.begin(), known.end(), in.roles[i]) == known.end())
        return Error{ErrorCode::not_found, "roles/" + std::to_string(i),
                     "there is no role `" + in.roles[i] + "`" + did_you_mean(in.roles[i], known)};
    return {};
  }
};

}  // namespace

}  // namespace bl

BL_LINK(user_to_node, UserToNode)
