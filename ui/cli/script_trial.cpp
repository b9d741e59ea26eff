// Evaluates with the defaults of the ports that are read, then with other numbers and positions inside their ranges.
#include "ui/cli/script_trial.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace bl::cli {

namespace {

// Zeros, small and large ones: who divides by what it reads, or takes roots of differences, finds one that it can take.
constexpr std::array kTrials = {0.0, 1.0, -2.0, 7.5, 1000.0};

// The number itself where the port takes it, else one inside its range and off its ends.
double inside(const PortDefinition& port, double number) {
  const double low = port.hard_minimum, high = port.hard_maximum, size = std::abs(number);
  if (number >= low && number <= high) return number;
  if (std::isfinite(low) && std::isfinite(high)) return low + (high - low) / (1 + std::max(size, 0.25));
  return std::isfinite(low) ? low + size : high - size;
}

std::string word_of(const PortDefinition& port, double number) {
  if (port.choices.empty()) return "a";
  const auto index = static_cast<std::size_t>(std::abs(number));
  return port.choices[index % port.choices.size()].id;
}

Value trial_value(const PortDefinition& port, double number) {
  switch (port.kind) {
    case ValueKind::boolean: return number > 0;
    case ValueKind::integer: return static_cast<std::int64_t>(inside(port, number));
    case ValueKind::number: return inside(port, number);
    case ValueKind::text:
    case ValueKind::choice: return word_of(port, number);
    case ValueKind::point: return Vector3{number, 2 * number, 3};
    case ValueKind::points: return Shared<std::vector<Point3>>({{0, 0, 0}, {number, 0, 0}, {0, number, 0}});
    case ValueKind::texts: return Shared<std::vector<std::string>>({"a"});
    case ValueKind::numbers: return Numbers({number, 2 * number});
    default: return port.default_value;
  }
}

// The default of the port that a link reads, in the kind that it reads.
Value default_of(const PortDefinition& port) {
  if (port.kind == ValueKind::number) return as_number(port.default_value);
  if (port.kind == ValueKind::integer) return static_cast<std::int64_t>(as_number(port.default_value));
  return port.default_value;
}

// What the port holds that a link reads; nothing of one that a parameter chooses, of which only the kind is known, nor of its
// lock.
const PortDefinition* port_of(const LinkRead& read, const Registry& types) {
  if (!read.path.chosen_by.empty() || read.is_lock) return nullptr;
  const auto found = types.port(read.path);
  return found ? *found : nullptr;
}

// Words that people have to give are given; all other parameters work at their defaults.
std::vector<Value> parameters_of(const LinkDefinition& kind, bool gives_words) {
  std::vector<Value> parameters;
  for (const PortDefinition& port : kind.ports) {
    const auto* word = std::get_if<std::string>(&port.default_value);
    const bool is_wanting = port.kind == ValueKind::text && word != nullptr && word->empty();
    parameters.push_back(gives_words && is_wanting ? Value(std::string("a")) : port.default_value);
  }
  return parameters;
}

// Without a number: on the defaults.
std::optional<Error> fault_on(const LinkDefinition& kind, const Registry& types, std::optional<double> number) {
  constexpr std::size_t kNodes = 2;  // of an end that is read as a whole
  const auto in = kind.instantiate(parameters_of(kind, number.has_value()));
  std::vector<Value> storage;
  storage.reserve(kind.reads.size() * kNodes);
  LinkReads reads;
  for (const LinkRead& read : kind.reads) {
    PortDefinition port;
    const PortDefinition* known = port_of(read, types);
    if (known != nullptr) port = *known;
    port.kind = read.kind;
    auto& values = reads.values.emplace_back();
    for (std::size_t n = 0; n < (read.is_whole ? kNodes : 1); ++n) {
      // Both ends at one place, or with one value, are a case of their own, which the first trial is.
      const double scale = static_cast<double>(1 + n + reads.values.size());
      if (!number && read.is_lock) storage.emplace_back(false);
      else storage.push_back(!number && known != nullptr ? default_of(port) : trial_value(port, number.value_or(1) * scale));
      values.push_back(&storage.back());
    }
  }
  LinkWrites writes;
  for (const LinkWrite& write : kind.proposes) writes.values.emplace_back(write.is_whole ? kNodes : 1);
  const auto done = kind.evaluate(in.get(), reads, writes, Tick{1, nullptr});
  return done ? std::nullopt : std::optional(done.error());
}

}  // namespace

std::optional<KindFault> fault_of_kind(const LinkDefinition& kind, const Registry& types) {
  std::vector<std::optional<double>> trials{std::nullopt};
  trials.insert(trials.end(), kTrials.begin(), kTrials.end());
  std::optional<KindFault> first;
  for (const auto& number : trials) {
    auto fault = fault_on(kind, types, number);
    if (!fault) return std::nullopt;
    const bool is_unknown_name = fault->message.find("a nil value (global '") != std::string::npos;
    if (!first) first = KindFault{std::move(*fault), is_unknown_name};
    else first->is_certain = first->is_certain && is_unknown_name;
  }
  if (!first->is_certain) first->error.message += " (on all sample values; with the values of a scene it may work)";
  return first;
}

}  // namespace bl::cli
