// One evaluation of a link kind by hand: parameters and readings by name in, proposals by name out.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "core/define/link_remark.h"
#include "tests/support/world.h"

namespace bl {

class LinkCase {
 public:
  explicit LinkCase(const std::string& kind) : link_(full_registry().link(kind)) {}
  /// A kind of no registry; it has to outlive the case.
  explicit LinkCase(const LinkDefinition& kind) : link_(&kind) {}

  LinkCase& set(const std::string& parameter, Value value) {
    parameters_[parameter] = std::move(value);
    return *this;
  }
  /// What stands at a port of the end; several values are several nodes of a whole end.
  LinkCase& read(End end, const std::string& path, std::vector<Value> values) {
    readings_[{end, path}] = std::move(values);
    return *this;
  }
  LinkCase& from(const std::string& path, Value value) { return read(End::from, path, {std::move(value)}); }
  LinkCase& to(const std::string& path, Value value) { return read(End::to, path, {std::move(value)}); }

  /// People have locked the port of one node; locks are declared after what is read of a whole end.
  LinkCase& lock(End end, const std::string& path, std::size_t node = 0) {
    locked_.insert({end, path, node});
    return *this;
  }

  /// "" or the error's text; then `proposed` can be asked.
  std::string run() {
    std::vector<Value> values;
    for (const PortDefinition& port : link_->ports) {
      const auto it = parameters_.find(port.id);
      values.push_back(it != parameters_.end() ? it->second : port.default_value);
    }
    LinkReads reads;
    std::size_t nodes = 1;
    for (const LinkRead& read : link_->reads) {
      auto& row = reads.values.emplace_back();
      const bool is_given = !readings_[{read.end, name(read.path)}].empty();
      // A port that nobody speaks of: a node without it where it is optional, else its default.
      if (read.is_optional && !is_given && !locked_.contains({read.end, name(read.path), 0})) {
        row.assign(read.is_whole ? nodes : 1, nullptr);
        continue;
      }
      if (read.is_lock) {
        const std::size_t count = read.is_whole ? nodes : 1;
        for (std::size_t i = 0; i < count; ++i)
          row.push_back(&(locked_.contains({read.end, name(read.path), i}) ? truth_ : lie_));
        continue;
      }
      if (!is_given) row.assign(read.is_whole ? nodes : 1, &default_at(read.path));
      for (const Value& value : readings_[{read.end, name(read.path)}]) row.push_back(&value);
      if (read.is_whole) nodes = row.size();
    }
    writes_.values.clear();
    for (const LinkWrite& write : link_->proposes) writes_.values.emplace_back(write.is_whole ? nodes : 1);
    Memo memo;
    remarks_ = {};
    const auto done =
        link_->evaluate(link_->instantiate(values).get(), reads, writes_, Tick{.memo = &memo, .remarks = &remarks_});
    return done ? "" : done.error().text();
  }

  /// "" or what it remarked of one kind beside its proposals, place and all.
  std::string remarked(LinkRemark kind) { return remarks_.said && remarks_.kind == kind ? remarks_.said->text() : ""; }

  std::optional<Value> proposed(End end, const std::string& path, std::size_t node = 0) const {
    for (std::size_t w = 0; w < link_->proposes.size(); ++w)
      if (link_->proposes[w].end == end && name(link_->proposes[w].path) == path) return writes_.values[w][node];
    return std::nullopt;
  }
  double number(End end, const std::string& path, std::size_t node = 0) const {
    return as_number(proposed(end, path, node).value());
  }
  Vector3 move(End end) const { return std::get<Vector3>(proposed(end, "node.position").value()); }
  bool moves(End end) const { return proposed(end, "node.position").has_value(); }

 private:
  static std::string name(const PortPath& path) {
    return path.chosen_by.empty() ? path.typification + "." + path.port : path.chosen_by;
  }

  static const Value& default_at(const PortPath& path) {
    static const Value id = std::string("node");
    const auto port = full_registry().port(path);
    return port ? (*port)->default_value : id;
  }

  const LinkDefinition* link_;
  std::map<std::string, Value> parameters_;
  std::map<std::pair<End, std::string>, std::vector<Value>> readings_;
  LinkWrites writes_;
  LinkRemarks remarks_;
  std::set<std::tuple<End, std::string, std::size_t>> locked_;
  const Value truth_ = true, lie_ = false;
};

inline void expect_near(const Vector3& found, const Vector3& wanted, double tolerance = 1e-9) {
  EXPECT_NEAR(found.x, wanted.x, tolerance);
  EXPECT_NEAR(found.y, wanted.y, tolerance);
  EXPECT_NEAR(found.z, wanted.z, tolerance);
}

}  // namespace bl
