// Laws that every registered typification, link kind and command keeps, without anybody writing a test for it.
#include <filesystem>
#include <functional>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/define/codec.h"
#include "tests/support/place/source_folder.h"
#include "tests/support/random_values.h"
#include "tests/support/world.h"

namespace bl {
namespace {

void for_each_type(const std::function<void(const TypeDefinition&)>& look) {
  for (const auto& [id, type] : full_registry().typifications()) look(type);
  for (const auto& [id, type] : full_registry().links()) look(type);
  for (const auto& [id, type] : full_registry().commands()) look(type);
}

bool ends_a_sentence(const std::string& text) { return text.size() > 3 && (text.back() == '.' || text.back() == ')'); }

TEST(TypeLaws, ThereIsSomethingToCheck) {
  EXPECT_GE(full_registry().typifications().size(), 8u);
  EXPECT_GE(full_registry().links().size(), 12u);
  EXPECT_GE(full_registry().commands().size(), 15u);
}

TEST(TypeLaws, EveryTypeAndPortIsDocumented) {
  for_each_type([](const TypeDefinition& type) {
    EXPECT_TRUE(is_identifier(type.id)) << type.id;
    EXPECT_FALSE(type.label.empty()) << type.id;
    EXPECT_TRUE(ends_a_sentence(type.doc)) << type.id << ": " << type.doc;
    for (const PortDefinition& port : type.ports) {
      EXPECT_TRUE(is_identifier(port.id)) << type.id << "." << port.id;
      EXPECT_TRUE(ends_a_sentence(port.doc)) << type.id << "." << port.id << ": " << port.doc;
      for (const ChoiceDefinition& choice : port.choices)
        EXPECT_TRUE(ends_a_sentence(choice.doc)) << type.id << "." << port.id << "=" << choice.id;
      for (const ColumnDefinition& column : port.columns)
        EXPECT_TRUE(ends_a_sentence(column.doc)) << type.id << "." << port.id << "/" << column.id;
    }
  });
}

TEST(TypeLaws, PortIdsAreUniqueAndSettingsComeFirst) {
  for_each_type([](const TypeDefinition& type) {
    std::set<std::string> ids;
    bool is_computed = false;
    for (const PortDefinition& port : type.ports) {
      EXPECT_TRUE(ids.insert(port.id).second) << type.id << "." << port.id;
      EXPECT_TRUE(port.is_computed || !is_computed) << type.id << "." << port.id << " is a setting behind a result";
      is_computed = port.is_computed;
      if (!port.unit_from.empty()) { EXPECT_NE(type.find_port(port.unit_from), nullptr) << type.id << "." << port.id; }
    }
  });
}

TEST(TypeLaws, WhatHoldsForTheSceneIsASettingOfTheSameKindAndUnit) {
  for_each_type([](const TypeDefinition& type) {
    for (const PortDefinition& port : type.ports) {
      if (port.of_scene == OfScene::no) continue;
      const PortDefinition* setting = settings_type().find_port(port.id);
      ASSERT_NE(setting, nullptr) << type.id << "." << port.id;
      // Who may follow the scene has to see whether it says something.
      EXPECT_EQ(port.keeps_default, port.of_scene == OfScene::unless_set) << type.id << "." << port.id;
      EXPECT_EQ(setting->keeps_default, port.keeps_default) << type.id << "." << port.id;
      if (port.of_scene != OfScene::always) continue;
      EXPECT_EQ(name_of(setting->kind), name_of(port.kind)) << type.id << "." << port.id;
      EXPECT_EQ(info(setting->unit).name, info(port.unit).name) << type.id << "." << port.id;
      EXPECT_EQ(setting->default_value, port.default_value) << type.id << "." << port.id;
      EXPECT_TRUE(!port.is_computed && port.rule == CombineRule::none) << type.id << "." << port.id;
    }
  });
}

TEST(TypeLaws, DefaultsAndSoftRangesLieInsideHardRanges) {
  for_each_type([](const TypeDefinition& type) {
    for (const PortDefinition& port : type.ports) {
      if (!port.is_required) {
        const auto good = check_value(port, port.default_value, type.id + "." + port.id);
        EXPECT_TRUE(good.ok()) << good.error().text();
      }
      EXPECT_LE(port.soft_minimum.value_or(port.hard_minimum), port.soft_maximum.value_or(port.hard_maximum))
          << type.id << "." << port.id;
      if (port.soft_minimum) { EXPECT_GE(*port.soft_minimum, port.hard_minimum) << type.id << "." << port.id; }
      if (port.soft_maximum) { EXPECT_LE(*port.soft_maximum, port.hard_maximum) << type.id << "." << port.id; }
      if (port.rule != CombineRule::none) { EXPECT_TRUE(is_proposable(port.kind)) << type.id << "." << port.id; }
      if (port.rule == CombineRule::collect) {
        EXPECT_EQ(name_of(port.kind), name_of(ValueKind::texts)) << type.id << "." << port.id;
      }
    }
  });
}

// Who draws one curve for each type draws that of the traced port; rows have no room for meshes.
TEST(TypeLaws, WhatIsShownFirstFitsIntoARowAndOnePortIsTraced) {
  std::size_t shown = 0;
  for (const auto& [id, type] : full_registry().typifications()) {
    std::size_t traced = 0;
    for (const PortDefinition& port : type.ports) {
      shown += port.is_shown_first ? 1 : 0;
      traced += port.is_traced ? 1 : 0;
      if (port.is_shown_first) {
        EXPECT_TRUE(port.kind != ValueKind::mesh && port.kind != ValueKind::json) << id << "." << port.id;
      }
    }
    EXPECT_LE(traced, 1u) << id;
  }
  EXPECT_GT(shown, 0u);
}

// The window tells kinds apart by their families, and drawings by the inks of these: `other` is for kinds that nobody here
// declares.
TEST(TypeLaws, EveryLinkKindDeclaresItsFamily) {
  for (const auto& [id, kind] : full_registry().links())
    EXPECT_TRUE(kind.family != LinkFamily::other) << id << " declares no family: say `l.family(...)`";
}

TEST(TypeLaws, LinksReadAndProposePortsThatExistWithTheUnitTheyExpect) {
  for (const auto& [id, kind] : full_registry().links()) {
    auto check = [&, name = id](const PortPath& path, ValueKind expected, const MadeType& made, const std::optional<Unit>& unit,
                                bool is_proposal) {
      if (!path.chosen_by.empty()) {
        ASSERT_NE(kind.find_port(path.chosen_by), nullptr) << name << " " << path.chosen_by;
        EXPECT_EQ(name_of(kind.find_port(path.chosen_by)->kind), name_of(ValueKind::port)) << name << " " << path.chosen_by;
        return;
      }
      if (path.typification == kBaseNode && path.port == "id") return;
      const auto port = full_registry().port(path);
      ASSERT_TRUE(port.ok()) << name << ": " << port.error().text();
      // What people chose is a word.
      const bool is_word = !is_proposal && (*port)->kind == ValueKind::choice && expected == ValueKind::text;
      const std::string place = path.typification + "." + path.port;
      EXPECT_TRUE(((*port)->kind == expected && (*port)->made == made) || is_word)
          << name << (is_proposal ? " gives " : " takes ") << kind_text(expected, made) << ", but " << place << " holds "
          << kind_text((*port)->kind, (*port)->made);
      EXPECT_FALSE(is_proposal && (*port)->rule == CombineRule::none)
          << name << " proposes to " << place << ", which has no combine rule: links cannot change it";
      // Numbers without a fixed unit at the port may be read as they are; all others must be named with their unit.
      if ((*port)->unit_from.empty() && (*port)->unit != Unit::none && expected == ValueKind::number) {
        ASSERT_TRUE(unit.has_value()) << name << " does not say in which unit it takes " << place;
        EXPECT_TRUE(same_dimension(*unit, (*port)->unit))
            << name << " takes " << place << " in " << info(*unit).name << ", but it is in " << info((*port)->unit).name;
      }
    };
    for (const LinkRead& read : kind.reads) {
      if (!read.is_lock) {
        check(read.path, read.kind, read.made, read.unit, false);
        continue;
      }
      const auto port = full_registry().port(read.path);
      EXPECT_TRUE(port.ok() && !(*port)->is_computed && read.kind == ValueKind::boolean) << id << " " << read.path.port;
    }
    for (const LinkWrite& write : kind.proposes) check(write.path, write.kind, {}, write.unit, true);
    EXPECT_FALSE(kind.proposes.empty()) << id;
  }
}

TEST(TypeLaws, SetsReadAndWritePortsThatExist) {
  for (const auto& [id, type] : full_registry().typifications())
    for (const SetDefinition& set : type.sets) {
      ASSERT_NE(type.find_port(set.selection), nullptr) << id;
      EXPECT_EQ(name_of(type.find_port(set.selection)->kind), name_of(ValueKind::selection)) << id << "." << set.selection;
      for (const ReadDefinition& read : set.reads)
        if (read.path.chosen_by.empty() && read.path.port != "id") {
          EXPECT_TRUE(full_registry().port(read.path).ok()) << id << " " << read.path.port;
        }
      for (const WriteDefinition& write : set.writes) {
        const auto port = full_registry().port(write.path);
        ASSERT_TRUE(port.ok()) << id << " " << write.path.port;
        EXPECT_TRUE((*port)->is_computed) << id << " writes a setting of its members: " << write.path.port;
        EXPECT_EQ(name_of((*port)->kind), name_of(write.kind)) << id << " " << write.path.port;
      }
    }
}

TEST(TypeLaws, ValuesSurviveJson) {
  for_each_type([](const TypeDefinition& type) {
    Random random(7, Hash::mix(type.ports.size()));
    for (const PortDefinition& port : type.ports) {
      if (is_derived(port.kind) || port.kind == ValueKind::commands) continue;  // no value of a node, or a law of its own
      for (int i = 0; i < 50; ++i) {
        const Value value = random_value(port, random);
        const std::string text = write_json(value_to_json(value, port));
        const auto json = parse_json(text);
        ASSERT_TRUE(json.ok()) << text;
        const auto back = value_from_json(port, *json, port.id);
        ASSERT_TRUE(back.ok()) << type.id << "." << port.id << ": " << back.error().text() << " " << text;
        EXPECT_TRUE(*back == value) << type.id << "." << port.id << ": " << text;
      }
    }
  });
}

// The values of a typification after an evaluation, or its error; nothing else may come out.
Result<std::vector<Value>> evaluate(const TypificationDefinition& type, std::vector<Value> values) {
  std::vector<SetValues> sets(type.sets.size());
  if (auto done = type.evaluate(values, sets, Tick{1, nullptr}); !done) return done.error();
  return values;
}

TEST(TypeLaws, TypificationsEvaluateRandomInputToFiniteValuesOrAnError) {
  for (const auto& [id, type] : full_registry().typifications()) {
    if (!type.evaluate) continue;
    Random random(11, id.size());
    for (int i = 0; i < 300; ++i) {
      std::vector<Value> values;
      for (const PortDefinition& port : type.ports)
        values.push_back(port.is_computed || i == 0 ? port.default_value : random_value(port, random));
      const auto first = evaluate(type, values), second = evaluate(type, values);
      ASSERT_EQ(first.ok(), second.ok()) << id;
      if (!first) {
        EXPECT_TRUE(first.error() == second.error()) << id << ": " << first.error().text() << ", then " << second.error().text();
        EXPECT_GT(first.error().message.size(), 10u) << id;
        EXPECT_FALSE(first.error().code == ErrorCode::internal) << id << ": " << first.error().text();
        continue;
      }
      for (std::size_t p = 0; p < type.ports.size(); ++p) {
        EXPECT_TRUE(is_finite((*first)[p])) << id << "." << type.ports[p].id;
        if (!is_derived(type.ports[p].kind)) {
          EXPECT_TRUE((*first)[p] == (*second)[p]) << id << "." << type.ports[p].id << " differs between two evaluations";
        }
      }
    }
  }
}

// One evaluation of a link kind on random ends of `count` nodes where an end is whole.
struct LinkTrial {
  LinkReads reads;
  LinkWrites writes;
  std::vector<Value> storage;
};

TEST(TypeLaws, LinksEvaluateRandomInputToFiniteProposalsOrAnError) {
  for (const auto& [id, kind] : full_registry().links()) {
    Random random(13, id.size());
    for (int i = 0; i < 300; ++i) {
      std::vector<Value> parameters;
      for (const PortDefinition& port : kind.ports)
        parameters.push_back(i < 20 ? port.default_value : random_value(port, random));
      const auto in = kind.instantiate(parameters);
      LinkTrial trial;
      trial.storage.reserve(kind.reads.size() * 3);
      for (const LinkRead& read : kind.reads) {
        auto& values = trial.reads.values.emplace_back();
        if (read.is_optional && i % 2 == 0) {
          values.assign(read.is_whole ? 3 : 1, nullptr);  // nodes that lack the role
          continue;
        }
        for (int k = 0; k < (read.is_whole ? 3 : 1); ++k) {
          PortDefinition port;
          port.kind = read.kind;
          if (read.path.chosen_by.empty() && !read.is_lock)
            if (const auto found = full_registry().port(read.path)) port = **found;
          trial.storage.push_back(random_value(port, random));
          values.push_back(&trial.storage.back());
        }
      }
      auto run = [&]() -> std::optional<Error> {
        trial.writes.values.clear();
        for (const LinkWrite& write : kind.proposes) trial.writes.values.emplace_back(write.is_whole ? 3 : 1);
        const auto done = kind.evaluate(in.get(), trial.reads, trial.writes, Tick{1, nullptr});
        return done ? std::nullopt : std::optional(done.error());
      };
      const auto first = run();
      const auto proposals = trial.writes.values;
      EXPECT_TRUE(run() == first) << id << " ends otherwise when it is evaluated again"
                                  << (first ? ", not: " + first->text() : "");
      EXPECT_TRUE(trial.writes.values == proposals) << id << " differs between two evaluations";
      if (first) {
        EXPECT_GT(first->message.size(), 10u) << id;
        EXPECT_FALSE(first->code == ErrorCode::internal) << id << ": " << first->text();
        continue;
      }
      for (const auto& values : proposals)
        for (const auto& value : values)
          if (value) { EXPECT_TRUE(is_finite(*value)) << id; }
    }
  }
}

TEST(TypeLaws, EveryNodeAndLinkTypeHasASourceASceneAndATestOfItsStem) {
  const std::filesystem::path root(test::source_folder());
  auto check = [&](const std::string& folder, const std::string& id) {
    EXPECT_TRUE(exists(root / folder / (id + ".cpp"))) << folder << "/" << id;
    EXPECT_TRUE(exists(root / "scenes" / folder / (id + ".json"))) << folder << "/" << id;
    EXPECT_TRUE(exists(root / "tests" / folder / (id + "_test.cpp"))) << folder << "/" << id;
  };
  for (const auto& [id, type] : full_registry().typifications())
    if (id != kBaseNode) check("nodes", id);
  for (const auto& [id, kind] : full_registry().links()) check("links", id);
}

}  // namespace
}  // namespace bl
