// Laws of views: what they show exists, is of the kind and unit that they say, and every view is known to these laws.
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "core/reading/view.h"
#include "core/reading/views/volume.h"
#include "tests/support/place/source_folder.h"

namespace bl {
namespace {

using reading::ViewDefinition;
using reading::ViewRead;

const TypeDefinition* find_type(const reading::ViewDefinition& view, const std::string& id) {
  const Registry& registry = full_registry();
  if (view.is_of_links) return registry.link(id);
  return registry.typification(id);
}

// What is wrong with one read, as a sentence; empty where nothing is.
std::string fault_of(const reading::ViewDefinition& view, const reading::ViewRead& read) {
  const std::string where = "the view " + view.name + " shows " + read.path.typification + "." + read.path.port;
  if (read.path.typification != view.type && (view.is_of_links || read.path.typification != kBaseNode))
    return where + ", and is of " + view.type;
  const TypeDefinition* type = find_type(view, read.path.typification);
  if (type == nullptr || type->id != read.path.typification) return where + ", and there is no such type";
  const PortDefinition* port = type->find_port(read.path.port);
  if (port == nullptr) return where + ", and there is no such port";
  if (read.is_tension) return port->rule == CombineRule::none ? where + " disagreeing, and nobody proposes to it" : "";
  if (!can_read(read.kind, port->kind) || read.made != port->made)
    return where + " as " + std::string(name_of(read.kind)) + ", and it holds " + std::string(name_of(port->kind));
  const bool has_unit = port->unit_from.empty() && port->unit != Unit::none && port->unit != Unit::count;
  const bool is_quantity = read.kind == ValueKind::number || read.kind == ValueKind::integer || read.kind == ValueKind::point;
  if (!has_unit || !is_quantity) return "";
  if (!read.unit) return where + " without saying its unit";
  return same_dimension(*read.unit, port->unit) ? "" : where + " in another unit";
}

TEST(ViewLaws, ViewsShowPortsThatExistWithTheKindAndUnitTheySay) {
  ASSERT_FALSE(reading::all_views().empty());
  for (const reading::ViewDefinition* view : reading::all_views()) {
    EXPECT_NE(find_type(*view, view->type), nullptr)
        << "the view " << view->name << " is of " << view->type << ", which is no type";
    EXPECT_FALSE(view->reads.empty()) << view->name;
    for (const reading::ViewRead& read : view->reads) EXPECT_EQ(fault_of(*view, read), "");
  }
}

// The law finds what it is there for.
TEST(ViewLaws, ARenamedPortIsToldWithItsView) {
  const auto fault = [](const auto& change) {
    reading::ViewDefinition view = reading::VolumeFigures::view();
    reading::ViewRead& read = view.reads[reading::read_index(view, reading::key_of_member(&reading::VolumeFigures::volume))];
    change(read);
    return fault_of(view, read);
  };
  EXPECT_EQ(fault([](reading::ViewRead&) {}), "");
  EXPECT_EQ(fault([](reading::ViewRead& read) { read.path.port = "volumes"; }),
            "the view VolumeFigures shows smart_volume.volumes, and there is no such port");
  EXPECT_EQ(fault([](reading::ViewRead& read) { read.kind = ValueKind::text; }),
            "the view VolumeFigures shows smart_volume.volume as a text, and it holds a number");
  EXPECT_EQ(fault([](reading::ViewRead& read) { read.unit = Unit::metre; }),
            "the view VolumeFigures shows smart_volume.volume in another unit");
  EXPECT_EQ(fault([](reading::ViewRead& read) { read.unit.reset(); }),
            "the view VolumeFigures shows smart_volume.volume without saying its unit");
  EXPECT_EQ(fault([](reading::ViewRead& read) { read.path.typification = "plot"; }),
            "the view VolumeFigures shows plot.volume, and is of smart_volume");
}

TEST(ViewLaws, NoMemberShowsTwoPorts) {
  for (const reading::ViewDefinition* view : reading::all_views())
    for (std::size_t a = 0; a < view->reads.size(); ++a)
      for (std::size_t b = 0; b < a; ++b)
        EXPECT_NE(view->reads[a].member, view->reads[b].member) << view->name << " " << view->reads[a].path.port;
}

TEST(ViewLaws, EveryViewOfTheSourcesIsKnown) {
  std::size_t declared = 0;
  for (const auto& file :
       std::filesystem::directory_iterator(std::filesystem::path(test::source_folder()) / "core/reading/views")) {
    if (file.path().extension() != ".cpp") continue;
    std::ifstream source(file.path());
    for (std::string line; std::getline(source, line);) declared += line.starts_with("BL_VIEW(") ? 1 : 0;
  }
  EXPECT_EQ(declared, reading::all_views().size()) << "a view is missing in the BL_VIEWS of its file";
}

}  // namespace
}  // namespace bl
