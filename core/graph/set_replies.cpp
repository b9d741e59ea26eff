// Replies of sets: who has a port that several write to, and what stays of a solver that fails.
#include "core/graph/set_replies.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/graph/phases.h"

namespace bl {

namespace {

bool has_rivals(const SetDependents& dependents, const std::vector<Reply>& replies) {
  std::vector<bool> is_written(dependents.groups_writing.keys());
  for (const Reply& reply : replies) {
    const std::size_t port = dependents.port_index(reply.target);
    if (is_written[port]) return true;
    is_written[port] = true;
  }
  return false;
}

bool is_negative_zero(double number) { return number == 0 && std::signbit(number); }

}  // namespace

void ReplyWriter::write(PortRef target, Value&& value) {
  if (now_ == nullptr || target.node != at_.node || target.type != at_.type) {
    now_ = &next_.nodes[target.node].types[target.type];
    own_ = nullptr;
  }
  at_ = target;
  if (now_->values[target.port] == value) return;
  if (own_ == nullptr) now_ = own_ = &next_.edit(target.node, target.type);
  if (const auto* number = std::get_if<double>(&value)) own_->values[target.port] = *number;
  else own_->values[target.port] = std::move(value);
  next_.state.due.replied.push_back(target);
}

void write_replies(StateDraft& next, std::vector<Reply>& replies) {
  if (replies.empty()) return;
  const Plan& plan = *next.state.plan;
  if (!has_rivals(*plan.dependents->sets, replies)) {
    ReplyWriter writer(next);
    for (Reply& reply : replies) writer.write(reply.target, std::move(reply.value));
    return;
  }
  std::vector<std::size_t> order(replies.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return replies[a].target != replies[b].target ? replies[a].target < replies[b].target : a < b;
  });
  std::vector<std::pair<std::size_t, std::size_t>> late;  // replies that came too late, and those before them
  ReplyWriter writer(next);
  for (std::size_t first = 0, at = 0; at < order.size(); ++at) {
    Reply& reply = replies[order[at]];
    if (at > 0 && reply.target == replies[order[first]].target) {
      late.emplace_back(order[at], order[first]);
      continue;
    }
    first = at;
    writer.write(reply.target, std::move(reply.value));
  }
  std::sort(late.begin(), late.end());
  for (const auto& [at, before] : late) {
    const Reply& reply = replies[at];
    next.edit(reply.node, reply.type).error =
        Error{ErrorCode::conflict, place_of(plan, reply.node, reply.type),
              "`" + plan.nodes[reply.target.node].id + "` already belongs to `" + plan.nodes[replies[before].node].id +
                  "`; a node can be a member of one such set only"};
  }
}

void keep_shapes(StateDraft& next, const SetGroup& group) {
  for (const SetPlan& plan : sets_of(*next.state.plan, group))
    for (const PortRef& ref : plan.writes) {
      const auto* mesh = std::get_if<MeshPointer>(&next.value(ref));
      if (mesh == nullptr || !*mesh || mesh->has_recipe()) continue;
      const bool is_plain = std::none_of((*mesh)->vertices.begin(), (*mesh)->vertices.end(), [](const Point3& p) {
        return is_negative_zero(p.x) || is_negative_zero(p.y) || is_negative_zero(p.z);
      });
      if (is_plain) continue;
      auto plain = std::make_shared<Mesh>(**mesh);
      for (Point3& vertex : plain->vertices) vertex += Point3{0, 0, 0};  // -0 + 0 is 0
      next.edit(ref) = MeshPointer(std::move(plain));
      next.state.due.replied.push_back(ref);
    }
}

}  // namespace bl
