// A sensor that follows people in a hall: each of them is a node of its own while they are there.
#include <algorithm>

#include "core/address/live_address.h"
#include "core/define/registry.h"
#include "core/define/typification_builder.h"

namespace bl {

namespace {

struct PeopleSensor {
  struct In {
    std::string address;
    double tick_length = 0.5, height = 1;
    std::string use = "person";
    double demand = 10;
    std::int64_t most = 50, present = 0;
    std::string connection;
  };
  struct Out {
    double share = 0;
    std::string message;
  };

  static void declare(TypificationBuilder<PeopleSensor>& t) {
    t.id("people_sensor").label("People sensor");
    t.doc(
        "Follows people in a hall. Whoever comes in gets a node with the roles `smart_volume` and the tag `person`; it moves "
        "with "
        "them, and goes when they go. Its id is that of the sensor, `#`, and the name that the table has for the person. The "
        "sensor says all of that by commands of the log, so that a replay gives the same result without it.");
    t.in(&In::address, "address")
        .shown_first()
        .reaches_out()
        .doc(
            "A recorded table: `replay:walk.csv#person`. Its columns are the one that is named, which holds names of letters and "
            "digits, a time in seconds, and the place `x` and `y` in metres. A row without a place says that the person has "
            "gone.");
    t.in(&In::tick_length, "tick_length")
        .unit(Unit::second)
        .min(0.001)
        .soft(0.05, 10)
        .doc("Duration of one tick, by which rows come to ticks.");
    t.in(&In::height, "height").unit(Unit::metre).soft(0, 10).doc("Height at which the nodes of people stand.");
    t.in(&In::use, "use").doc("The use of the volume that a person claims.");
    t.in(&In::demand, "demand").unit(Unit::cubic_metre).min(0).soft(0, 200).doc("The volume that each person claims.");
    t.in(&In::most, "most").range(0, 1000).doc("As many people have a node at most; of more, those who came first.");
    t.in(&In::present, "present").min(0).doc("How many people have a node now; the sensor sets it.");
    t.in(&In::connection, "connection").doc("What is wrong with the table; empty where no fault is known.");
    t.out(&Out::share, "share").unit(Unit::ratio).doc("How many people have a node, as a share of those who can have one.");
    t.out(&Out::message, "message").doc("What is wrong with the address or the table; empty where nothing is.");
  }

  static Result<Out> evaluate(const In& in, const Tick&) {
    Out out;
    if (in.most > 0) out.share = std::min(1.0, static_cast<double>(in.present) / static_cast<double>(in.most));
    out.message = in.connection;
    if (in.address.empty()) return out;
    const auto address = address::parse_live_address(in.address);
    if (!address) out.message = "the address cannot be used: " + address.error().message;
    else if (address->scheme != address::LiveAddress::Scheme::replay)
      out.message = "people are followed by recorded tables only: write `replay:walk.csv#person`";
    return out;
  }
};

}  // namespace

}  // namespace bl

BL_TYPIFICATION(people_sensor, PeopleSensor)
