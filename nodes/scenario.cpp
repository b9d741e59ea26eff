// A scenario: a state of the scene that people have kept, with its key figures; no tick acts on it.
#include <set>
#include <string>

#include "core/base/unit.h"
#include "core/define/registry.h"
#include "core/define/typification_builder.h"

namespace bl {

namespace {

struct Scenario {
  struct In {
    std::string note, author, snapshot;
    Table figures{{"figure", "unit", "value"}, {}};
  };
  struct Out {
    std::int64_t figures = 0;
  };

  static void declare(TypificationBuilder<Scenario>& t) {
    t.id("scenario").label("Scenario");
    t.column(CanvasColumn::second).icon(Icon::file);
    t.doc(
        "A state of the scene that people have kept to compare it with others. Its name is that of the node. No link reads it, "
        "and "
        "nothing follows from it.");
    t.in(&In::note, "note").doc("What is special about this state, in the words of whoever kept it.");
    t.in(&In::author, "author").doc("Who kept it, as a pseudonym or a role.");
    t.in(&In::snapshot, "snapshot")
        .doc("Where the state is kept: the name of a file beside the scene, or of a snapshot of the room.");
    t.in(&In::figures, "figures")
        .column({.id = "figure",
                 .is_text = true,
                 .is_required = true,
                 .is_key = true,
                 .default_value = std::string(),
                 .doc = "What was measured, such as `floor area`."})
        .column({.id = "unit",
                 .is_text = true,
                 .default_value = std::string(),
                 .doc = "Its unit as a symbol, such as `m2` or `EUR`; empty for a plain number."})
        .column({.id = "value", .doc = "What it was in that state."})
        .doc("Key figures of the state as it was kept. They stay as they are while the scene goes on.");
    t.out(&Out::figures, "figure_count").shown_first().unit(Unit::count).doc("Number of key figures.");
  }

  static Result<Out> evaluate(const In& in, const Tick&) {
    std::set<std::string> seen;
    for (std::size_t row = 0; row < in.figures.rows.size(); ++row) {
      const std::string place = "figures/" + std::to_string(row) + "/", &figure = in.figures.text(row, "figure");
      if (figure.empty()) return Error{ErrorCode::missing, place + "figure", "the figure has no name: say what was measured"};
      if (!seen.insert(figure).second)
        return Error{ErrorCode::duplicate, place + "figure",
                     "the figure `" + figure + "` stands in an earlier row too: name one of them otherwise"};
      if (const auto unit = stored_unit(in.figures.text(row, "unit")); !unit) return unit.error().within(place + "unit");
    }
    return Out{static_cast<std::int64_t>(in.figures.rows.size())};
  }
};

}  // namespace

}  // namespace bl

BL_TYPIFICATION(scenario, Scenario)
