// Numbers of a whole set of nodes: sum, mean, extremes and spread of one port.
#include <algorithm>
#include <cmath>

#include "core/define/registry.h"
#include "core/define/typification_builder.h"

namespace bl {

namespace {

struct Statistics {
  struct In {
    Selection nodes{{}, "smart_volume", {}};
    PortChoice port{"smart_volume.volume"};
  };
  struct Member {
    double value = 0;
  };
  struct Sets {
    Watched<Member> nodes;
  };
  struct Out {
    double sum = 0, mean = 0, minimum = 0, maximum = 0, spread = 0;
    std::int64_t count = 0;
  };

  static void declare(TypificationBuilder<Statistics>& t) {
    t.id("statistics").label("Statistics");
    t.column(CanvasColumn::second).icon(Icon::balance);
    t.doc(
        "Adds up one port over a set of nodes, so that links can react to the whole. The numbers are those of the tick before.");
    t.in(&In::nodes, "nodes")
        .doc("The nodes that are counted. Of nodes selected by typification or tag, those without the port are left out.");
    t.in(&In::port, "port").doc("The port that is evaluated, written `typification.port`; it must hold a number.");
    t.out(&Out::sum, "sum").traced().shown_first().unit_from("port").doc("Sum of the values.");
    t.out(&Out::mean, "mean").shown_first().unit_from("port").doc("Mean of the values; 0 where there are none.");
    t.out(&Out::minimum, "minimum").unit_from("port").doc("Smallest value; 0 where there are none.");
    t.out(&Out::maximum, "maximum").unit_from("port").doc("Largest value; 0 where there are none.");
    t.out(&Out::spread, "spread")
        .unit_from("port")
        .doc("Standard deviation: the root of the mean squared distance from the mean.");
    t.out(&Out::count, "count").shown_first().unit(Unit::count).doc("Number of nodes that were counted.");
    t.set("nodes", &Sets::nodes).reads_chosen(&Member::value, "port");
  }

  static Result<Out> evaluate(const In& in, const Sets& sets, const Tick&) {
    if (in.port.path.empty())
      return Error{ErrorCode::missing, "port", "no port is chosen: choose one, such as `smart_volume.volume`"};
    Out out;
    const std::span<const Member> nodes = sets.nodes.all;
    out.count = static_cast<std::int64_t>(nodes.size());
    if (nodes.empty()) return out;
    out.minimum = out.maximum = nodes.front().value;
    for (const Member& member : nodes) {
      out.sum += member.value;
      out.minimum = std::min(out.minimum, member.value);
      out.maximum = std::max(out.maximum, member.value);
    }
    const double count = static_cast<double>(nodes.size());
    out.mean = out.sum / count;
    double squares = 0;
    for (const Member& member : nodes) squares += (member.value - out.mean) * (member.value - out.mean);
    out.spread = std::sqrt(squares / count);
    return out;
  }
};

}  // namespace

}  // namespace bl

BL_TYPIFICATION(statistics, Statistics)
