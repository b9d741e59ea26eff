// Scripts as link kinds: what a declaration becomes, evaluations by hand, and what scripts can and cannot reach.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <thread>
#include <utility>
#include <vector>

#include "core/base/mathematics.h"
#include "core/base/random.h"
#include "core/base/text.h"
#include "core/define/typification_builder.h"
#include "core/script/link_script.h"
#include "tests/links/link_case.h"

namespace bl::script {
namespace {

constexpr const char* kRatio = R"lua(
return {
  id = "my_ratio",
  label = "My ratio",
  doc = "Asks that a volume is a multiple of another one.",
  params = {
    {id = "ratio", default = 1, unit = "ratio", min = 0, soft_min = 0, soft_max = 4, doc = "The multiple."},
  },
  reads = {volume = {at = "from", port = "smart_volume.volume", unit = "m3"}},
  proposes = {demand = {at = "to", port = "smart_volume.demand", unit = "m3"}},
  evaluate = function(params, ends, tick)
    return {demand = params.ratio * ends.volume}
  end,
}
)lua";

LinkDefinition kind_of(const std::string& text) {
  auto kind = read_link_script("case", text, full_registry());
  if (!kind) {
    std::cerr << kind.error().text() << "\n";
    std::abort();
  }
  return std::move(*kind);
}

// A script that moves the first end's node by what `body` returns: an expression over params, ends and tick, or statements.
std::string mover(const std::string& body) {
  return "return {id = 'mover', doc = 'Moves.', params = {{id = 'p', default = 2, doc = 'A number.'}},\n"
         "reads = {here = {at = 'from', port = 'node.position', unit = 'm'}, id = {at = 'from', port = 'node.id'}},\n"
         "proposes = {move = {at = 'from', port = 'node.position', unit = 'm'}},\n"
         "evaluate = function(params, ends, tick)\n" +
         body + "\nend}\n";
}

// "" or the error of one evaluation; the move of x comes back in `x`.
std::string run_mover(const std::string& body, double* x = nullptr) {
  auto kind = read_link_script("case", mover(body), full_registry());
  if (!kind) return kind.error().text();
  LinkCase link(*kind);
  const std::string error = link.from("node.position", Vector3{1, 2, 3}).from("node.id", std::string("tower")).run();
  if (error.empty() && x != nullptr) *x = link.move(End::from).x;
  return error;
}

double number_of(const std::string& expression) {
  double x = 0;
  const std::string error = run_mover("return {move = point(" + expression + ", 0, 0)}", &x);
  EXPECT_EQ(error, "") << expression;
  return x;
}

// Lua's own `^` and functions call the C library, whose last bits follow the processor.
TEST(LinkScript, MathematicsAreThoseOfTheDoor) {
  using namespace mathematics;
  EXPECT_EQ(number_of("2^3^2"), 512);
  EXPECT_EQ(number_of("-2^2"), -4);
  EXPECT_EQ(number_of("2^-2^2"), 0.0625);
  EXPECT_EQ(number_of("(#'a' + 2) ^ (#\"bc\") + 2^#{1, 2, 3}"), 17);
  EXPECT_EQ(number_of("3 ^ math.floor(2.5) ^ 1"), 9);
  EXPECT_EQ(number_of("(function() return 3 end)() ^ 2"), 9);
  Random random(5);
  for (int i = 0; i < 20; ++i) {
    const double a = random.uniform(0.1, 0.9), b = random.uniform(-3, 3);
    const std::string x = shortest(a), y = "(" + shortest(b) + ")";
    EXPECT_EQ(number_of(x + "^" + y), power(a, b)) << "constants, which Lua computes while it reads";
    EXPECT_EQ(number_of("(" + x + " * params.p)^" + y), power(2 * a, b));
    EXPECT_EQ(number_of("params.p^" + y + "^params.p"), power(2, b * b));
    const std::pair<const char*, double (*)(double)> functions[] = {
        {"sin", sine},        {"cos", cosine},       {"tan", tangent},     {"asin", arc_sine},
        {"acos", arc_cosine}, {"atan", arc_tangent}, {"exp", exponential}, {"log", logarithm}};
    for (const auto& [name, function] : functions)
      EXPECT_EQ(number_of("math." + std::string(name) + "(" + x + ")"), function(a)) << name;
    EXPECT_EQ(number_of("math.atan(" + y + ", " + x + ")"), arc_tangent(b, a));
    EXPECT_EQ(number_of("math.log(" + x + ", 2)"), logarithm_of_two(a));
    EXPECT_EQ(number_of("math.log(" + x + ", 10)"), logarithm_of_ten(a));
    EXPECT_EQ(number_of("math.log(" + x + ", 3)"), logarithm(a) / logarithm(3));
  }
}

TEST(LinkScript, PowersOfWhatIsNoNumberSayTheirLine) {
  EXPECT_EQ(run_mover("local x = 1\nreturn {move = point(x ^ missing, 0, 0)}"),
            "case.lua:6: `^` needs numbers on both sides; one is nil, a name that holds nothing");
  EXPECT_EQ(run_mover("return {move = point(ends.here ^ 2, 0, 0)}"),
            "case.lua:5: `^` needs numbers on both sides; one is a table");
  EXPECT_EQ(run_mover("return {move = point('2' ^ 2, 0, 0)}"), "case.lua:5: `^` needs numbers on both sides; one is a string");
}

// Only the sign itself is touched: not in texts and comments of any kind, whatever stands in them.
TEST(LinkScript, PowersAreFoundOutsideOfTextsAndComments) {
  EXPECT_EQ(number_of("#'a^b'"), 3);
  EXPECT_EQ(number_of("#'\\'^' + (#\"\\\\\") ^ 2"), 3);
  EXPECT_EQ(number_of("#'\\z\n  ^' + 2^1"), 3);
  EXPECT_EQ(number_of("#'a\\\n^' + 2^1"), 5);
  EXPECT_EQ(number_of("#[[a^]] + #[==[^]]^]==] --[[ 2^'\n]] + 2^2"), 10);
  EXPECT_EQ(number_of("1 --^ 'a\n + 2 ^ 3 --[==[ ^]] ^\n]==] + 1"), 10);
  const std::string taken = run_mover("local power__of__numbers = 1 return {}");
  EXPECT_EQ(taken, "case.lua:5: the name `power__of__numbers` is taken by the library; take another");
}

TEST(LinkScript, AByteOrderMarkIsPassedOver) {
  const auto kind = read_link_script("case", std::string("\xEF\xBB\xBF") + kRatio, full_registry());
  ASSERT_TRUE(kind.ok()) << kind.error().text();
  EXPECT_EQ(kind->id, "my_ratio");
}

TEST(LinkScript, DeclaresAsTheSameKindInCode) {
  const LinkDefinition script = kind_of(kRatio), &code = *full_registry().link("ratio");
  EXPECT_EQ(script.id, "my_ratio");
  EXPECT_EQ(script.label, "My ratio");
  ASSERT_EQ(script.ports.size(), 1u);
  EXPECT_EQ(script.ports[0].id, code.ports[0].id);
  EXPECT_EQ(script.ports[0].unit, code.ports[0].unit);
  EXPECT_EQ(script.ports[0].default_value, code.ports[0].default_value);
  EXPECT_EQ(script.ports[0].hard_minimum, code.ports[0].hard_minimum);
  EXPECT_EQ(script.ports[0].soft_maximum, code.ports[0].soft_maximum);
  ASSERT_EQ(script.reads.size(), 1u);
  EXPECT_EQ(script.reads[0].path.port, "volume");
  EXPECT_EQ(script.reads[0].kind, ValueKind::number);
  EXPECT_EQ(script.reads[0].unit, Unit::cubic_metre);
  ASSERT_EQ(script.proposes.size(), 1u);
  EXPECT_EQ(script.proposes[0].end, End::to);
}

TEST(LinkScript, IsTheMultipleByHand) {
  const LinkDefinition kind = kind_of(kRatio);
  LinkCase link(kind);
  ASSERT_EQ(link.set("ratio", 0.25).from("smart_volume.volume", 8000.0).run(), "");
  EXPECT_EQ(link.number(End::to, "smart_volume.demand"), 2000);
}

TEST(LinkScript, PointsHaveArithmetic) {
  double x = 0;
  ASSERT_EQ(run_mover("local there = point(4, 6, 3)\nlocal way = there - ends.here\n"
                      "return {move = 2 * way / way:length() + point(way:dot(way), 0, 0) * 1 - -point()}",
                      &x),
            "");
  EXPECT_DOUBLE_EQ(x, 2 * 3 / 5.0 + 25);
}

TEST(LinkScript, EmptyAnswerProposesNothing) {
  const LinkDefinition kind = kind_of(mover("return {}"));
  LinkCase link(kind);
  ASSERT_EQ(link.from("node.position", Vector3{}).from("node.id", std::string("a")).run(), "");
  EXPECT_FALSE(link.moves(End::from));
}

TEST(LinkScript, WholeEndsAreLists) {
  const LinkDefinition kind = kind_of(
      "return {id = 'share', doc = 'Shares.', params = {{id = 'total', default = 100, doc = 'Sum.'}},\n"
      "reads = {demands = {at = 'to', port = 'smart_volume.demand', unit = 'm3', whole = true}},\n"
      "proposes = {limits = {at = 'to', port = 'smart_volume.demand_limit', unit = 'm3', whole = true}},\n"
      "evaluate = function(params, ends)\n local sum = 0\n for _, demand in ipairs(ends.demands) do sum = sum + demand end\n"
      " local limits = {}\n for i, demand in ipairs(ends.demands) do limits[i] = demand > 0 and params.total * demand / sum end\n"
      " return {limits = limits}\nend}");
  LinkCase link(kind);
  ASSERT_EQ(link.read(End::to, "smart_volume.demand", {10.0, 0.0, 30.0}).run(), "");
  EXPECT_EQ(link.number(End::to, "smart_volume.demand_limit", 0), 25);
  EXPECT_FALSE(link.proposed(End::to, "smart_volume.demand_limit", 1).has_value());
  EXPECT_EQ(link.number(End::to, "smart_volume.demand_limit", 2), 75);
}

struct Party {
  static constexpr std::string_view kMadeName = "a party";
};

struct Guest {
  struct In {
    std::vector<std::string> friends;
    Numbers ages;
  };
  struct Out {
    double count = 0;
  };
  static void declare(TypificationBuilder<Guest>& t) {
    t.id("guest").label("Guest").doc("Somebody with friends.");
    t.in(&In::friends, "friends").collect().doc("Names.");
    t.in(&In::ages, "ages").doc("How old they are.");
    t.out(&Out::count, "count").doc("How many.");
    t.made("party", {"count"}, &party_of).doc("All together.");
  }
  static std::shared_ptr<const Party> party_of(const double&) { return nullptr; }
};

TEST(LinkScript, ListsOfNumbersAreReadAndMadeObjectsAreNot) {
  Registry types = full_registry();
  types.add(TypificationBuilder<Guest>::build());
  auto text = [](const std::string& port) {
    return "return {id = 'ages', doc = 'x', reads = {ages = {at = 'from', port = 'guest." + port +
           "'}},\n"
           "proposes = {move = {at = 'to', port = 'node.position', unit = 'm'}},\n"
           "evaluate = function(p, ends) return {move = point(#ends.ages, ends.ages[2], 0)} end}";
  };
  const auto kind = read_link_script("case", text("ages"), types);
  ASSERT_TRUE(kind.ok()) << kind.error().text();
  LinkCase link(*kind);
  ASSERT_EQ(link.from("guest.ages", Numbers({7, 42.5, 3})).run(), "");
  expect_near(link.move(End::to), {3, 42.5, 0});
  const auto refused = read_link_script("case", text("party"), types);
  ASSERT_FALSE(refused.ok());
  EXPECT_TRUE(refused.error().message.ends_with("`ages`: scripts cannot read a made object")) << refused.error().text();
}

TEST(LinkScript, ListsOfTextsAreCollected) {
  Registry types = full_registry();
  types.add(TypificationBuilder<Guest>::build());
  auto text = [](const std::string& answer) {
    return "return {id = 'friends', doc = 'x', reads = {id = {at = 'from', port = 'node.id'}},\n"
           "proposes = {friends = {at = 'to', port = 'guest.friends'}},\nevaluate = function(p, ends) return {friends = " +
           answer + "} end}";
  };
  const auto kind = read_link_script("case", text("{ends.id, 'b'}"), types);
  ASSERT_TRUE(kind.ok()) << kind.error().text();
  LinkCase link(*kind);
  ASSERT_EQ(link.from("node.id", std::string("a")).run(), "");
  const auto friends = link.proposed(End::to, "guest.friends");
  ASSERT_TRUE(friends.has_value());
  EXPECT_EQ(*std::get<Shared<std::vector<std::string>>>(*friends), (std::vector<std::string>{"a", "b"}));
  for (const char* wrong : {"3", "{1, 2}", "{'\\xff'}"}) {
    const auto other = read_link_script("case", text(wrong), types);
    ASSERT_TRUE(other.ok()) << other.error().text();
    LinkCase bad(*other);
    EXPECT_TRUE(bad.from("node.id", std::string("a")).run().starts_with("case.lua:3: ")) << wrong;
  }
}

TEST(LinkScript, ParametersOfEveryKind) {
  const LinkDefinition kind = kind_of(
      "return {id = 'kinds', doc = 'Kinds.', params = {\n"
      "{id = 'flag', default = true, doc = 'A switch.'}, {id = 'whole', kind = 'integer', default = 3, doc = 'A count.'},\n"
      "{id = 'word', default = 'x', doc = 'A text.'}, {id = 'place', default = {x = 1, y = 2, z = 3}, unit = 'm', doc = 'A "
      "place.'},\n"
      "{id = 'mode', default = 'up', choices = {{id = 'up', doc = 'Up.'}, {id = 'down', doc = 'Down.'}}, doc = 'Where to.'},\n"
      "{id = 'source', kind = 'port', doc = 'What is read.'}},\n"
      "reads = {value = {at = 'from', chosen_by = 'source'}},\n"
      "proposes = {move = {at = 'to', port = 'node.position', unit = 'm'}},\n"
      "evaluate = function(p, ends) assert(p.flag and p.whole == 3 and p.word == 'x' and p.mode == 'up')\n"
      "return {move = p.place * ends.value} end}");
  ASSERT_EQ(kind.ports.size(), 6u);
  EXPECT_EQ(kind.ports[0].kind, ValueKind::boolean);
  EXPECT_EQ(kind.ports[1].kind, ValueKind::integer);
  EXPECT_EQ(kind.ports[2].kind, ValueKind::text);
  EXPECT_EQ(kind.ports[3].kind, ValueKind::point);
  EXPECT_EQ(kind.ports[4].kind, ValueKind::choice);
  EXPECT_EQ(kind.ports[5].kind, ValueKind::port);
  LinkCase link(kind);
  ASSERT_EQ(link.from("source", 2.0).run(), "");
  expect_near(link.move(End::to), {2, 4, 6});
}

TEST(LinkScript, LibraryByHand) {
  EXPECT_EQ(number_of("math.max(3, math.floor(7.9), 5)"), 7);
  EXPECT_EQ(number_of("#(('abc'):upper() .. string.sub('defg', 2, 3))"), 5);
  EXPECT_EQ(number_of("tonumber(string.format('%.1f', 2.25)) + select('#', table.unpack({1, 2, 3}))"), 5.2);
  EXPECT_EQ(number_of("(function() local t = {5, 2, 9} table.sort(t) table.insert(t, 1, 7) table.remove(t, 2) return t[1] * 100 "
                      "+ t[2] * 10 + t[3] end)()"),
            759);
  EXPECT_EQ(number_of("(function() local t = {5, 2, 9} table.sort(t, function(a, b) return a > b end) return "
                      "tonumber(table.concat(t)) end)()"),
            952);
  EXPECT_EQ(
      number_of(
          "(function() local n = 0 for k, v in pairs({b = 2, a = 1, c = 3, [1] = 4}) do n = n * 10 + v end return n end)()"),
      4123);
}

TEST(LinkScript, RandomFollowsFromItsArgumentsAlone) {
  const double a = number_of("random(ends.id, 1)"), b = number_of("random(ends.id, 2)");
  EXPECT_EQ(a, number_of("random(ends.id, 1)"));
  EXPECT_NE(a, b);
  EXPECT_GE(a, 0);
  EXPECT_LT(a, 1);
}

// The globals, what a text keeps outside its functions, and the library start anew in each evaluation.
TEST(LinkScript, NothingIsKeptBetweenEvaluations) {
  // Outside variables, globals of the text, and neither: these are kept from lasting in different ways.
  for (const std::string& text :
       {"function seen() count = (count or 0) + 1 return count end\n" + mover("return {move = point(1, seen(), 0)}"),
        mover("count = (count or 0) + 1 return {move = point(1, count, 0)}")}) {
    const LinkDefinition other = kind_of(text);
    LinkCase link(other);
    link.from("node.position", Vector3{}).from("node.id", std::string("a"));
    for (int i = 0; i < 3; ++i) {
      ASSERT_EQ(link.run(), "");
      expect_near(link.move(End::from), {1, 1, 0});
    }
  }
  const LinkDefinition kind = kind_of("local outside = 0\n" + mover("outside = outside + 1 count = (count or 0) + 1\n"
                                                                    "return {move = point(outside, count, 0)}"));
  LinkCase link(kind);
  link.from("node.position", Vector3{}).from("node.id", std::string("a"));
  for (int i = 0; i < 3; ++i) {
    ASSERT_EQ(link.run(), "");
    expect_near(link.move(End::from), {1, 1, 0});
  }
  EXPECT_NE(run_mover("math.pi = 3 return {}"), "");
  EXPECT_NE(run_mover("string.len = nil return {}"), "");
}

// Threads that evaluate one kind at once get the bits that one alone gets, runaways among them.
TEST(LinkScript, ThreadsDoNotMeet) {
  const LinkDefinition kind = kind_of("local function double(x) return 2 * x end\n" +
                                      mover("if ends.id == 'bad' then while true do end end\n"
                                            "return {move = ends.here * double(random(ends.id, ends.here.x))}"));
  auto walk = [&kind](int thread) {
    Hash hash;
    for (int i = 0; i < 200; ++i) {
      LinkCase link(kind);
      const bool is_bad = i % 50 == thread;
      const std::string said =
          link.from("node.position", Vector3{double(i), 1, 2}).from("node.id", std::string(is_bad ? "bad" : "good")).run();
      EXPECT_EQ(said.empty(), !is_bad) << said;
      if (said.empty() && i % 50 > 4) hash.add(link.move(End::from));
    }
    return hash.value();
  };
  const std::uint64_t alone = walk(0);
  std::array<std::uint64_t, 4> together{};
  std::vector<std::thread> threads;
  for (int k = 0; k < 4; ++k) threads.emplace_back([&, k] { together[static_cast<std::size_t>(k)] = walk(k); });
  for (std::thread& thread : threads) thread.join();
  for (const std::uint64_t hash : together) EXPECT_EQ(hash, alone);
}

TEST(LinkScript, WhatIsDangerousIsNotThere) {
  for (const char* name :
       {"io",           "os",           "package",         "debug",       "load",       "loadstring",     "loadfile",
        "dofile",       "require",      "coroutine",       "pcall",       "xpcall",     "collectgarbage", "print",
        "setmetatable", "getmetatable", "rawset",          "rawget",      "rawequal",   "next",           "_G",
        "string.find",  "string.match", "string.gmatch",   "string.gsub", "string.rep", "string.dump",    "string.pack",
        "table.move",   "math.random",  "math.randomseed", "('x').find",  "('x').rep"})
    EXPECT_EQ(number_of(std::string(name) + " == nil and 1 or 0"), 1) << name;
}

}  // namespace
}  // namespace bl::script
