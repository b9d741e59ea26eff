// Divides the floor areas of a programme among volumes as demands.
#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/text.h"
#include "core/define/link_builder.h"
#include "core/define/link_remark.h"
#include "core/define/registry.h"
#include "core/demand/brief_sums.h"

namespace bl {

namespace {

struct Demand {
  struct In {
    std::string use;
    bool every_row = true;
  };
  struct Ends {
    Shared<Table> rows;
    std::vector<std::string> open_uses;
    All<std::string> ids, uses;
  };
  struct Out {
    All<std::optional<double>> demand, demand_min, demand_limit, by_floor_area, storey_height;
  };

  static void declare(LinkBuilder<Demand>& l) {
    l.family(LinkFamily::brief);
    l.id("demand").label("Demand").doc(
        "Divides a programme among volumes. The floor area of a row, times its count and its storey height, is divided equally "
        "among the volumes of that use as their demand, to be met in floor area. Smallest and largest floor areas become limits "
        "in the same way. Rows of "
        "one use are added up. Rows of open space are for no volume.");
    l.param(&In::use, "use")
        .doc("The use whose rows all volumes of this link share. When empty, each volume takes the rows of its own use.");
    l.param(&In::every_row, "every_row")
        .doc(
            "When on, and no use is given, the link reports each row for which it has no volume, so that no floor area is "
            "forgotten. All other rows are divided nevertheless.");
    l.reads(&Ends::rows, End::from, "programme.rows").reads(&Ends::open_uses, End::from, "programme.open_uses");
    l.reads(&Ends::ids, End::to, "node.id").reads(&Ends::uses, End::to, "smart_volume.use");
    l.proposes(&Out::demand, End::to, "smart_volume.demand", Unit::cubic_metre);
    l.proposes(&Out::demand_min, End::to, "smart_volume.demand_min", Unit::cubic_metre);
    l.proposes(&Out::demand_limit, End::to, "smart_volume.demand_limit", Unit::cubic_metre);
    l.proposes(&Out::by_floor_area, End::to, "smart_volume.by_floor_area", Unit::ratio);
    l.proposes(&Out::storey_height, End::to, "smart_volume.storey_height", Unit::metre);
  }

  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick& tick) {
    std::map<std::string, Share> shares = shares_of(*ends.rows);
    for (const std::string& open : ends.open_uses) shares.erase(open);
    const auto is_open = [&](const std::string& use) {
      return std::binary_search(ends.open_uses.begin(), ends.open_uses.end(), use);
    };
    if (is_open(in.use))
      return Error{ErrorCode::wrong_kind, "use",
                   "the use `" + in.use + "` is open space, which no volume shares: choose another one"};
    if (!in.use.empty() && !shares.contains(in.use)) return no_row(in.use, shares);
    std::string problem;
    for (std::size_t i = 0; i < ends.uses.values.size(); ++i) {
      const std::string& use = in.use.empty() ? ends.uses.values[i] : in.use;
      if (const auto share = shares.find(use); share != shares.end()) ++share->second.volumes;
      else if (is_open(use))
        add_sentence(problem, "`" + ends.ids.values[i] + "` has the use `" + use +
                                  "`, which is open space that no volume has: give it another use");
      else add_sentence(problem, without_row(ends.ids.values[i], use, shares));
    }
    if (in.use.empty() && in.every_row)
      for (const auto& [use, share] : shares)
        if (share.volumes == 0 && share.demand > 0) add_sentence(problem, without_volume(use, share));
    // These do not keep the scene from settling.
    if (!problem.empty()) remark(tick, LinkRemark::short_of, {ErrorCode::missing, "", problem});
    return dealt(in, ends, shares);
  }

 private:
  // What all rows of one use ask for together, and how many volumes share it.
  struct Share {
    double demand = 0, minimum = 0, maximum = 0, floor_area = 0;
    double storey_height = 0;
    bool is_open = false;  // some row has no largest floor area
    int volumes = 0;
  };

  static std::map<std::string, Share> shares_of(const Table& rows) {
    std::map<std::string, Share> shares;
    for (std::size_t row = 0; row < rows.rows.size(); ++row) {
      if (rows.text(row, "use").empty()) continue;  // the programme itself reports it
      Share& share = shares[rows.text(row, "use")];
      const demand::BriefSums sums = demand::brief_sums(rows, row);
      share.demand += sums.volume;
      share.minimum += sums.volume_min;
      share.maximum += sums.volume_max;
      share.is_open = share.is_open || sums.is_open;
      share.floor_area += sums.area;
      share.storey_height = std::max(share.storey_height, rows.number(row, "storey_height"));
    }
    return shares;
  }

  static Out dealt(const In& in, const Ends& ends, const std::map<std::string, Share>& shares) {
    Out out;
    for (const std::string& use : ends.uses.values) {
      const auto found = shares.find(in.use.empty() ? use : in.use);
      if (found == shares.end()) {
        for (auto* silent : {&out.demand, &out.demand_min, &out.demand_limit, &out.by_floor_area, &out.storey_height})
          silent->values.emplace_back();
        continue;
      }
      const Share& share = found->second;
      const double part = 1.0 / share.volumes;
      out.demand.values.emplace_back(share.demand * part);
      out.demand_min.values.push_back(wanted(share.minimum * part, share.minimum > 0));
      out.demand_limit.values.push_back(wanted(share.maximum * part, !share.is_open));
      out.by_floor_area.values.emplace_back(1);
      // Rows of one use with different storeys: the height at which their areas make up their volume.
      const double height = share.floor_area > 0 ? share.demand / share.floor_area : share.storey_height;
      out.storey_height.values.push_back(wanted(height, height > 0));
    }
    return out;
  }

  static std::optional<double> wanted(double value, bool is_given) { return is_given ? std::optional(value) : std::nullopt; }

  static void add_sentence(std::string& text, const std::string& sentence) { text += (text.empty() ? "" : "; ") + sentence; }

  static std::string without_row(const std::string& id, const std::string& use, const std::map<std::string, Share>& shares) {
    if (use.empty()) return "`" + id + "` has no use, so it gets no demand from the programme: give it a use of the programme";
    return "`" + id + "` has the use `" + use + "`, for which the programme has no row: change the use or add the row" +
           did_you_mean(use, keys_of(shares));
  }

  static std::string without_volume(const std::string& use, const Share& share) {
    return "no volume has the use `" + use + "`, so all of the " + fixed(share.floor_area, 0) +
           " m² that it asks for are missing: give a volume that use, add one, or remove the row";
  }

  static Error no_row(const std::string& use, const std::map<std::string, Share>& shares) {
    return {ErrorCode::not_found, "use",
            "the programme has no row of the use `" + use + "`" + did_you_mean(use, keys_of(shares))};
  }
};

}  // namespace

}  // namespace bl

BL_LINK(demand, Demand)
