// `assign`: the user equilibrium of a TNTP network, what an edit changes, and how published flows compare.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>

#include <nlohmann/json.hpp>

#include "core/base/median.h"
#include "core/base/stop.h"
#include "core/base/text.h"
#include "core/define/json_text.h"
#include "core/file/file_io.h"
#include "core/import/tntp.h"
#include "core/traffic/equilibrium.h"
#include "core/traffic/reach.h"
#include "ui/cli/commands.h"
#include "ui/cli/interrupt.h"
#include "ui/cli/scene_loading.h"
#include "ui/cli/terminal.h"

namespace bl::cli {

namespace {

constexpr std::size_t kMostStreetLines = 10;  // of one kind, on the terminal

// What an input file holds, or nothing after its errors and notes are printed.
template <class Content>
std::optional<Content> load(const std::string& path, Result<Content> (*read)(std::string_view)) {
  const auto text = read_file(path);
  if (!text) {
    print_error(path, text.error());
    return std::nullopt;
  }
  auto content = read(*text);
  if (!content) {
    print_error(path, content.error());
    return std::nullopt;
  }
  for (const std::string& note : content->notes) print_line("note: " + path + ": " + note);
  return std::move(*content);
}

struct Edit {
  std::uint32_t link = 0;
  double capacity = -1;  // below 0: closed
};

class AssignRun {
 public:
  explicit AssignRun(const AssignOptions& options) : o_(options) {}

  int execute() {
    if (!read() || !read_edits() || !read_questions()) return kBadInput;
    catch_interrupts();
    // After an interrupt everything is told and written as far as it has come: the gap says how far.
    const StopScope scope(is_interrupted);
    bool is_met = false;
    const auto found = settle("equilibrium", *network_, is_met);
    traffic::Equilibrium& equilibrium = *found;
    tell_lost(equilibrium);
    Json json = {{"equilibrium", figures_json(equilibrium)}};
    if (flows_) json["comparison"] = compare(equilibrium);
    bool is_met_again = true;
    if (is_interrupted() && !edits_.empty()) {
      print_line("stopped before the edit, which is not made", Colour::red);
    } else if (!edits_.empty()) {
      is_met_again = settle_edited(equilibrium);
      tell_lost(equilibrium);
      json["after_edit"] = figures_json(equilibrium);
    }
    for (const auto& [from, to] : routes_) json["routes"].push_back(tell_routes(equilibrium, from, to));
    for (const auto& [from, limit] : reach_) json["reach"].push_back(tell_reach(equilibrium, from, limit));
    json["links"] = links_json(equilibrium);
    if (places_)
      for (const importing::TntpPlaces::Entry& place : places_->entries)
        json["nodes"][place.node] = {{"x", place.x}, {"y", place.y}};
    if (!o_.json.empty())
      if (auto written = write_file(o_.json, write_json(json) + "\n"); !written) {
        print_error(o_.json, written.error());
        return kBadInput;
      }
    if (is_interrupted()) {
      print_line(o_.json.empty() ? "stopped" : "stopped; the result so far is written: " + o_.json, Colour::red);
      return interrupt_exit_code();
    }
    return is_met && is_met_again ? kDone : kNotMet;
  }

 private:
  bool read() {
    const auto net = load(o_.net, importing::read_tntp_network);
    const auto trips = load(o_.trips, importing::read_tntp_trips);
    if (!o_.flows.empty()) flows_ = load(o_.flows, importing::read_tntp_flows);
    if (!o_.nodes.empty()) places_ = load(o_.nodes, importing::read_tntp_places);
    if (!net || !trips || (!o_.flows.empty() && !flows_) || (!o_.nodes.empty() && !places_)) return false;
    const traffic::CostFactors factors{o_.toll_factor >= 0 ? o_.toll_factor : net->factors.toll,
                                       o_.distance_factor >= 0 ? o_.distance_factor : net->factors.distance};
    auto made = traffic::TrafficNetwork::make(net->nodes, net->links, factors);
    if (!made) {
      print_error(o_.net, made.error());
      return false;
    }
    network_ = std::move(*made);
    for (const importing::TntpTrips::Entry& entry : trips->entries) {
      const std::uint32_t origin = network_->node_index(entry.origin), destination = network_->node_index(entry.destination);
      if (origin == traffic::kNoTrafficIndex || destination == traffic::kNoTrafficIndex) {
        print_error(o_.trips, {ErrorCode::not_found, "Origin " + entry.origin,
                               "trips from " + entry.origin + " to " + entry.destination + ", but the network has no node " +
                                   (origin == traffic::kNoTrafficIndex ? entry.origin : entry.destination)});
        return false;
      }
      demands_.push_back({origin, destination, entry.trips});
    }
    print_line(counted(static_cast<std::size_t>(net->zones), "zone") + ", " + counted(network_->node_count(), "node") + ", " +
               counted(network_->link_count(), "link") + ", " + fixed(trips->total, 1) + " trips");
    return true;
  }

