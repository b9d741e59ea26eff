// Laws of views: what they show exists, is of the kind and unit that they say, and every view is known to these laws.
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "core/reading/view.h"

namespace bl {
namespace {

using reading::ViewDefinition;
using reading::ViewRead;

const TypeDefinition* type_of(const ViewDefinition& view, const std::string& id) {
  const Registry& registry = full_registry();
  if (view.is_of_links) return registry.link(id);
  return registry.typification(id);
}

void check_read(const ViewDefinition& view, const ViewRead& read) {
  const std::string path = read.path.typification + "." + read.path.port, where = "the view " + view.name + " shows " + path;
  const TypeDefinition* type = type_of(view, read.path.typification);
  ASSERT_NE(type, nullptr) << where << ", and there is no such type";
  const PortDefinition* port = type->find_port(read.path.port);
  ASSERT_NE(port, nullptr) << where << ", and there is no such port";
  EXPECT_EQ(type->id, read.path.typification) << where << ", which is an old name of the type";
  if (read.is_tension) {
    EXPECT_NE(port->rule, CombineRule::none) << where << " disagreeing, and nobody proposes to it";
  } else {
    EXPECT_TRUE(can_read(read.kind, port->kind))
        << where << " as a " << name_of(read.kind) << ", and it holds a " << name_of(port->kind);
  }
  const bool has_unit = port->unit_from.empty() && port->unit != Unit::none && port->unit != Unit::count;
  if (!has_unit || (read.kind != ValueKind::number && read.kind != ValueKind::integer)) return;
  ASSERT_TRUE(read.unit.has_value()) << where << " without saying its unit";
  EXPECT_TRUE(same_dimension(*read.unit, port->unit)) << where << " in another unit";
}

TEST(ViewLaws, ViewsShowPortsThatExistWithTheKindAndUnitTheySay) {
  ASSERT_FALSE(reading::all_views().empty());
  for (const ViewDefinition* view : reading::all_views()) {
    EXPECT_NE(type_of(*view, view->type), nullptr)
        << "the view " << view->name << " is of " << view->type << ", which is no type";
    EXPECT_FALSE(view->reads.empty()) << view->name;
    for (const ViewRead& read : view->reads) {
      EXPECT_TRUE(read.path.typification == view->type || (!view->is_of_links && read.path.typification == kBaseNode))
          << "the view " << view->name << " is of " << view->type << ", and shows " << read.path.typification;
      check_read(*view, read);
    }
  }
}

TEST(ViewLaws, NoMemberShowsTwoPorts) {
  for (const ViewDefinition* view : reading::all_views())
    for (std::size_t a = 0; a < view->reads.size(); ++a)
      for (std::size_t b = 0; b < a; ++b)
        EXPECT_NE(view->reads[a].member, view->reads[b].member) << view->name << " " << view->reads[a].path.port;
}

TEST(ViewLaws, EveryViewOfTheSourcesIsKnown) {
  std::size_t declared = 0;
  for (const auto& file : std::filesystem::directory_iterator(std::filesystem::path(BL_SOURCE_DIR) / "core/reading/views")) {
    if (file.path().extension() != ".cpp") continue;
    std::ifstream source(file.path());
    for (std::string line; std::getline(source, line);) declared += line.starts_with("BL_VIEW(") ? 1 : 0;
  }
  EXPECT_EQ(declared, reading::all_views().size()) << "a view is missing in the BL_VIEWS of its file";
}

}  // namespace
}  // namespace bl
