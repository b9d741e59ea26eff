// Limits of addresses, and what a proxy says of those it asks for, without a network.
#include "core/serve/gate.h"

#include <vector>

#include <gtest/gtest.h>

namespace bl::serve {
namespace {

constexpr GateLimits kFew{.half_open = 2, .connections = 4, .patience = 5, .failures = 3, .failures_per_second = 1};

TEST(Gate, LetsFewBeginAtATimeAndTheOthersWait) {
  Gate gate(kFew);
  std::vector<int> begun;
  std::vector<std::unique_ptr<Gate::Pass>> passes;
  for (int k = 0; k < 4; ++k) {
    passes.push_back(gate.enter("a"));
    ASSERT_NE(passes.back(), nullptr);
    passes.back()->begin([&begun, k] { begun.push_back(k); }, 0);
  }
  EXPECT_EQ(gate.enter("a"), nullptr) << "a fifth";
  EXPECT_NE(gate.enter("b"), nullptr) << "another address";
  EXPECT_EQ(begun, (std::vector{0, 1}));
  gate.turn(1);
  EXPECT_EQ(begun.size(), 2u);
  passes[0]->open();
  gate.turn(1);
  EXPECT_EQ(begun, (std::vector{0, 1, 2}));
  passes[1].reset();
  gate.turn(1);
  EXPECT_EQ(begun, (std::vector{0, 1, 2, 3}));
  EXPECT_NE(gate.enter("a"), nullptr) << "one has left";
}

TEST(Gate, SendsAwayWhoHasWaitedTooLong) {
  Gate gate(kFew);
  const auto one = gate.enter("a"), two = gate.enter("a");
  auto late = gate.enter("a");
  one->begin([] {}, 0);
  two->begin([] {}, 0);
  // As a connection does: what waits holds the pass itself.
  auto life = std::make_shared<int>(1);
  const std::weak_ptr<int> watch = life;
  late->begin([held = std::shared_ptr(std::move(late)), life = std::exchange(life, nullptr)] { FAIL(); }, 0);
  gate.turn(4);
  EXPECT_FALSE(watch.expired());
  gate.turn(6);
  EXPECT_TRUE(watch.expired());
}

TEST(Gate, MayGoBeforeThoseWhoWait) {
  std::unique_ptr<Gate::Pass> left;
  {
    Gate gate(kFew);
    std::vector<std::unique_ptr<Gate::Pass>> passes;
    for (int k = 0; k < 3; ++k) passes.push_back(gate.enter("a"));
    for (auto& pass : passes) pass->begin([] {}, 0);
    passes[2]->begin([held = std::shared_ptr(gate.enter("a"))] {}, 0);
    left = std::move(passes[0]);
  }
  left.reset();
}

TEST(Gate, TriesNothingMoreAfterManyFailures) {
  Gate gate(kFew);
  for (int k = 0; k < 3; ++k) {
    EXPECT_TRUE(gate.may_try("a", 0));
    gate.note_failure("a", 0);
  }
  EXPECT_FALSE(gate.may_try("a", 0.5));
  EXPECT_TRUE(gate.may_try("b", 0.5));
  gate.turn(0.5);
  EXPECT_FALSE(gate.may_try("a", 0.6)) << "it is not forgotten with the connections";
  EXPECT_TRUE(gate.may_try("a", 1.5));
}

TEST(Gate, CountsWhomTheProxyAsksFor) {
  Gate gate(kFew);
  std::vector<std::unique_ptr<Gate::Pass>> passes;
  for (int k = 0; k < 20; ++k) {
    passes.push_back(gate.enter("proxy", true));
    ASSERT_NE(passes.back(), nullptr);
    EXPECT_EQ(passes.back()->move_to("a"), k < 4) << k;
  }
  passes.clear();
  EXPECT_TRUE(gate.enter("proxy", true)->move_to("a"));
}

TEST(AskedBy, TakesWhatTheProxyHasSeenItself) {
  const Asking direct{"10.0.0.1", "here:8080", "http"};
  const auto all = asked_by(direct, {.address = "6.6.6.6, 192.0.2.7", .host = "rooms.example.org", .scheme = "https"});
  EXPECT_EQ(all.address, "192.0.2.7") << "what stands before is what anybody may have sent";
  EXPECT_EQ(all.host, "rooms.example.org");
  EXPECT_EQ(all.scheme, "https");
  const auto none = asked_by(direct, {});
  EXPECT_EQ(none.address + none.host + none.scheme, "10.0.0.1here:8080http");
  const auto odd = asked_by(direct, {.address = "unknown", .host = "a b", .scheme = "gopher"});
  EXPECT_EQ(odd.address + odd.host + odd.scheme, "10.0.0.1here:8080http");
}

TEST(Origin, IsOwnByHostAndWhereKnownByProtocol) {
  EXPECT_TRUE(is_own_origin("http://here:8080", "here:8080", ""));
  EXPECT_TRUE(is_own_origin("https://here", "here", "https"));
  EXPECT_FALSE(is_own_origin("http://here", "here", "https"));
  EXPECT_FALSE(is_own_origin("http://elsewhere", "here", ""));
  EXPECT_FALSE(is_own_origin("null", "", ""));
  EXPECT_FALSE(is_own_origin("http://", "", ""));
}

TEST(Codes, AreTriedByShortPaths) {
  EXPECT_TRUE(tries_a_code("/BKRT"));
  EXPECT_TRUE(tries_a_code("/bkrt?x"));
  EXPECT_FALSE(tries_a_code("/qr"));
  EXPECT_FALSE(tries_a_code("/favicon.ico"));
  EXPECT_FALSE(tries_a_code("/a.ico"));
}

}  // namespace
}  // namespace bl::serve