  std::optional<std::uint32_t> link_named(const std::string& name, const char* option) const {
    const std::uint32_t link = network_->link_index(name);
    if (link != traffic::kNoTrafficIndex) return link;
    print_error("", {ErrorCode::not_found, option,
                     "there is no link `" + name + "`; links are named by their nodes, such as `" + network_->link(0).id + "`"});
    return std::nullopt;
  }

  bool read_edits() {
    for (const std::string& text : o_.edit_capacity) {
      const std::size_t equals = text.find('=');
      const auto value = equals == std::string::npos ? std::nullopt : parse_number(text.substr(equals + 1));
      if (!value || !(*value > 0)) {
        print_error("", {ErrorCode::parse, "--edit-capacity", "expects LINK=VALUE with a value above 0, found `" + text + "`"});
        return false;
      }
      const auto link = link_named(text.substr(0, equals), "--edit-capacity");
      if (!link) return false;
      edits_.push_back({*link, *value});
    }
    for (const std::string& text : o_.close) {
      const auto link = link_named(text, "--close");
      if (!link) return false;
      edits_.push_back({*link, -1});
    }
    return true;
  }

  std::optional<std::uint32_t> node_named(const std::string& name, const char* option) const {
    const std::uint32_t node = network_->node_index(name);
    if (node != traffic::kNoTrafficIndex) return node;
    print_error("", {ErrorCode::not_found, option, "there is no node `" + name + "` in the network"});
    return std::nullopt;
  }

  bool read_questions() {
    for (const std::string& text : o_.routes) {
      const std::size_t dash = text.find('-');
      const auto from = node_named(text.substr(0, dash), "--routes");
      const auto to = node_named(dash == std::string::npos ? "" : text.substr(dash + 1), "--routes");
      if (!from || !to) return false;
      routes_.emplace_back(*from, *to);
    }
    for (const std::string& text : o_.reach) {
      const std::size_t equals = text.find('=');
      const auto limit = equals == std::string::npos ? std::nullopt : parse_number(text.substr(equals + 1));
      if (!limit || !(*limit > 0)) {
        print_error("", {ErrorCode::parse, "--reach", "expects NODE=LIMIT with a limit above 0, found `" + text + "`"});
        return false;
      }
      const auto node = node_named(text.substr(0, equals), "--reach");
      if (!node) return false;
      reach_.emplace_back(*node, *limit);
    }
    return true;
  }

  Json tell_routes(const traffic::Equilibrium& equilibrium, std::uint32_t from, std::uint32_t to) const {
    const auto routes = equilibrium.routes(from, to);
    print_line();
    print_parts({{"from " + network_->node(from).id + " to " + network_->node(to).id, Colour::bold},
                 {routes.empty() ? ": no trips" : "", Colour::plain}});
    Json json = Json::array();
    TextTable table({{"trips", true}, {"cost", true}, {"by"}});
    for (const traffic::Route& route : routes) {
      std::string nodes = network_->node(from).id;
      for (const std::uint32_t link : route.links) nodes += " " + network_->node(network_->to(link)).id;
      json.push_back({{"trips", route.trips}, {"cost", route.cost}, {"nodes", nodes}});
      table.add({fixed(route.trips, 2), fixed(route.cost, 4), nodes});
    }
    if (!routes.empty()) table.print();
    return {{"from", network_->node(from).id}, {"to", network_->node(to).id}, {"used", std::move(json)}};
  }

