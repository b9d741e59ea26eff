// Evaluations on values between nothing and something: defaults first, then numbers and places that differ.
#include "ui/cli/script_trial.h"

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace bl::cli {

namespace {

// Zeros, small and large ones: who divides by what it reads, or takes roots of differences, finds one that it can take.
constexpr std::array kTrials = {0.0, 1.0, -2.0, 7.5, 1000.0};

Value trial_value(const PortDefinition& port, double number) {
  switch (port.kind) {
    case ValueKind::boolean: return number > 0;
    case ValueKind::integer: return static_cast<std::int64_t>(number);
    case ValueKind::number: return number;
    case ValueKind::point: return Vector3{number, 2 * number, 3};
    case ValueKind::points: return Shared<std::vector<Point3>>({{0, 0, 0}, {number, 0, 0}, {0, number, 0}});
    case ValueKind::texts: return Shared<std::vector<std::string>>({"a"});
    default: return port.default_value;
  }
}

// What the port holds that a link reads; of one that a parameter chooses only the kind is known.
PortDefinition port_of(const LinkRead& read, const Registry& types) {
  PortDefinition port;
  if (read.path.chosen_by.empty() && !read.is_lock)
    if (const auto found = types.port(read.path)) port = **found;
  port.kind = read.kind;
  return port;
}

std::optional<Error> fault_on(const LinkDefinition& kind, const Registry& types, double number) {
  constexpr std::size_t kNodes = 2;  // of an end that is read as a whole
  std::vector<Value> parameters;
  for (const PortDefinition& port : kind.ports) parameters.push_back(port.default_value);
  const auto in = kind.instantiate(parameters);
  std::vector<Value> storage;
  storage.reserve(kind.reads.size() * kNodes);
  LinkReads reads;
  for (const LinkRead& read : kind.reads) {
    const PortDefinition port = port_of(read, types);
    auto& values = reads.values.emplace_back();
    for (std::size_t n = 0; n < (read.is_whole ? kNodes : 1); ++n) {
      // Both ends at one place, or with one value, are a case of their own, which the first trial is.
      storage.push_back(trial_value(port, number * static_cast<double>(1 + n + reads.values.size())));
      values.push_back(&storage.back());
    }
  }
  LinkWrites writes;
  for (const LinkWrite& write : kind.proposes) writes.values.emplace_back(write.is_whole ? kNodes : 1);
  const auto done = kind.evaluate(in.get(), reads, writes, Tick{1, nullptr});
  return done ? std::nullopt : std::optional(done.error());
}

}  // namespace

std::optional<Error> fault_of_kind(const LinkDefinition& kind, const Registry& types) {
  std::optional<Error> first;
  for (const double number : kTrials) {
    auto fault = fault_on(kind, types, number);
    if (!fault) return std::nullopt;
    if (!first) first = std::move(fault);
  }
  return first;
}

}  // namespace bl::cli
