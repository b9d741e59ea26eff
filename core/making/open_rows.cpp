// Looks through programmes, uses and the exclusions of a site; uses are the same in small and in large letters.
#include "core/making/open_rows.h"

#include <algorithm>
#include <set>

#include "core/base/text.h"
#include "core/geometry/domain_table.h"
#include "core/making/named_list.h"

namespace bl::making {

namespace {

constexpr const char* kUsualOpenUse = "garden";

// The uses of all rows of programmes, in their order.
std::vector<std::string> asked_uses(const Scene& scene, const Registry& registry) {
  std::vector<std::string> uses;
  const TypificationDefinition* type = registry.typification("programme");
  for (const auto& [id, node] : scene.nodes) {
    if (type == nullptr || !node.types.contains("programme")) continue;
    const auto rows = std::get<Shared<Table>>(set_value(scene, node, *type, *type->find_port("rows")));
    for (std::size_t row = 0; row < rows->rows.size(); ++row) uses.push_back(rows->text(row, "use"));
  }
  return uses;
}

// In small letters.
std::set<std::string> uses_said_open(const Scene& scene, const Registry& registry) {
  std::set<std::string> open;
  const TypificationDefinition* type = registry.typification("use");
  for (const auto& [id, node] : scene.nodes)
    if (type != nullptr && node.types.contains("use") &&
        std::get<bool>(set_value(scene, node, *type, *type->find_port("is_open"))))
      open.insert(lower_case(std::get<std::string>(set_value(scene, node, *type, *type->find_port("use")))));
  return open;
}

std::string spelled_as(const std::vector<std::string>& uses, const std::string& wanted) {
  const auto found =
      std::find_if(uses.begin(), uses.end(), [&](const std::string& use) { return lower_case(use) == lower_case(wanted); });
  return found == uses.end() ? "" : *found;
}

// `Garden` and `Garden 2` are laid for `Garden`.
bool is_name_of_laid(const std::string& name, const std::string& use) {
  if (!name.starts_with(use)) return false;
  const std::string more = name.substr(use.size());
  return more.empty() || (more.size() > 1 && more[0] == ' ' && more.find_first_not_of("0123456789", 1) == std::string::npos);
}

}  // namespace

OpenRow open_row_for(const Scene& scene, const Registry& registry, const std::string& wanted) {
  const std::vector<std::string> asked = asked_uses(scene, registry);
  const std::set<std::string> said_open = uses_said_open(scene, registry);
  std::vector<std::string> open, small;
  for (const std::string& use : asked)
    if (said_open.contains(lower_case(use))) open.push_back(use), small.push_back(lower_case(use));
  if (wanted.empty() && open.size() == 1)
    return {open.front(), "Its ground counts for `" + open.front() + "`, the only open space that the programme asks for."};
  const std::string use = wanted.empty() ? kUsualOpenUse : wanted;
  if (const std::string row = spelled_as(asked, use); !row.empty()) return {row, ""};
  if (open.empty()) return {use, ""};
  const std::string near = nearest_name(lower_case(use), small);
  const std::string meant = near.empty() ? ": it asks for " + named_list(open) + ". Name one of them by --use"
                                         : ", did you mean `" + spelled_as(open, near) + "`?";
  return {use, "Warning: no row of the programme asks for `" + use + "`" + meant + (near.empty() ? "." : "")};
}

std::string laid_by_new(const Scene& scene, const Site& site, const std::string& use, const std::vector<Point3>& corners) {
  std::string name;
  double most = -1;
  for (const geometry::NamedRing& ring : geometry::read_rings(site.rows)) {
    const std::string& of = site.rows.text(ring.first_row, "use");
    // A garden that was added has the name of its node.
    if (lower_case(of) != lower_case(use) || !is_name_of_laid(ring.name, of) || scene.nodes.contains(ring.name)) continue;
    const double common = area_on({ring.corners}, {&corners});
    if (common > most) name = ring.name, most = common;
  }
  return name;
}

}  // namespace bl::making