  Json tell_reach(const traffic::Equilibrium& equilibrium, std::uint32_t from, double limit) const {
    const std::vector<double> at = travel_costs(equilibrium.network(), from, equilibrium.costs());
    Json nodes = Json::object(), links = Json::array();
    for (std::uint32_t n = 0; n < at.size(); ++n)
      if (at[n] <= limit) nodes[network_->node(n).id] = at[n];
    double whole = 0;
    for (const traffic::ReachedLink& reached : reached_links(equilibrium.network(), from, at, equilibrium.costs(), limit)) {
      links.push_back({{"link", network_->link(reached.link).id}, {"share", reached.share}});
      whole += reached.share == 1 ? 1 : 0;
    }
    print_line();
    print_parts({{"from " + network_->node(from).id + " within " + shortest(limit), Colour::bold},
                 {": " + counted(nodes.size(), "node") + ", " + counted(static_cast<std::size_t>(whole), "link") + " whole and " +
                      std::to_string(links.size() - static_cast<std::size_t>(whole)) + " in part",
                  Colour::plain}});
    return {{"from", network_->node(from).id}, {"limit", limit}, {"nodes", std::move(nodes)}, {"links", std::move(links)}};
  }

  // Iterates until the gap is reached; `gaps` gets one entry for each iteration.
  bool iterate(traffic::Equilibrium& equilibrium, std::vector<double>& gaps) const {
    const int end = equilibrium.figures().iterations + o_.iterations;
    Progress progress;
    while (true) {
      const traffic::EquilibriumFigures figures = equilibrium.figures();
      gaps.push_back(figures.gap);
      if (figures.gap <= o_.gap) return true;
      if (figures.iterations >= end || is_interrupted()) return false;
      if (progress.is_due()) progress.show("iteration " + std::to_string(figures.iterations) + ", gap " + rough(figures.gap));
      equilibrium.iterate();
    }
  }

  // From the beginning, as often as asked; the state of the last run is kept.
  std::unique_ptr<traffic::Equilibrium> settle(const std::string& label, const traffic::TrafficNetwork& network,
                                               bool& is_met) const {
    std::unique_ptr<traffic::Equilibrium> equilibrium;
    std::vector<double> gaps, seconds;
    for (int r = 0; r < o_.repeat && (r == 0 || !is_interrupted()); ++r) {
      gaps.clear();
      const double began = now();
      equilibrium = std::make_unique<traffic::Equilibrium>(network, demands_);
      is_met = iterate(*equilibrium, gaps);
      seconds.push_back(now() - began);
    }
    print_row(*equilibrium, label, gaps, median(seconds), is_met);
    return equilibrium;
  }

  void apply(traffic::Equilibrium& equilibrium) const {
    for (const Edit& edit : edits_) {
      if (edit.capacity < 0) equilibrium.set_open(edit.link, false);
      else if (auto done = equilibrium.set_capacity(edit.link, edit.capacity); !done) print_error(o_.net, done.error());
    }
  }

  // The edit on the running state, and for comparison everything from the beginning.
  bool settle_edited(traffic::Equilibrium& equilibrium) {
    const std::vector<traffic::OriginFlow> before = equilibrium.origin_flows();
    std::vector<double> gaps, seconds;
    for (int r = 1; r < o_.repeat && !is_interrupted(); ++r) {
      traffic::Equilibrium other(*network_, demands_, before);
      const double began = now();
      apply(other);
      iterate(other, gaps);
      seconds.push_back(now() - began);
    }
    gaps.clear();
    const double began = now();
    apply(equilibrium);
    const bool is_met = iterate(equilibrium, gaps);
    seconds.push_back(now() - began);
    print_row(equilibrium, "after the edit, warm", gaps, median(seconds), is_met);
    if (is_interrupted()) return is_met;
    bool is_cold_met = false;
    (void)settle("the same, cold", equilibrium.network(), is_cold_met);
    return is_met;
  }

