// The keys that things have in the views of the plan and of the shapes: the same in both.
#pragma once

#include <set>
#include <string>

namespace bl::wire {

/// Several things may have one name, as the parts of a street: the second becomes `street/High Street#2`. Both views ask in the
/// same order, so that they give the same names.
class PlanKeys {
 public:
  std::string key(const std::string& kind, const std::string& name) {
    std::string key = kind + "/" + name;
    for (int n = 2; !given_.insert(key).second; ++n) key = kind + "/" + name + "#" + std::to_string(n);
    return key;
  }

 private:
  std::set<std::string> given_;
};

}  // namespace bl::wire
