// A user: a person in the scene under a pseudonym, with a role, a weight and choices of their own.
#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "core/base/text.h"
#include "core/base/unit.h"
#include "core/define/registry.h"
#include "core/define/typification_builder.h"

namespace bl {

namespace {

struct User {
  enum class Role { facilitator, designer, stakeholder, participant, viewer, recorder };
  struct In {
    std::int64_t seat = 0;
    std::string pseudonym, colour = "#4477aa";
    Role role = Role::participant;
    double weight = 1;
    bool is_present = true;
    Table choices{{"id", "label", "unit", "value", "minimum", "maximum", "step"}, {}};
  };
  struct Out {
    std::int64_t choices = 0;
    Table values{{"id", "unit", "value"}, {}};
  };

  static void declare(TypificationBuilder<User>& t) {
    t.id("user").label("User");
    t.column(CanvasColumn::first).icon(Icon::plus);
    t.doc(
        "A person in the negotiation, under a pseudonym. Their choices are numbers that links carry to other nodes. A scene "
        "holds no "
        "names, addresses or devices of people.");
    t.in(&In::seat, "seat").unit(Unit::count).range(0, 1000000).soft(0, 200).doc("The number of the seat in the room; 0: none.");
    t.in(&In::pseudonym, "pseudonym").doc("What others call this person in the session, such as `Heron`.");
    t.in(&In::role, "role",
         {{Role::facilitator, "facilitator", "Leads the session."},
          {Role::designer, "designer", "Draws in an area of their own."},
          {Role::stakeholder, "stakeholder", "Speaks for a group and holds its role card."},
          {Role::participant, "participant", "Takes part with a few choices of their own."},
          {Role::viewer, "viewer", "Looks on."},
          {Role::recorder, "recorder", "Keeps the minutes."}})
        .doc("What the person does in the session; links ask for it as a right.");
    t.in(&In::colour, "colour").doc("The colour of this person in views, written `#rrggbb`.");
    t.in(&In::weight, "weight")
        .unit(Unit::ratio)
        .range(0, 1000)
        .soft(0, 3)
        .doc("How much the choices of this person count beside those of others. 0: not at all.");
    t.in(&In::is_present, "is_present").doc("On while the person is there.");
    declare_choices(t);
  }

  static void declare_choices(TypificationBuilder<User>& t) {
    t.in(&In::choices, "choices")
        .column({.id = "id",
                 .is_text = true,
                 .is_required = true,
                 .is_key = true,
                 .default_value = std::string(),
                 .doc = "The name by which links find the choice, such as `height`."})
        .column({.id = "label", .is_text = true, .default_value = std::string(), .doc = "The choice in words."})
        .column({.id = "unit",
                 .is_text = true,
                 .default_value = std::string(),
                 .doc = "Unit as a symbol, such as `m`, `m3` or `EUR`; empty for a plain number."})
        .column({.id = "value", .doc = "The number that the person has chosen."})
        .column({.id = "minimum", .doc = "The smallest number that counts."})
        .column({.id = "maximum", .default_value = 100.0, .doc = "The largest number that counts; above the smallest."})
        .column({.id = "step",
                 .minimum = 0,
                 .doc = "Step of the slider, counted from the smallest number; 0 for a slider without steps."})
        .doc("The numbers that this person may choose.");
    t.out(&Out::choices, "choice_count").shown_first().unit(Unit::count).doc("Number of choices.");
    t.out(&Out::values, "values")
        .column({.id = "id", .is_text = true, .default_value = std::string(), .doc = "The name of the choice."})
        .column({.id = "unit", .is_text = true, .default_value = std::string(), .doc = "Its unit."})
        .column({.id = "value", .doc = "The number inside its range, rounded to the nearest step."})
        .doc("The choices as links read them.");
  }

  static Result<Out> evaluate(const In& in, const Tick&) {
    if (!is_colour(in.colour))
      return Error{ErrorCode::wrong_kind, "colour", "`" + in.colour + "` is no colour: write it as `#rrggbb`, such as `#4477aa`"};
    Out out;
    std::set<std::string> seen;
    for (std::size_t row = 0; row < in.choices.rows.size(); ++row) {
      const std::string place = "choices/" + std::to_string(row) + "/";
      std::string column;
      if (const std::string fault = fault_of(in.choices, row, column); !fault.empty())
        return Error{ErrorCode::out_of_range, place + column, fault};
      const std::string& id = in.choices.text(row, "id");
      if (!seen.insert(id).second)
        return Error{ErrorCode::duplicate, place + "id",
                     "the choice `" + id + "` stands in an earlier row too: name one otherwise"};
      const std::string& unit = in.choices.text(row, "unit");
      if (const auto known = stored_unit(unit); !known) return known.error().within(place + "unit");
      out.values.rows.push_back({id, unit, chosen(in.choices, row)});
    }
    out.choices = static_cast<std::int64_t>(in.choices.rows.size());
    return out;
  }

 private:
  static bool is_colour(const std::string& text) {
    const auto is_digit = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F'); };
    return text.size() == 7 && text[0] == '#' && std::all_of(text.begin() + 1, text.end(), is_digit);
  }

  // An empty sentence where the row is sound; otherwise `column` is where the fault stands.
  static std::string fault_of(const Table& choices, std::size_t row, std::string& column) {
    const double minimum = choices.number(row, "minimum"), maximum = choices.number(row, "maximum");
    column = "id";
    if (choices.text(row, "id").empty()) return "the choice has no name: name it, so that links find it";
    column = "maximum";
    if (!(minimum < maximum))
      return "the maximum (" + shortest(maximum) + ") has to lie above the minimum (" + shortest(minimum) + ")";
    column = "step";
    const double step = choices.number(row, "step");
    if (step > maximum - minimum)
      return "the step (" + shortest(step) + ") is larger than the range (" + shortest(maximum - minimum) +
             "): make it smaller, or 0 for none";
    return {};
  }

  static double chosen(const Table& choices, std::size_t row) {
    const double minimum = choices.number(row, "minimum"), maximum = choices.number(row, "maximum"),
                 step = choices.number(row, "step"), value = std::clamp(choices.number(row, "value"), minimum, maximum);
    if (!(step > 0)) return value;
    // The last step may lie below the maximum; the margin keeps a range that is a whole number of steps up to rounding.
    const double last = std::floor((maximum - minimum) / step * (1 + 1e-12));
    return std::min(minimum + std::min(std::floor((value - minimum) / step + 0.5), last) * step, maximum);
  }
};

}  // namespace

}  // namespace bl

BL_TYPIFICATION(user, User)
