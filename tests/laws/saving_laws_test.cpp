// Laws of saving, over random scenes in which much goes wrong: a run that is saved and loaded at any tick is the run, and what is
// written is what was read.
#include <cmath>
#include <cstdlib>
#include <map>
#include <memory>
#include <regex>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/live/commands.h"
#include "tests/support/random_commands.h"
#include "tests/support/random_scenes.h"
#include "tests/support/world.h"

namespace bl {
namespace {

// BL_LAW_SCENES says otherwise.
std::uint64_t count_of_scenes(std::uint64_t usual) {
  const char* text = std::getenv("BL_LAW_SCENES");
  return text != nullptr ? std::strtoull(text, nullptr, 10) : usual;
}

std::string saved_text(const Session& session, const State& as) {
  const SavedState state = save(as);
  return write_scene(session.scene(), full_registry(), &state);
}

// What people do in that tick: the same for every run that has come to the same scene.
void act(World& world, std::uint64_t seed, int tick) {
  Random random(seed, static_cast<std::uint64_t>(tick));
  if (random.below(3) != 0) return;
  for (std::uint64_t k = 1 + random.below(2); k > 0; --k)
    (void)world.submit(random_command(world.session().scene(), random, 10 * tick + static_cast<int>(k)));
}

std::string first_difference(const State& a, const State& b) {
  const SavedState x = save(a), y = save(b);
  for (const auto& [node, values] : x.nodes)
    for (const auto& [path, value] : values) {
      const auto other = y.nodes.find(node);
      if (other == y.nodes.end() || !other->second.contains(path) || !(other->second.at(path) == value)) return node + " " + path;
    }
  if (x.nodes != y.nodes) return "the loaded run has more values";
  for (const auto& [name, error] : x.errors)
    if (!y.errors.contains(name)) return name.first + " " + name.second + " fails in the whole run alone";
  for (const auto& [name, error] : y.errors)
    if (!x.errors.contains(name)) return name.first + " " + name.second + " fails in the loaded run alone";
  for (const auto& [link, voices] : x.voices)
    if (!y.voices.contains(link) || y.voices.at(link).size() != voices.size()) return "voices of " + link;
  return "no value: voices, analyses or calm";
}

struct Told {
  std::size_t scenes = 0, ticks = 0, failing = 0, holding = 0;
};

// Does a link rest because what it reads is of the past?
bool has_link_that_holds(const State& state) {
  for (const LinkState& link : state.links)
    if (link.error && link.error->message.find("is out of date") != std::string::npos) return true;
  return false;
}

// A run that was saved at tick `k`, after or before what people did there, takes the ticks of the one that went through.
void expect_the_same_run(const std::string& saved, const std::vector<std::shared_ptr<const State>>& states, std::uint64_t seed,
                         std::size_t k, bool has_people, bool is_after_edits, Told& told) {
  const std::string what =
      "scene " + std::to_string(seed) + " saved at tick " + std::to_string(k) + (is_after_edits ? ", after its edits," : "");
  const SceneReading reading = read_scene(saved, full_registry());
  ASSERT_TRUE(reading.is_usable()) << what << ": " << reading.first_error().text();
  World loaded = World::from_text(saved);
  for (std::size_t t = k; t < states.size(); ++t) {
    const State& straight = *states[t];
    if (t > k || !is_after_edits) {
      ASSERT_EQ(loaded.state().hash, straight.hash)
          << what << " differs at tick " << t << ": " << first_difference(straight, loaded.state());
      ASSERT_EQ(loaded.state().is_settled(), straight.is_settled()) << "scene " << seed;
      if (has_people) act(loaded, seed, static_cast<int>(t));
    }
    if (t + 1 < states.size()) loaded.tick();
    ++told.ticks;
  }
}

void expect_that_saving_changes_nothing(const std::string& text, std::uint64_t seed, int ticks, bool has_people, Told& told) {
  World through = World::from_text(text);
  std::vector<std::string> saved, edited;
  std::vector<std::shared_ptr<const State>> states;
  bool is_failing = false, is_holding = false;
  for (int k = 0; k <= ticks; ++k) {
    saved.push_back(saved_text(through.session(), through.state()));
    states.push_back(through.session().state());
    is_failing = is_failing || has_failure(through.state());
    is_holding = is_holding || has_link_that_holds(through.state());
    if (has_people) act(through, seed, k);
    edited.push_back(saved_text(through.session(), *through.session().coming_state()));
    through.tick();
  }
  told.scenes += 1;
  told.failing += is_failing ? 1 : 0;
  told.holding += is_holding ? 1 : 0;
  for (std::size_t k = 0; k < states.size() && !testing::Test::HasFatalFailure(); ++k) {
    expect_the_same_run(saved[k], states, seed, k, has_people, false, told);
    if (edited[k] != saved[k]) expect_the_same_run(edited[k], states, seed, k, has_people, true, told);
  }
}

TEST(SavingLaws, SavedAndLoadedAtAnyTickARunWithErrorsIsTheSameRun) {
  Told told;
  for (std::uint64_t seed = 0; seed < count_of_scenes(60) && !HasFatalFailure(); ++seed)
    expect_that_saving_changes_nothing(random_scene(seed), seed, 7, seed % 2 == 1, told);
  RecordProperty("scenes", static_cast<int>(told.scenes));
  RecordProperty("ticks", static_cast<int>(told.ticks));
  // Where nothing fails the law says little.
  EXPECT_GE(2 * told.failing, told.scenes) << told.failing << " of " << told.scenes << " scenes fail somewhere";
  EXPECT_GE(20 * told.holding, told.scenes) << told.holding << " of " << told.scenes << " scenes have links that hold";
}

// The smallest ones that were found: set of a plot that is no volume, a control whose range is empty.
TEST(SavingLaws, ALinkThatReadsAFailingNodeGoesOnAsItWas) {
  Told told;
  for (const char* text : {R"({"format": "behaviourlinks", "version": 1, "nodes": [
         {"id": "a", "types": {"smart_volume": {}}}, {"id": "b", "types": {"smart_volume": {}}}, {"id": "other"},
         {"id": "plot", "types": {"plot": {"volumes": "other"}}}], "links": [
         {"id": "double", "kind": "ratio", "from": "a", "to": "b"},
         {"id": "rules", "kind": "plot_rules", "from": "plot", "to": {"typification": "smart_volume"}}]})",
                           R"({"format": "behaviourlinks", "version": 1, "nodes": [
         {"id": "lever", "types": {"control": {"maximum": 0}}}, {"id": "street", "types": {"street": {}}}], "links": [
         {"id": "close", "kind": "capacity_change", "from": "lever", "to": "street"}]})"})
    expect_that_saving_changes_nothing(text, 0, 12, false, told);
}