  void print_row(traffic::Equilibrium& equilibrium, const std::string& label, const std::vector<double>& gaps, double seconds,
                 bool is_met) const {
    const traffic::EquilibriumFigures figures = equilibrium.figures();
    print_line();
    print_parts({{label, Colour::bold}, {is_met ? "" : " (the gap was not reached)", Colour::red}});
    print_line("  iterations  " + std::to_string(gaps.size() - 1));
    print_line("  gap         " + rough(figures.gap) + "  (at the start " + rough(gaps.front()) + ")");
    print_line("  objective   " + fixed(figures.objective, 6));
    print_line("  total cost  " + fixed(figures.total_cost, 6));
    print_line("  seconds     " + fixed(seconds, 6) + (o_.repeat > 1 ? "  (median of " + std::to_string(o_.repeat) + ")" : ""));
    if (figures.within > 0)
      print_line("  within      " + fixed(figures.within, 1) + " trips stay in their zone and need no street");
    if (figures.waiting > 0)
      print_line("  waiting     " + fixed(figures.waiting, 1) +
                 " trips were not loaded before it was stopped: flows and costs are those of the others");
    if (figures.cut > 0)
      print_line(
          "  cut         " + counted(figures.cut, "link") +
          " would cost more than 1e100: gap, objective and total are computed with smaller costs than those of the formula");
  }

  void tell_lost(const traffic::Equilibrium& equilibrium) const {
    const auto& lost = equilibrium.lost();
    for (std::size_t i = 0; i < lost.size() && i < kMostStreetLines; ++i)
      print_line("  lost        " + fixed(lost[i].trips, 1) + " trips from " + network_->node(lost[i].origin).id + " to " +
                 network_->node(lost[i].destination).id + ": " + lost[i].reason);
    if (lost.size() > kMostStreetLines)
      print_line("  and " + std::to_string(lost.size() - kMostStreetLines) + " more pairs are lost; --json has all");
  }

  Json compare(const traffic::Equilibrium& equilibrium) const {
    std::map<std::string, int> twins;
    double difference = 0, volume = 0, worst = 0;
    std::string worst_link, missing;
    std::size_t compared = 0;
    for (const importing::TntpFlows::Entry& entry : flows_->entries) {
      std::string name = entry.from + "-" + entry.to;
      if (const int count = ++twins[name]; count > 1) name += "#" + std::to_string(count);
      const std::uint32_t link = network_->link_index(name);
      if (link == traffic::kNoTrafficIndex) {
        missing += (missing.empty() ? "" : ", ") + name;
        continue;
      }
      ++compared;
      const double apart = std::abs(equilibrium.flows()[link] - entry.volume);
      difference += apart;
      volume += entry.volume;
      if (apart <= worst) continue;
      worst = apart;
      worst_link = name;
    }
    const double share = volume > 0 ? difference / volume : 0;
    print_line("  compared    " + counted(compared, "flow") + ": apart by " + rough(100 * share) + " % of all flow" +
               (worst_link.empty() ? "" : ", at most by " + rough(worst) + " on " + worst_link));
    if (!missing.empty()) print_line("  not in the network: " + missing);
    return {{"links", compared}, {"share_apart", share}, {"largest", worst}, {"at", worst_link}};
  }

  static Json figures_json(traffic::Equilibrium& equilibrium) {
    const traffic::EquilibriumFigures f = equilibrium.figures();
    Json lost = Json::array();
    const traffic::TrafficNetwork& network = equilibrium.network();
    for (const traffic::LostTrips& l : equilibrium.lost())
      lost.push_back({{"from", network.node(l.origin).id},
                      {"to", network.node(l.destination).id},
                      {"trips", l.trips},
                      {"reason", l.reason}});
    return {{"iterations", f.iterations}, {"gap", f.gap},     {"objective", f.objective},
            {"total_cost", f.total_cost}, {"trips", f.trips}, {"within", f.within},
            {"waiting", f.waiting},       {"cut", f.cut},     {"lost", std::move(lost)}};
  }

  static Json links_json(const traffic::Equilibrium& equilibrium) {
    Json links = Json::array();
    for (std::uint32_t l = 0; l < equilibrium.network().link_count(); ++l)
      links.push_back(
          {{"link", equilibrium.network().link(l).id}, {"flow", equilibrium.flows()[l]}, {"cost", equilibrium.costs()[l]}});
    return links;
  }

  const AssignOptions& o_;
  std::optional<traffic::TrafficNetwork> network_;
  std::vector<traffic::TripDemand> demands_;
  std::optional<importing::TntpFlows> flows_;
  std::optional<importing::TntpPlaces> places_;
  std::vector<Edit> edits_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> routes_;  // from and to
  std::vector<std::pair<std::uint32_t, double>> reach_;          // from and limit
};

}  // namespace

int assign_command(const AssignOptions& options) { return AssignRun(options).execute(); }

}  // namespace bl::cli
