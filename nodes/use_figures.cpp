// The role of a volume for which its use has figures: trips, parking places, people, cost and value.
#include "core/define/registry.h"
#include "core/define/typification_builder.h"

namespace bl {

namespace {

struct UseFigures {
  struct In {};
  struct Out {
    std::string use, message = "no node of its use looks at it";
    double trips = 0, parking = 0, people = 0, cost = 0, value = 0, car_share = 0, out_share = 0, least_sun = 0, most_noise = 0;
  };

  static void declare(TypificationBuilder<UseFigures>& t) {
    t.id("use_figures").label("Figures of the use");
    t.doc("What the floor area of a SmartVolume brings and needs, by the rates of its use. The node of that use writes it.");
    t.out(&Out::use, "use").doc("The use whose rates these are; empty where no node of the scene is the use of the volume.");
    t.out(&Out::people, "people").shown_first().unit(Unit::count).doc("People who live or work in the volume.");
    t.out(&Out::parking, "parking").shown_first().unit(Unit::count).doc("Parking places that it needs.");
    t.out(&Out::trips, "trips").shown_first().unit(Unit::count).doc("Trips per day, both ways together.");
    t.out(&Out::car_share, "car_share").unit(Unit::ratio).soft(0, 1).doc("Share of the trips that are made by car.");
    t.out(&Out::out_share, "out_share").unit(Unit::ratio).soft(0, 1).doc("Share of the trips in the hour studied that leave.");
    t.out(&Out::cost, "cost").unit(Unit::euro).doc("Cost of building the volume.");
    t.out(&Out::value, "value").unit(Unit::euro).doc("What the volume is worth when it is built.");
    t.out(&Out::least_sun, "least_sun").unit(Unit::second).doc("Time of sun a day that the use needs.");
    t.out(&Out::most_noise, "most_noise").doc("Loudest noise outside by day that suits the use [dB(A)].");
    t.out(&Out::message, "message").doc("Why there are no figures, as a sentence; empty where there are.");
  }
};

}  // namespace

}  // namespace bl

BL_TYPIFICATION(use_figures, UseFigures)
