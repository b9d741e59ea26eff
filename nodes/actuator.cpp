// An actuator: a number that leaves the scene, for a lamp, a screen or a machine.
#include "core/address/live_address.h"
#include "core/base/text.h"
#include "core/base/unit.h"
#include "core/define/registry.h"
#include "core/define/typification_builder.h"

namespace bl {

namespace {

constexpr std::string_view kSlot = "{value}";
constexpr std::size_t kLongestFormat = 1000;

struct Actuator {
  struct In {
    double value = 0;
    std::string unit, address, format = std::string(kSlot);
    int decimals = -1;
    double interval = 1, change = 0;
    bool is_on = true;
  };
  struct Out {
    std::string message;
  };

  static void declare(TypificationBuilder<Actuator>& t) {
    t.id("actuator").label("Actuator");
    t.doc(
        "Sends a number to a device by MQTT or OSC while the scene runs live. The message depends on the scene only; the scene "
        "does not learn whether it arrives.");
    t.in(&In::value, "value")
        .traced()
        .unit_from("unit")
        .combine(CombineRule::blend)
        .keeps_default()
        .doc("The number, set by people or proposed by links. Without a number nothing is sent.");
    t.in(&In::unit, "unit").doc("Unit that the number is sent in, as a symbol such as `m` or `cm`; empty for a plain number.");
    t.in(&In::address, "address")
        .shown_first()
        .reaches_out()
        .doc("The address of the device: `mqtt://host:1883/topic` or `osc://host:9000/path`.");
    t.in(&In::format, "format")
        .doc(
            "The message, with `{value}` in place of the number. By OSC, `{value}` alone is sent as a number, anything else as a "
            "text.");
    t.in(&In::decimals, "decimals").unit(Unit::count).range(-1, 12).doc("Number of decimals; -1 for as many as the number has.");
    t.in(&In::interval, "interval")
        .unit(Unit::second)
        .min(0.02)
        .soft(0.1, 60)
        .doc("Shortest time between two messages. Of the changes in between, only the newest is sent afterwards.");
    t.in(&In::change, "change").unit_from("unit").min(0).doc("Smaller changes are not sent; 0 for every change of the message.");
    t.in(&In::is_on, "is_on").doc("Nothing is sent while this is off.");
    t.out(&Out::message, "message").doc("The message as it is sent.");
  }

  static Result<Out> evaluate(const In& in, const Tick&) {
    if (in.format.size() > kLongestFormat)
      return Error{ErrorCode::out_of_range, "format", "is longer than " + std::to_string(kLongestFormat) + " characters"};
    if (!in.address.empty()) {
      const auto address = address::parse_live_address(in.address);
      if (!address) return address.error().within("address");
      if (address->scheme != address::LiveAddress::Scheme::mqtt && address->scheme != address::LiveAddress::Scheme::osc)
        return Error{ErrorCode::conflict, "address", "messages are sent by `mqtt://` or `osc://` only: write such an address"};
    }
    const std::size_t slot = in.format.find(kSlot);
    if (slot == std::string::npos)
      return Error{ErrorCode::missing, "format", "has no `{value}` in place of the number: put one in"};
    const UnitInfo* unit = find_unit(in.unit);
    const double number = in.value / (unit != nullptr ? unit->scale : 1);
    Out out{in.format};
    const std::string text = in.decimals < 0 ? shortest(number) : fixed(number, in.decimals);
    for (std::size_t at = slot; at != std::string::npos; at = out.message.find(kSlot, at + text.size()))
      out.message.replace(at, kSlot.size(), text);
    return out;
  }
};

}  // namespace

}  // namespace bl

BL_TYPIFICATION(actuator, Actuator)
