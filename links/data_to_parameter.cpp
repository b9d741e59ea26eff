// Carries the value of a data layer under a node to one of its ports.
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/text.h"
#include "core/define/link_builder.h"
#include "core/define/registry.h"
#include "core/geometry/point_sampling.h"

namespace bl {

namespace {

struct DataToParameter {
  struct In {
    PortChoice target{"smart_volume.demand"};
    geometry::Sampling sampling = geometry::Sampling::inverse_distance;
    double radius = 100;
    bool rescale = true;
    double in_min = 0, in_max = 100, out_min = 0, out_max = 1000;
    bool clamp = true, needs_data = true;
  };
  struct Ends {
    Shared<Table> values;
    Point3 position;
  };
  struct Out {
    std::optional<double> value;
  };

  static void declare(LinkBuilder<DataToParameter>& l) {
    l.id("data_to_parameter")
        .label("Data to parameter")
        .doc(
            "Reads a data layer at the position of a node and proposes the number to any port that links may change. The number "
            "is unchanged, or rescaled from a range of the data to a range of the port.");
    l.family(LinkFamily::data);
    l.param(&In::target, "target").doc("The port that the number is proposed to, written `typification.port`.");
    l.param(&In::sampling, "sampling",
            {{geometry::Sampling::nearest, "nearest", "The value of the nearest point."},
             {geometry::Sampling::inverse_distance, "inverse_distance",
              "All points within the radius, weighted with one over the squared distance."},
             {geometry::Sampling::mean, "mean", "The plain mean of all points within the radius."}})
        .doc("How the value between the points is found.");
    l.param(&In::radius, "radius").unit(Unit::metre).range(0.1, 1e6).soft(10, 1000).doc("How far from the node points count.");
    l.param(&In::needs_data, "needs_data")
        .doc("When on, a node without a point within the radius is an error; when off, such a node gets no proposal.");
    l.param(&In::rescale, "rescale").doc("When on, the number is rescaled from the range of the data to the range of the port.");
    l.param(&In::in_min, "in_min").soft(0, 100).doc("The value of the data that becomes `out_min`.");
    l.param(&In::in_max, "in_max").soft(0, 100).doc("The value of the data that becomes `out_max`.");
    l.param(&In::out_min, "out_min").unit_from("target").soft(0, 1000).doc("The number that the target gets for `in_min`.");
    l.param(&In::out_max, "out_max")
        .unit_from("target")
        .soft(0, 1000)
        .doc("The number that the target gets for `in_max`; it may be smaller than `out_min`.");
    l.param(&In::clamp, "clamp")
        .doc("When on, values outside the range of the data count as its nearer limit; used with rescale only.");
    l.reads(&Ends::values, End::from, "data_layer.values");
    l.reads(&Ends::position, End::to, "node.position", Unit::metre);
    l.proposes_chosen(&Out::value, End::to, "target");
  }

  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick&) {
    if (in.rescale && in.in_min == in.in_max)
      return Error{ErrorCode::out_of_range, "in_max",
                   "the range of the data is empty; give `in_min` and `in_max` different values"};
    const auto sampled = sample(in, ends);
    if (!sampled && in.needs_data)
      return Error{ErrorCode::not_found, "radius",
                   "the layer has no point within " + shortest(in.radius) +
                       " m of the node: make the radius larger, or turn `needs_data` off"};
    if (!sampled) return Out{};
    if (!in.rescale) return Out{*sampled};
    double share = (*sampled - in.in_min) / (in.in_max - in.in_min);
    if (in.clamp) share = std::clamp(share, 0.0, 1.0);
    const double value = in.out_min * (1 - share) + in.out_max * share;
    if (!std::isfinite(value))
      return Error{ErrorCode::not_finite, "", "the rescaled number is too large; widen the range of the data or turn `clamp` on"};
    return Out{value};
  }

 private:
  // The rows are read in place and not copied: a layer may have many, and is read in every tick.
  static std::optional<double> sample(const In& in, const Ends& ends) {
    const Table& table = *ends.values;
    const std::size_t x = table.column("x"), y = table.column("y"), value = table.column("value");
    geometry::PointSampler sampler(in.sampling, ends.position.x, ends.position.y, in.radius);
    for (const auto& row : table.rows) {
      if (x >= row.size() || y >= row.size() || value >= row.size()) continue;
      const double *at_x = std::get_if<double>(&row[x]), *at_y = std::get_if<double>(&row[y]),
                   *v = std::get_if<double>(&row[value]);
      if (at_x && at_y && v) sampler.add(*at_x, *at_y, *v);
    }
    return sampler.value();
  }
};

}  // namespace

}  // namespace bl

BL_LINK(data_to_parameter, DataToParameter)
