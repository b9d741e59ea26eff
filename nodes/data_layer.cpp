// A layer of urban data: points with a value each, with unit, source and licence.
#include <algorithm>
#include <cmath>

#include "core/define/registry.h"
#include "core/define/typification_builder.h"

namespace bl {

namespace {

struct DataLayer {
  struct In {
    Shared<Table> values;
    std::string quantity, unit, source, licence;
  };

  struct Out {
    std::int64_t count = 0;
    double sum = 0, mean = 0, minimum = 0, maximum = 0;
  };

  static void declare(TypificationBuilder<DataLayer>& t) {
    t.id("data_layer").label("Data layer");
    t.doc(
        "Urban data: points with one value each, such as noise levels or residents. Links read the values at the positions of "
        "nodes.");
    t.in(&In::values, "values")
        .column({.id = "x", .unit = Unit::metre, .minimum = -1e7, .maximum = 1e7, .doc = "East coordinate of the point."})
        .column({.id = "y", .unit = Unit::metre, .minimum = -1e7, .maximum = 1e7, .doc = "North coordinate of the point."})
        .column({.id = "value", .minimum = -1e12, .maximum = 1e12, .doc = "The value there, in the unit of the layer."})
        .doc("The points. Places without a value have no row.");
    t.in(&In::quantity, "quantity").doc("What the values measure, such as `noise level at night`.");
    t.in(&In::unit, "unit").doc("Unit of the values as a symbol, such as `dB` or `m`; empty for plain numbers.");
    t.in(&In::source, "source").doc("Who made the data, when, and from which file it came.");
    t.in(&In::licence, "licence").doc("Licence of the data, such as `CC BY 4.0`.");
    t.out(&Out::count, "count").unit(Unit::count).doc("Number of points.");
    t.out(&Out::sum, "sum").unit_from("unit").doc("Sum of the values.");
    t.out(&Out::mean, "mean").unit_from("unit").doc("Mean of the values; 0 where there are none.");
    t.out(&Out::minimum, "minimum").unit_from("unit").doc("Smallest value; 0 where there are none.");
    t.out(&Out::maximum, "maximum").unit_from("unit").doc("Largest value; 0 where there are none.");
  }

  static Result<Out> evaluate(const In& in, const Tick&) {
    Out out;
    const std::size_t column = in.values->column("value");
    for (const auto& row : in.values->rows) {
      const double* value = column < row.size() ? std::get_if<double>(&row[column]) : nullptr;
      if (value == nullptr) continue;
      out.minimum = out.count == 0 ? *value : std::min(out.minimum, *value);
      out.maximum = out.count == 0 ? *value : std::max(out.maximum, *value);
      out.sum += *value;
      ++out.count;
    }
    if (out.count > 0) out.mean = out.sum / static_cast<double>(out.count);
    return out;
  }
};

}  // namespace

}  // namespace bl

BL_TYPIFICATION(data_layer, DataLayer)
