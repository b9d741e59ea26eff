// The world behind the tests: a session with look-ups by name.
#include "tests/support/world.h"

#include <cstdio>
#include <cstdlib>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/define/codec.h"
#include "core/file/file_io.h"
#include "tests/support/place/source_folder.h"

namespace bl {

namespace {

[[noreturn]] void give_up(const std::string& why) {
  std::fprintf(stderr, "test world: %s\n", why.c_str());
  std::abort();
}

PortRef find(const State& state, std::string_view node, std::string_view path) {
  const std::uint32_t index = state.plan->node_index(node);
  if (index == state.plan->nodes.size()) give_up("no node " + std::string(node));
  const auto parsed = parse_port_path(path);
  const auto ref = parsed ? state.plan->find(index, *parsed) : std::nullopt;
  if (!ref) give_up("no port " + std::string(path) + " on " + std::string(node));
  return *ref;
}

}  // namespace

const Value& value_in(const State& state, std::string_view node, std::string_view path) {
  return state.value(find(state, node, path));
}

std::string project_file(std::string_view path_from_root) {
  auto text = read_file(test::source_folder() + "/" + std::string(path_from_root));
  if (!text) give_up(text.error().text());
  return *text;
}

Command batch_of_text(const std::string& list) {
  Json json = {{"command", "batch"}};
  auto commands = parse_json(list);
  EXPECT_TRUE(commands.ok()) << list;
  if (commands) json["arguments"]["commands"] = std::move(*commands);
  auto command = command_from_json(full_registry(), json, "");
  EXPECT_TRUE(command.ok()) << command.error().text();
  return command ? *command : Command();
}

World World::from_text(std::string_view scene_json, int threads) {
  const SceneReading reading = read_scene(scene_json, full_registry());
  if (!reading.is_usable()) give_up(reading.first_error().text());
  World world;
  auto session = Session::start(full_registry(), reading.scene, reading.state ? &*reading.state : nullptr, threads);
  if (!session) give_up(session.error().text());
  world.session_ = std::move(*session);
  return world;
}

World World::from_file(std::string_view path_from_root, int threads) { return from_text(project_file(path_from_root), threads); }

void World::tick(int count) {
  for (int i = 0; i < count; ++i) session_->tick();
}

bool World::settle(int most) {
  for (int i = 0; i < most && !state().is_settled(); ++i) session_->tick();
  return state().is_settled();
}

double World::number(std::string_view node, std::string_view path) const { return as_number(value_in(state(), node, path)); }
Vector3 World::point(std::string_view node, std::string_view path) const {
  return std::get<Vector3>(value_in(state(), node, path));
}
std::string World::text(std::string_view node, std::string_view path) const {
  return std::get<std::string>(value_in(state(), node, path));
}
const Table& World::table(std::string_view node, std::string_view path) const {
  return *std::get<Shared<Table>>(value_in(state(), node, path));
}
MeshPointer World::mesh(std::string_view node, std::string_view path) const {
  return std::get<MeshPointer>(value_in(state(), node, path));
}

double World::tension(std::string_view node, std::string_view path) const {
  const PortRef ref = find(state(), node, path);
  return state().nodes[ref.node].types[ref.type].tension[ref.port];
}

std::string World::node_error(std::string_view node, std::string_view typification) const {
  const std::uint32_t index = state().plan->node_index(node);
  if (index == state().plan->nodes.size()) give_up("no node " + std::string(node));
  for (std::size_t t = 0; t < state().nodes[index].types.size(); ++t)
    if (state().plan->nodes[index].types[t].definition->id == typification) {
      const auto& error = state().nodes[index].types[t].error;
      return error ? error->text() : "";
    }
  give_up("the node " + std::string(node) + " is no " + std::string(typification));
}

std::string World::link_error(std::string_view id) const {
  for (std::size_t l = 0; l < state().links.size(); ++l)
    if (state().plan->links[l].id == id) return state().links[l].error ? state().links[l].error->text() : "";
  give_up("no link " + std::string(id));
}

std::string World::submit(const Command& command, const std::string& author) {
  const auto done = session_->submit(command, author);
  return done ? "" : done.error().text();
}

}  // namespace bl
