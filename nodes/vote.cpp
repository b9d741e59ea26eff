// A vote: a question with its options, the ballots that were cast, and their count.
#include <string>
#include <utility>

#include "core/base/unit.h"
#include "core/define/registry.h"
#include "core/define/typification_builder.h"
#include "core/vote/count.h"

namespace bl {

namespace {

struct Vote {
  enum class Shows { at_once, when_closed };
  // A decision stays in force until another one takes its place.
  struct Decided {
    Table shares{{"option", "share"}, {}};
    std::int64_t ballots = 0;
    double turnout = 0;
  };
  struct In {
    std::string question, unit;
    vote::Kind kind = vote::Kind::yes_no;
    Table options{{"id", "label"}, {}};
    std::int64_t points = 10, electorate = 0;
    bool is_whole_ranking = true, is_open = false, is_secret = false;
    double least = 0, most = 100;
    Shows shows = Shows::when_closed;
    Shared<Table> ballots;
    Decided last;
  };
  struct Out {
    Decided decided;
    std::int64_t ballots = 0, unreadable = 0;
    double turnout = 0, mean = 0, median = 0;
    std::string leading;
    bool is_shown = false;
    Table results{{"option", "label", "points", "share"}, {}}, refusals{{"voter", "reason"}, {}};
  };

  static void declare(TypificationBuilder<Vote>& t) {
    t.id("vote").label("Vote");
    t.column(CanvasColumn::second).icon(Icon::balance);
    t.doc(
        "A question to many people, with their ballots and the count. Each voter has one ballot and may change it until the vote "
        "is closed. A link can let the result act on the scene.");
    declare_question(t);
    declare_rules(t);
    declare_count(t);
    declare_decided(t);
  }

  static void declare_question(TypificationBuilder<Vote>& t) {
    t.in(&In::question, "question").doc("The question in the words that people read.");
    t.in(&In::kind, "kind",
         {{vote::Kind::yes_no, "yes_no", "Each voter answers yes or no."},
          {vote::Kind::dots, "dots", "Each voter sets dots on places; each dot names an option, or `plus` or `minus`."},
          {vote::Kind::rank, "rank", "Each voter puts the options in an order, the best first."},
          {vote::Kind::coins, "coins", "Each voter spreads whole coins over the options."},
          {vote::Kind::slider, "slider", "Each voter chooses a number."}})
        .doc("How people answer.");
    t.in(&In::options, "options")
        .column({.id = "id",
                 .is_text = true,
                 .is_required = true,
                 .is_key = true,
                 .default_value = std::string(),
                 .doc = "The name of the option in ballots, such as `park`."})
        .column({.id = "label", .is_text = true, .default_value = std::string(), .doc = "The option in words."})
        .doc("What people choose from. Yes or no and sliders need none; dots without options say `plus` or `minus`.");
    t.in(&In::points, "points")
        .unit(Unit::count)
        .range(1, 1000)
        .soft(1, 20)
        .doc("How many coins or dots each voter has. Nobody has to use all of them.");
    t.in(&In::is_whole_ranking, "is_whole_ranking").doc("On: a ranking has to name all options.");
    t.in(&In::least, "least").unit_from("unit").doc("The smallest number of a slider.");
    t.in(&In::most, "most").unit_from("unit").doc("The largest number of a slider; above the smallest.");
    t.in(&In::unit, "unit").doc("Unit of a slider as a symbol, such as `m`, `m2`, `m3`, `s` or `EUR`; empty for a plain number.");
  }

  static void declare_rules(TypificationBuilder<Vote>& t) {
    t.in(&In::is_open, "is_open").doc("On: ballots are taken. Off: nobody can cast, change or withdraw one.");
    t.in(&In::is_secret, "is_secret").doc("On: nobody is shown who voted how.");
    t.in(&In::shows, "shows",
         {{Shows::at_once, "at_once", "Everybody sees the count while it grows."},
          {Shows::when_closed, "when_closed", "The result is shown once the vote is closed."}})
        .doc("When the result may be shown.");
    t.in(&In::electorate, "electorate")
        .unit(Unit::count)
        .range(0, 1000000000)
        .soft(0, 200)
        .doc("How many people may vote. 0: that is not known, and neither is the turnout.");
    auto ballots = t.in(&In::ballots, "ballots");
    for (ColumnDefinition& column : vote::ballot_columns()) ballots.column(std::move(column));
    ballots.doc("The ballots. People cast them by the command `cast_vote`, which checks them first.");
  }

