// Lets volumes trade: those that need more volume get some of the others', and pay for it.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/define/link_builder.h"
#include "core/define/link_remark.h"
#include "core/define/registry.h"

namespace bl {

namespace {

// Volumes [m³] and money [€] move in whole multiples of this. Sums of such multiples have no rounding below 2^43, so that what
// one gives is to the last bit what the other gets. Less than this is not traded, so that a trade comes to its end.
constexpr double kGrain = 1.0 / 1024;
// Of the difference between two needs, shared among all partners: so nobody swings, and nobody sells more than there is.
constexpr double kShareOfGap = 0.25, kShareOfRight = 0.5;

struct Trade {
  struct In {
    double rate = 100, price = 400;
  };
  // The ends are whole: of several pairs that speak one by one, a link takes a mean, and a mean keeps no sum.
  struct Side {
    All<std::string> ids;
    All<double> demands, allotments, boughts;
    All<bool> bought_locked, paid_locked;
  };
  struct Ends {
    All<std::string> from_ids, to_ids;
    All<double> from_demands, from_allotments, from_boughts, to_demands, to_allotments, to_boughts;
    All<bool> from_bought_locked, from_paid_locked, to_bought_locked, to_paid_locked;
  };
  struct Out {
    All<std::optional<double>> from_bought, from_paid, from_limits, to_bought, to_paid, to_limits;
  };

  static void declare(LinkBuilder<Trade>& l) {
    l.family(LinkFamily::numbers);
    l.id("trade").label("Trade").doc(
        "Lets volumes trade. The need of a volume is its demand less what its account allows. In each tick, of two volumes the "
        "one "
        "with the smaller need sells volume to the other, until both need the same. Each volume is limited to what its account "
        "allows, and the accounts keep what was bought and paid.");
    l.param(&In::rate, "rate")
        .unit(Unit::cubic_metre)
        .range(0, 1e6)
        .soft(1, 1000)
        .doc("The most that one volume sells to another in one tick.");
    l.param(&In::price, "price").range(0, 1e6).soft(0, 2000).doc("Price of one cubic metre in euros.");
    declare_end(l, End::from);
    declare_end(l, End::to);
  }

  static void declare_end(LinkBuilder<Trade>& l, End end) {
    const bool is_from = end == End::from;
    l.reads(is_from ? &Ends::from_ids : &Ends::to_ids, end, "node.id");
    l.reads(is_from ? &Ends::from_demands : &Ends::to_demands, end, "smart_volume.demand", Unit::cubic_metre);
    l.reads(is_from ? &Ends::from_allotments : &Ends::to_allotments, end, "volume_account.allotment", Unit::cubic_metre);
    l.reads(is_from ? &Ends::from_boughts : &Ends::to_boughts, end, "volume_account.bought", Unit::cubic_metre);
    l.reads_lock(is_from ? &Ends::from_bought_locked : &Ends::to_bought_locked, end, "volume_account.bought");
    l.reads_lock(is_from ? &Ends::from_paid_locked : &Ends::to_paid_locked, end, "volume_account.paid");
    l.proposes(is_from ? &Out::from_bought : &Out::to_bought, end, "volume_account.bought", Unit::cubic_metre);
    l.proposes(is_from ? &Out::from_paid : &Out::to_paid, end, "volume_account.paid", Unit::euro);
    l.proposes(is_from ? &Out::from_limits : &Out::to_limits, end, "smart_volume.demand_limit", Unit::cubic_metre);
  }

  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick& tick) {
    Market market;
    market.enter(End::from, {ends.from_ids, ends.from_demands, ends.from_allotments, ends.from_boughts, ends.from_bought_locked,
                             ends.from_paid_locked});
    market.enter(End::to,
                 {ends.to_ids, ends.to_demands, ends.to_allotments, ends.to_boughts, ends.to_bought_locked, ends.to_paid_locked});
    for (const Party& party : market.parties)
      if (!std::isfinite(party.right) || !std::isfinite(party.demand))
        return Error{ErrorCode::not_finite, "", "an account holds more than a number can say: set its `bought` to 0"};
    for (const std::size_t a : market.places[0])
      for (const std::size_t b : market.places[1])
        if (a != b && !market.comes_again(a, b)) market.deal(in, a, b);
    for (const Party& party : market.parties)
      if (party.is_held_up)
        remark(tick, LinkRemark::short_of,
               {ErrorCode::conflict, "", "the account of `" + party.id + "` is locked, so that it does not trade: unlock it"});
    Out out;
    market.tell(End::from, out.from_bought, out.from_paid, out.from_limits);
    market.tell(End::to, out.to_bought, out.to_paid, out.to_limits);
    return out;
  }

 private:
  struct Party {
    std::string id;
    double demand = 0, right = 0;
    bool is_locked = false, is_held_up = false, is_told = false;
    bool is_at[2] = {false, false};  // by end
    double bought = 0, paid = 0;     // in this tick
  };

  struct Market {
    std::vector<Party> parties;
    std::vector<std::size_t> places[2];  // of the nodes of each end among the parties
    std::map<std::string, std::size_t> known;

    void enter(End end, const Side& side) {
      const auto e = static_cast<std::size_t>(end);
      for (std::size_t i = 0; i < side.ids.values.size(); ++i) {
        const std::string& id = side.ids.values[i];
        const auto [place, is_new] = known.emplace(id, parties.size());
        if (is_new)
          parties.push_back({.id = id,
                             .demand = side.demands.values[i],
                             .right = side.allotments.values[i] + side.boughts.values[i],
                             .is_locked = side.bought_locked.values[i] || side.paid_locked.values[i]});
        parties[place->second].is_at[e] = true;
        places[e].push_back(place->second);
      }
    }

    // Both are at both ends, and the other order of the two counts.
    bool comes_again(std::size_t a, std::size_t b) const { return a > b && parties[b].is_at[0] && parties[a].is_at[1]; }

    void deal(const In& in, std::size_t a, std::size_t b) {
      const bool is_b_needier = parties[b].demand - parties[b].right > parties[a].demand - parties[a].right;
      Party &seller = parties[is_b_needier ? a : b], &buyer = parties[is_b_needier ? b : a];
      const double gap = (buyer.demand - buyer.right) - (seller.demand - seller.right);
      const double partners = static_cast<double>(std::max(places[0].size(), places[1].size()));
      const double sold =
          whole(std::min({in.rate, kShareOfGap * gap / partners, kShareOfRight * std::max(seller.right, 0.0) / partners}));
      if (!(sold > 0)) return;
      if (seller.is_locked || buyer.is_locked) {
        (seller.is_locked ? seller : buyer).is_held_up = true;
        return;
      }
      const double paid = whole(in.price * sold);
      seller.bought -= sold;
      buyer.bought += sold;
      seller.paid -= paid;
      buyer.paid += paid;
    }

    // Each party is told once, also where it is at both ends.
    void tell(End end, All<std::optional<double>>& bought, All<std::optional<double>>& paid, All<std::optional<double>>& limits) {
      for (const std::size_t place : places[static_cast<std::size_t>(end)]) {
        Party& party = parties[place];
        const bool is_told = std::exchange(party.is_told, true);
        bought.values.push_back(is_told ? std::nullopt : std::optional(party.bought));
        paid.values.push_back(is_told ? std::nullopt : std::optional(party.paid));
        limits.values.push_back(is_told ? std::nullopt : std::optional(std::max(party.right, 0.0)));
      }
    }
  };

  static double whole(double amount) { return std::floor(amount / kGrain) * kGrain; }
};

}  // namespace

}  // namespace bl

BL_LINK(trade, Trade)
