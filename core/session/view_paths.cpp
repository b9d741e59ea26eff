// One walk along both views; keys are looked up in sorted maps, because an ordered object is searched from its beginning.
#include "core/session/view_paths.h"

#include <map>
#include <span>
#include <string_view>

#include <nlohmann/json.hpp>

#include "core/graph/touch.h"

namespace bl {

namespace {

using Members = std::map<std::string_view, const Json*>;

Members members_of(const Json* value) {
  Members members;
  if (value != nullptr && value->is_object())
    for (const auto& [key, content] : value->get_ref<const Json::object_t&>()) members.emplace(key, &content);
  return members;
}

std::string plain(std::string_view step) {
  std::string text;
  for (std::size_t i = 0; i < step.size(); ++i) {
    const bool is_escape = step[i] == '~' && i + 1 < step.size();
    text += is_escape ? (step[++i] == '1' ? '/' : '~') : step[i];
  }
  return text;
}

// What is not there counts as an object without content: so the view is written.
bool is_branch(const Json* value) { return value == nullptr || value->is_object(); }

void collect(const Json* before, const Json* after, const Json* changes, const std::string& path,
             std::vector<std::string>& paths) {
  if (!is_branch(before) || !is_branch(after)) {
    const bool is_same = before != nullptr && after != nullptr && *before == *after;
    if (!is_same) paths.push_back(path);
    return;
  }
  const Members old = members_of(before), fresh = members_of(after);
  const auto look = [&](std::string_view key, const Json* change) {
    const auto o = old.find(key), f = fresh.find(key);
    const std::string inner = path.empty() ? step_of(key) : path + "/" + step_of(key);
    collect(o == old.end() ? nullptr : o->second, f == fresh.end() ? nullptr : f->second, change, inner, paths);
  };
  if (changes != nullptr && changes->is_object()) {
    for (const auto& [key, change] : members_of(changes)) look(key, change);
    return;
  }
  Members all = old;
  all.insert(fresh.begin(), fresh.end());
  for (const auto& [key, content] : all) look(key, nullptr);
}

// The paths are ascending, so that those with the same first step follow each other.
Json patch_of(const Json* wanted, std::span<const std::string_view> paths) {
  const Members members = members_of(wanted);
  Json patch = Json::object();
  for (std::size_t i = 0; i < paths.size();) {
    const std::string_view step = paths[i].substr(0, paths[i].find('/'));
    const auto found = members.find(plain(step));
    const Json* content = found == members.end() ? nullptr : found->second;
    if (step.size() == paths[i].size()) {
      append_field(patch, plain(step)) = content == nullptr ? Json() : *content;
      ++i;
      continue;
    }
    std::vector<std::string_view> inner;
    for (; i < paths.size() && paths[i].substr(0, paths[i].find('/')) == step; ++i)
      inner.push_back(paths[i].substr(step.size() + 1));
    append_field(patch, plain(step)) = patch_of(content, inner);
  }
  return patch;
}

}  // namespace

std::vector<std::string> view_differences(const Json& before, const Json& after, const Json* changes) {
  std::vector<std::string> paths;
  collect(&before, &after, changes, "", paths);
  if (paths.empty()) paths.emplace_back();
  return paths;
}

Json patch_at(const Json& wanted, const std::set<std::string>& paths) {
  const std::vector<std::string_view> steps(paths.begin(), paths.end());
  return patch_of(&wanted, steps);
}

}  // namespace bl
