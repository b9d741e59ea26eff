// Who takes how much sun from a receiver, as shares. Works with any table of named columns, as moment_table does.
#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <vector>

namespace bl::sun {

/// What each of `ids` takes, as a share of what the worst one of the table takes, be that one of them or not; 0 for who is not in
/// it.
template <class Table>
std::vector<double> loss_shares(const Table& losses, const std::vector<std::string>& ids) {
  std::map<std::string, double> taken;
  double most = 0;
  for (std::size_t row = 0; row < losses.rows.size(); ++row) {
    const double loss = losses.number(row, "shared");
    most = std::max(most, loss);
    taken[losses.text(row, "node")] = std::max(0.0, loss);
  }
  std::vector<double> shares;
  for (const std::string& id : ids) {
    const auto found = taken.find(id);
    shares.push_back(found != taken.end() && most > 0 ? found->second / most : 0);
  }
  return shares;
}

}  // namespace bl::sun