  static void declare_count(TypificationBuilder<Vote>& t) {
    t.out(&Out::ballots, "ballot_count").traced().shown_first().unit(Unit::count).doc("Number of ballots that are counted.");
    t.out(&Out::turnout, "turnout")
        .shown_first()
        .unit(Unit::ratio)
        .doc("Ballots counted as a share of those who may vote; 0 where their number is not known.");
    t.out(&Out::leading, "leading")
        .shown_first()
        .doc("The option with the most points; empty on a tie, without ballots, and for sliders.");
    t.out(&Out::results, "results")
        .column({.id = "option", .is_text = true, .default_value = std::string(), .doc = "The option; `mean` for a slider."})
        .column({.id = "label", .is_text = true, .default_value = std::string(), .doc = "The option in words."})
        .column({.id = "points",
                 .doc = "Its votes, dots or coins; of rankings of n options n - 1 points for each first place, n - 2 for each "
                        "second, and so on; the mean of a slider."})
        .column({.id = "share",
                 .unit = Unit::ratio,
                 .doc = "Its share of all points; of a slider, where the mean lies from its smallest number (0) to its largest "
                        "(1)."})
        .doc("The count of each option, in the order of the options.");
    t.out(&Out::mean, "mean").unit_from("unit").doc("Mean of the numbers of a slider; 0 without ballots.");
    t.out(&Out::median, "median")
        .unit_from("unit")
        .doc("The number in the middle of those of a slider; between two, their mean. 0 without ballots.");
    t.out(&Out::is_shown, "is_shown").doc("On where the result may be shown now.");
    t.out(&Out::unreadable, "unreadable")
        .unit(Unit::count)
        .doc("Number of ballots that are not counted, because they do not fit the question as it is now.");
    t.out(&Out::refusals, "refusals")
        .column({.id = "voter", .is_text = true, .default_value = std::string(), .doc = "Whose ballot it is."})
        .column({.id = "reason", .is_text = true, .default_value = std::string(), .doc = "Why it is not counted, as a sentence."})
        .doc("The ballots that are not counted.");
  }

  static void declare_decided(TypificationBuilder<Vote>& t) {
    t.memory(&Out::decided, &In::last, &Decided::shares, "decided")
        .column({.id = "option", .is_text = true, .default_value = std::string(), .doc = "The option; `mean` for a slider."})
        .column({.id = "share", .unit = Unit::ratio, .doc = "Its share of all points when the vote was closed last."})
        .doc("The result of the last close. It stays in force while the vote is open again.");
    t.memory(&Out::decided, &In::last, &Decided::ballots, "decided_ballots")
        .unit(Unit::count)
        .doc("Number of ballots that were counted at the last close; 0 before the first one.");
    t.memory(&Out::decided, &In::last, &Decided::turnout, "decided_turnout")
        .unit(Unit::ratio)
        .doc("The turnout at the last close.");
  }

  static Result<Out> evaluate(const In& in, const Tick&) {
    if (const auto unit = stored_unit(in.unit); !unit) return unit.error().within("unit");
    const auto question = vote::question_of({in.kind, {}, in.points, in.is_whole_ranking, in.least, in.most}, in.options);
    if (!question) return question.error();
    const vote::Outcome counted = vote::count(*question, *in.ballots);
    Out out;
    out.ballots = counted.counted;
    if (in.electorate > 0) out.turnout = static_cast<double>(counted.counted) / static_cast<double>(in.electorate);
    for (const vote::Tally& tally : counted.tallies)
      out.results.rows.push_back({tally.option, tally.label, tally.points, tally.share});
    for (const vote::Refusal& refusal : counted.refusals) out.refusals.rows.push_back({refusal.voter, refusal.reason});
    out.unreadable = static_cast<std::int64_t>(counted.refusals.size());
    out.leading = counted.leading;
    out.mean = counted.mean;
    out.median = counted.median;
    out.is_shown = in.shows == Shows::at_once || !in.is_open;
    out.decided = in.last;
    if (in.is_open) return out;
    out.decided = {Table{{"option", "share"}, {}}, out.ballots, out.turnout};
    for (const vote::Tally& tally : counted.tallies) out.decided.shares.rows.push_back({tally.option, tally.share});
    return out;
  }
};

}  // namespace

}  // namespace bl

BL_TYPIFICATION(vote, Vote)
