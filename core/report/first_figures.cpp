// What a proposal is judged by first: floor area by use, densities of plots, sun, and rules that are not met.
#include <algorithm>
#include <span>

#include "core/reading/account.h"
#include "core/reading/plot_problems.h"
#include "core/report/comparison.h"

namespace bl::report {

namespace {

// A port of a typification, and what people call it.
struct Judged {
  const char* port;
  const char* label;
  bool is_share = false;
};
constexpr Judged kOfPlots[] = {{"fsi", "FSI"}, {"gsi", "GSI", true}, {"osr", "OSR"}, {"layers", "Storeys"}};
constexpr Judged kOfSolvers[] = {{"fsi", "FSI"}, {"gsi", "GSI", true}, {"osr", "OSR"}, {"mean_storeys", "Storeys"}};

class FirstFigures {
 public:
  FirstFigures(const State& before, const State& after) : states_{&before, &after} {}

  std::vector<IndicatorRow> run() {
    floor_areas();
    // Where both have plots, their rules are what counts; else the solvers' figures of the same ground.
    const bool has_plots = has_type("plot", 0) && has_type("plot", 1);
    for (const Judged& judged : has_plots ? std::span<const Judged>(kOfPlots) : std::span<const Judged>(kOfSolvers))
      ports(has_plots ? "plot" : "standing_solver", judged, Unit::ratio);
    ports("shadow_receiver", {"share_met", "Area that has enough sun", true}, Unit::ratio);
    ports("shadow_receiver", {"sun_mean", "Sun, mean"}, Unit::second);
    rules();
    return std::move(rows_);
  }

 private:
  IndicatorRow& row_of(const std::string& node, const std::string& name, const std::string& path, const std::string& label,
                       Unit unit) {
    const auto found = std::find_if(rows_.begin(), rows_.end(), [&](const IndicatorRow& row) {
      return row.node == node && row.name == name && row.path == path;
    });
    if (found != rows_.end()) return *found;
    IndicatorRow row;
    row.node = node;
    row.name = name;
    row.path = path;
    row.label = label;
    row.unit = unit;
    row.has_before = row.has_after = false;
    rows_.push_back(row);
    return rows_.back();
  }

  static void put(IndicatorRow& row, std::size_t which, double value) {
    (which == 0 ? row.before : row.after) = value;
    (which == 0 ? row.has_before : row.has_after) = true;
  }

  void floor_areas() {
    for (std::size_t k = 0; k < 2; ++k) {
      const reading::Accounts accounts = reading::accounts_of(*states_[k]);
      for (const reading::UseAccount& use : accounts.uses)
        if (use.volumes > 0 || use.asked_area > 0)
          put(row_of("", use.use.empty() ? "without a use" : use.use, "first.floor_area", "Floor area", Unit::square_metre), k,
              use.floor_area);
    }
    for (std::size_t k = 0; k < 2; ++k)
      put(row_of("", "All", "first.all_floor_area", "Floor area", Unit::square_metre), k,
          reading::accounts_of(*states_[k]).all.floor_area);
  }

  bool has_type(const std::string& type, std::size_t which) const {
    for (const auto& [id, node] : states_[which]->plan->scene.nodes)
      if (node.types.contains(type)) return true;
    return false;
  }

  void ports(const std::string& type, const Judged& judged, Unit unit) {
    for (std::size_t k = 0; k < 2; ++k) {
      const State& state = *states_[k];
      for (std::uint32_t n = 0; n < state.plan->nodes.size(); ++n) {
        const NodePlan& node = state.plan->nodes[n];
        for (std::uint16_t t = 0; t < node.types.size(); ++t) {
          if (node.types[t].definition->id != type) continue;
          const PortDefinition* port = node.types[t].definition->find_port(judged.port);
          if (port == nullptr) continue;
          const auto p = static_cast<std::uint16_t>(port - node.types[t].definition->ports.data());
          IndicatorRow& row = row_of(node.id, node.name, type + "." + judged.port, judged.label, unit);
          row.is_share = judged.is_share;
          put(row, k, as_number(state.value({n, t, p})));
        }
      }
    }
  }

  void rules() {
    for (std::size_t k = 0; k < 2; ++k)
      if (has_type("plot", k))
        put(row_of("", "All", "first.rules", "Rules of plots that are not met", Unit::count), k,
            static_cast<double>(reading::broken_rules(*states_[k]).size()));
  }

  const State* states_[2];
  std::vector<IndicatorRow> rows_;
};

}  // namespace

std::vector<IndicatorRow> first_figures(const State& before, const State& after) { return FirstFigures(before, after).run(); }

}  // namespace bl::report
