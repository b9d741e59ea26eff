// Names and links are those of the plan: where the plan's are the same, only values can have changed.
#include "core/reading/figures_memo.h"

#include "core/reading/changed_nodes.h"

namespace bl::reading {

void FiguresMemo::read_all(const State& state) {
  targets_ = brief_targets(*state.plan);
  changed_ = std::nullopt;
  model_ = {};
  read_figures(state, model_);
}

// False where more than single volumes may have changed.
bool FiguresMemo::follow(const State& state, const Brief& brief) {
  const auto nodes = state_ ? changed_nodes(*state_, state) : std::nullopt;
  // Whether a volume is asked for floor area depends on which uses briefs name.
  if (!nodes || !has_same_uses(brief, brief_)) return false;
  changed_.emplace();
  for (VolumeAccount& account : accounts_of_volumes(state, *nodes, targets_, brief)) {
    const std::size_t row = model_.accounts.row_of(account.node);
    changed_->push_back(account.node);
    static_cast<VolumeAccount&>(model_.volumes[row]) = account;
    model_.accounts.volumes[row] = std::move(account);
  }
  if (changed_->empty() && brief == brief_ && open_accounts(state) == model_.accounts.open) return true;
  add_up(state, brief, model_.accounts);
  add_totals(state, model_);
  return true;
}

const ReportModel& FiguresMemo::of(const std::shared_ptr<const State>& state) {
  if (state == state_) return model_;
  Brief brief = brief_of(*state);
  if (!follow(*state, brief)) read_all(*state);
  brief_ = std::move(brief);
  state_ = state;
  return model_;
}

}  // namespace bl::reading
