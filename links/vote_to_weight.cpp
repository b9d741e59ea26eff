// Lets the result of a vote set a number: a demand, a price, or any other that links may change.
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "core/base/text.h"
#include "core/define/link_builder.h"
#include "core/define/link_remark.h"
#include "core/define/registry.h"

namespace bl {

namespace {

struct VoteToWeight {
  enum class When { closed, shown };
  struct In {
    PortChoice target{"smart_volume.demand"};
    Table mapping{{"option", "least", "most"}, {{std::string("yes"), 0.0, 1000.0}}};
    double minimum_turnout = 0;
    When when = When::closed;
  };
  struct Ends {
    std::string vote;
    Table results, decided;
    std::int64_t ballots = 0, decided_ballots = 0, electorate = 0;
    double turnout = 0, decided_turnout = 0;
    bool is_open = false, is_shown = false;
  };
  struct Out {
    std::optional<double> value;
  };

  static void declare(LinkBuilder<VoteToWeight>& l) {
    l.family(LinkFamily::numbers);
    l.id("vote_to_weight").label("Vote to number");
    l.doc(
        "Lets the result of a vote act on the scene. The share of an option becomes a number between two others, and the numbers "
        "of all rows are added. The link proposes nothing before the result counts, and says why; the target is then what people "
        "have set. While a vote is open again, the result of its last close stays in force.");
    l.param(&In::target, "target").doc("The port that the number is proposed to, written `typification.port`.");
    l.param(&In::mapping, "mapping")
        .column({.id = "option",
                 .is_text = true,
                 .is_required = true,
                 .default_value = std::string(),
                 .doc = "The option of the vote; `mean` for a slider."})
        .column({.id = "least",
                 .doc = "The number at share 0, in the unit of the target; of a slider, where the mean is its smallest number."})
        .column({.id = "most",
                 .is_required = true,
                 .doc = "The number at share 1, in the unit of the target; of a slider, where the mean is its largest number."})
        .doc("What the shares of options are worth. Options without a row add nothing.");
    l.param(&In::minimum_turnout, "minimum_turnout")
        .unit(Unit::ratio)
        .range(0, 1)
        .doc("The link acts only from this turnout on. Above 0 the vote has to know how many may vote.");
    l.param(&In::when, "when",
            {{When::closed, "closed", "The link acts once the vote has been closed."},
             {When::shown, "shown", "The link acts as soon as the result may be shown, also while people vote."}})
        .doc("When the result counts.");
    l.reads(&Ends::vote, End::from, "node.id");
    l.reads(&Ends::results, End::from, "vote.results");
    l.reads(&Ends::decided, End::from, "vote.decided");
    l.reads(&Ends::decided_ballots, End::from, "vote.decided_ballots", Unit::count);
    l.reads(&Ends::decided_turnout, End::from, "vote.decided_turnout", Unit::ratio);
    l.reads(&Ends::ballots, End::from, "vote.ballot_count", Unit::count);
    l.reads(&Ends::turnout, End::from, "vote.turnout", Unit::ratio);
    l.reads(&Ends::electorate, End::from, "vote.electorate", Unit::count);
    l.reads(&Ends::is_open, End::from, "vote.is_open");
    l.reads(&Ends::is_shown, End::from, "vote.is_shown");
    l.proposes_chosen(&Out::value, End::to, "target");
  }

  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick& tick) {
    if (in.mapping.rows.empty())
      return Error{ErrorCode::missing, "mapping", "no option is worth anything: add a row for at least one"};
    if (auto unknown = unknown_option(in.mapping, ends.results, ends.vote)) return *unknown;  // before the session, not in it
    if (const auto waits = why_it_waits(in, ends)) {
      remark(tick, LinkRemark::short_of, *waits);
      return Out{};
    }
    const Table& counted = in.when == When::closed ? ends.decided : ends.results;
    double value = 0;
    for (std::size_t row = 0; row < in.mapping.rows.size(); ++row) {
      const std::string& option = in.mapping.text(row, "option");
      const std::size_t result = counted.row_of("option", option);
      if (result == counted.rows.size()) return no_option(row, option, counted, ends.vote);
      const double share = counted.number(result, "share");
      value += in.mapping.number(row, "least") * (1 - share) + in.mapping.number(row, "most") * share;
    }
    if (!std::isfinite(value))
      return Error{ErrorCode::not_finite, "mapping", "the number is too large: make the numbers of the rows smaller"};
    return Out{value};
  }

 private:
  static std::optional<Error> why_it_waits(const In& in, const Ends& ends) {
    const std::string vote = "the vote `" + ends.vote + "` ";
    const auto waits = [&](const char* place, const std::string& why) {
      return Error{ErrorCode::infeasible, place, vote + why + ", so that it does not act yet"};
    };
    const bool is_of_close = in.when == When::closed;
    const std::int64_t ballots = is_of_close ? ends.decided_ballots : ends.ballots;
    const double turnout = is_of_close ? ends.decided_turnout : ends.turnout;
    if (is_of_close && ends.is_open && ballots == 0) return waits("when", "is still open");
    if (!is_of_close && !ends.is_shown) return waits("when", "does not show its result before it is closed");
    if (ballots == 0) return waits("from", "has no ballot");
    if (!(in.minimum_turnout > 0)) return std::nullopt;
    if (ends.electorate == 0)
      return waits("minimum_turnout", "does not know how many may vote: set its `electorate`, or ask for no turnout");
    if (turnout >= in.minimum_turnout) return std::nullopt;
    return waits("minimum_turnout",
                 "has a turnout of " + rough(100 * turnout) + " % and needs " + rough(100 * in.minimum_turnout) + " %");
  }

  static Error no_option(std::size_t row, const std::string& option, const Table& counted, const std::string& vote) {
    return Error{ErrorCode::not_found, "mapping/" + std::to_string(row) + "/option",
                 "the vote `" + vote + "` has no option `" + option + "`" + did_you_mean(option, options_of(counted))};
  }

  static std::optional<Error> unknown_option(const Table& mapping, const Table& results, const std::string& vote) {
    if (results.rows.empty()) return std::nullopt;  // the vote has not been evaluated yet
    for (std::size_t row = 0; row < mapping.rows.size(); ++row)
      if (const std::string& option = mapping.text(row, "option"); results.row_of("option", option) == results.rows.size())
        return no_option(row, option, results, vote);
    return std::nullopt;
  }

  static std::vector<std::string> options_of(const Table& counted) {
    std::vector<std::string> options;
    for (std::size_t row = 0; row < counted.rows.size(); ++row) options.push_back(counted.text(row, "option"));
    return options;
  }
};

}  // namespace

}  // namespace bl

BL_LINK(vote_to_weight, VoteToWeight)