// Replaces every 0 of a text that stands for a number by another way to write nothing. Whole numbers take but the first.
std::string with_other_zeros(const std::string& text, Random& random, bool has_fractions) {
  static const char* kZeros[] = {"-0", "0", "-0.0", "0.0", "-0e3"};
  std::string out;
  bool is_in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i], next = i + 1 < text.size() ? text[i + 1] : ' ';
    if (c == '"' && (i == 0 || text[i - 1] != '\\')) is_in_string = !is_in_string;
    const std::string_view before = std::string_view(text).substr(0, i);
    const bool is_count = before.ends_with("\"calm\": ") || before.ends_with("\"tick\": ");
    const bool is_alone =
        !is_count && i > 0 && (text[i - 1] == '[' || text[i - 1] == ' ') && (next == ',' || next == ']' || next == '}');
    if (!is_in_string && c == '0' && is_alone) out += kZeros[random.below(has_fractions ? std::size(kZeros) : 2)];
    else out += c;
  }
  return out;
}

TEST(SavingLaws, WhatIsWrittenIsReadAndWrittenAgainByteForByte) {
  const std::regex negative_zero(R"([\[ :]-0(\.0*)?(e[0-9]+)?[,\]\}\s])");
  std::size_t other = 0, fractions = 0;
  for (std::uint64_t seed = 0; seed < count_of_scenes(200); ++seed) {
    World world = World::from_text(random_scene(seed));
    world.tick(static_cast<int>(seed % 4));
    const std::string text = saved_text(world.session(), world.state());
    Random random(seed, 17);
    std::string zeros = with_other_zeros(text, random, true);
    if (!read_scene(zeros, full_registry()).is_usable()) zeros = with_other_zeros(text, random, false);
    else fractions += zeros != text ? 1 : 0;
    if (!read_scene(zeros, full_registry()).is_usable()) zeros = text;  // corners of meshes are counted by plain numbers
    other += zeros != text ? 1 : 0;
    for (const std::string& variant : {text, zeros}) {
      const SceneReading reading = read_scene(variant, full_registry());
      ASSERT_TRUE(reading.is_usable()) << "scene " << seed << ": " << reading.first_error().text();
      const std::string once = write_scene(reading.scene, full_registry(), reading.state ? &*reading.state : nullptr);
      ASSERT_FALSE(std::regex_search(once, negative_zero)) << "scene " << seed;
      const SceneReading again = read_scene(once, full_registry());
      ASSERT_TRUE(again.is_usable()) << "scene " << seed << ": " << again.first_error().text();
      ASSERT_EQ(write_scene(again.scene, full_registry(), again.state ? &*again.state : nullptr), once) << "scene " << seed;
      ASSERT_EQ(World::from_text(variant).state().hash, world.state().hash) << "scene " << seed;
    }
  }
  EXPECT_GT(other, 10u) << "few of the scenes hold a zero";
  EXPECT_GT(fractions, 10u) << "few of the scenes hold a zero that may be written as a fraction";
}

// A sign of nothing in a scene, a log or a command is gone before anybody could say it.
TEST(SavingLaws, ZeroHasNoSignInSentencesAndAfterAReplay) {
  const std::string text = R"({"format": "behaviourlinks", "version": 1, "nodes": [
    {"id": "s", "types": {"sensor": {"has_range": true, "highest": -0.0, "reading": 725685799317088.0, "reading_tick": 0}}},
    {"id": "a", "position": [-0.0, 15, 8]}], "links": []})";
  World world = World::from_text(text), positive = World::from_text(std::regex_replace(text, std::regex("-0\\.0"), "0"));
  for (World* each : {&world, &positive}) each->tick();
  EXPECT_EQ(world.state().hash, positive.state().hash);
  EXPECT_EQ(world.text("s", "sensor.message"), positive.text("s", "sensor.message"));
  EXPECT_EQ(world.text("s", "sensor.message").find("-0"), std::string::npos) << world.text("s", "sensor.message");
  ASSERT_EQ(world.submit(command<live::Receive>({"s", -0.0, "", "", 1})), "");
  EXPECT_EQ(log_line(world.session().log().back(), full_registry()).find("-0"), std::string::npos);
  world.tick();
  EXPECT_FALSE(std::signbit(world.number("s", "sensor.reading")));
}

}  // namespace
}  // namespace bl
