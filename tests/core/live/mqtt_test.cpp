// MQTT against a real broker on the loopback: readings, noise, a broker that goes and returns, actuators, replay.
#include "tests/core/live/live_support.h"

namespace bl::live {
namespace {

using test::Broker;
using test::eventually;
using test::Folder;
using test::LiveWorld;
using test::Program;
using test::sensor;

TEST(Mqtt, ReadingsBecomeStateAndAReplayNeedsNoBroker) {
  Broker broker;
  broker.start();
  LiveWorld live(sensor("warmth", broker.address("site/warmth"), R"(, "field": "/now/0", "scale": 2, "offset": 1)") + "," +
                 sensor("noise", broker.address("site/noise"), R"(, "smoothing": 10, "tick_length": 1)"));
  ASSERT_TRUE(live.hears(broker, "site/warmth", R"({"now": [20.5]})", [&] { return live.quality("warmth") == "good"; }));
  EXPECT_EQ(live.number("warmth"), 42);
  EXPECT_EQ(live.quality("noise"), "never");
  ASSERT_TRUE(live.hears(broker, "site/noise", "40", [&] { return live.quality("noise") == "good"; }));
  for (const char* level : {"50", "60", "55"}) {
    const std::int64_t before = live.status("noise").traffic.received;
    broker.publish("site/noise", level);
    ASSERT_TRUE(live.steps_until([&] { return live.status("noise").traffic.received > before; }));
    live.step();
  }
  EXPECT_GT(live.number("noise"), 40);
  EXPECT_LT(live.number("noise"), 60);
  EXPECT_EQ(live.text("warmth", "sensor.connection"), "");
  EXPECT_EQ(live.replayed(1), live.hash());
  EXPECT_EQ(live.replayed(2), live.hash());
}

TEST(Mqtt, NoiseIsInvalidAndTheLastGoodValueStays) {
  Broker broker;
  broker.start();
  LiveWorld live(sensor("s", broker.address("t"), R"(, "has_range": true, "highest": 50, "timeout": 0)"));
  ASSERT_TRUE(live.hears(broker, "t", "21.5", [&] { return live.quality("s") == "good"; }));
  const auto sends = [&](const std::string& text, const std::string& sentence) {
    broker.publish("t", text);
    EXPECT_TRUE(live.steps_until([&] { return live.says("s", sentence); })) << sentence << " | " << live.message("s");
    EXPECT_EQ(live.quality("s"), "invalid");
    EXPECT_EQ(live.number("s"), 21.5);
  };
  sends("warm", "`warm` is no number");
  sends(std::string("\x00\xff\x01", 3), "the message is binary, no text");
  sends(std::string(300000, '7'), "the message has 300000 bytes");
  sends("51", "the reading 51 lies outside 0 to 50");
  broker.publish("t", "22");
  EXPECT_TRUE(live.steps_until([&] { return live.quality("s") == "good"; }));
  EXPECT_EQ(live.number("s"), 22);
  EXPECT_EQ(live.replayed(2), live.hash());
}

TEST(Mqtt, ABrokerThatGoesAndReturns) {
  Broker broker;
  LiveWorld live(sensor("s", broker.address("t"), R"(, "timeout": 0)"));
  ASSERT_TRUE(live.steps_until([&] { return live.says("s", "refuses the connection: nothing listens there"); }))
      << live.message("s");
  EXPECT_EQ(live.quality("s"), "never");
  broker.start();
  ASSERT_TRUE(live.hears(broker, "t", "1", [&] { return live.quality("s") == "good"; }));
  EXPECT_EQ(live.message("s"), "");
  broker.stop();
  ASSERT_TRUE(live.steps_until([&] { return !live.message("s").empty(); }));
  // The value is as good as it was; only its age goes on.
  EXPECT_EQ(live.quality("s"), "good");
  EXPECT_EQ(live.number("s"), 1);
  broker.start();
  ASSERT_TRUE(live.hears(broker, "t", "2", [&] { return live.number("s") == 2; }));
  EXPECT_TRUE(live.steps_until([&] { return live.message("s").empty(); }));
  EXPECT_EQ(live.replayed(1), live.hash());
}

TEST(Mqtt, ConnectionsFollowTheScene) {
  Broker broker;
  broker.start();
  LiveWorld live(sensor("s", broker.address("one")));
  ASSERT_TRUE(live.hears(broker, "one", "1", [&] { return live.number("s") == 1; }));
  ASSERT_EQ(live.world().submit(command<SetPort>({"s", {"sensor.address"}, {"\"" + broker.address("two") + "\""}})), "");
  ASSERT_TRUE(live.hears(broker, "two", "2", [&] { return live.number("s") == 2; }));
  broker.publish("one", "1");
  ASSERT_EQ(live.world().submit(command<RemoveNode>({"s"})), "");
  live.step();
  EXPECT_EQ(live.status("s").node, "");
}

TEST(Mqtt, AnEditOfOneSensorLosesNoMessageOfTheOthers) {
  Broker broker;
  broker.start();
  LiveWorld live(sensor("a", broker.address("one")) + "," + sensor("b", broker.address("two")));
  ASSERT_TRUE(live.hears(broker, "two", "1", [&] { return live.number("b") == 1; }));
  ASSERT_TRUE(live.hears_last(broker, "one", "a", -1));
  const std::int64_t before = live.status("a").traffic.received;
  constexpr int kEdits = 10;
  for (int i = 0; i < kEdits; ++i) {
    ASSERT_EQ(live.world().submit(command<SetPort>({"b", {"sensor.field"}, {"\"f" + std::to_string(i) + "\""}})), "");
    live.step();
    broker.publish("one", std::to_string(i));
  }
  ASSERT_TRUE(live.steps_until([&] { return live.number("a") == kEdits - 1; }));
  EXPECT_EQ(live.status("a").traffic.received, before + kEdits);
  broker.publish("two", R"({"f9": 9})");
  EXPECT_TRUE(live.steps_until([&] { return live.number("b") == 9; }));
  // Another topic is another subscription of the same connection.
  ASSERT_EQ(live.world().submit(command<SetPort>({"b", {"sensor.address"}, {"\"" + broker.address("three") + "\""}})), "");
  ASSERT_TRUE(live.hears(broker, "three", R"({"f9": 3})", [&] { return live.number("b") == 3; }));
  broker.publish("two", R"({"f9": 2})");
  broker.publish("one", "7");
  ASSERT_TRUE(live.steps_until([&] { return live.number("a") == 7; }));
  EXPECT_EQ(live.number("b"), 3);
}

TEST(Mqtt, MessagesOfUnknownAgeAreNoReadings) {
  Broker broker;
  broker.start();
  broker.publish("t", "99", true);
  LiveWorld live(sensor("s", broker.address("t")));
  ASSERT_TRUE(live.steps_until([&] { return live.status("s").traffic.skipped == 1; }));
  EXPECT_EQ(live.quality("s"), "never");
  ASSERT_TRUE(live.hears(broker, "t", "3", [&] { return live.number("s") == 3; }));
}

TEST(Mqtt, AFloodIsOneReadingForEachTickAndIsCounted) {
  Broker broker;
  broker.start();
  LiveWorld live(sensor("s", broker.address("t")));
  ASSERT_TRUE(live.hears_last(broker, "t", "s", 0));
  const int reports = live.reports();
  const std::int64_t before = live.status("s").traffic.received;
  for (int i = 1; i <= 20; ++i) broker.publish("t", std::to_string(i));
  ASSERT_TRUE(eventually([&] { return live.status("s").traffic.received == before + 20; }));
  live.step();
  EXPECT_EQ(live.reports(), reports + 1);
  EXPECT_EQ(live.number("s"), 20);
  EXPECT_EQ(live.status("s").traffic.skipped, 19);
}

TEST(Mqtt, AnActuatorSendsWhatChangedAndNotMoreOftenThanAllowed) {
  Broker broker;
  broker.start();
  const Folder folder;
  const std::string lamp = R"({"id": "lamp", "types": {"actuator": {"address": ")" + broker.address("lamp/level") +
                           R"(", "format": "{\"level\": {value}}", "decimals": 1, "value": 0.26, "interval": 3600}}})";
  Program listener({"stdbuf", "-oL", "mosquitto_sub", "-p", std::to_string(broker.port()), "-t", "lamp/level", "-C", "1", "-d"},
                   folder.path("heard"));
  const auto heard = [&] {
    std::ifstream file(folder.path("heard"));
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  ASSERT_TRUE(eventually([&] { return heard().find("Subscribed") != std::string::npos; }));
  LiveWorld live(lamp);
  ASSERT_TRUE(live.steps_until([&] { return live.status("lamp").traffic.acknowledged == 1; }));
  EXPECT_EQ(listener.wait(), 0);
  EXPECT_NE(heard().find("{\"level\": 0.3}"), std::string::npos) << heard();
  for (int i = 0; i < 50; ++i) {
    ASSERT_EQ(live.world().submit(command<SetPort>({"lamp", {"actuator.value"}, {std::to_string(i)}})), "");
    live.step();
  }
  EXPECT_EQ(live.status("lamp").traffic.sent, 1);
  EXPECT_EQ(live.text("lamp", "actuator.message"), "{\"level\": 49.0}");
  // Nothing of the network has come into the scene.
  EXPECT_EQ(live.reports(), 0);
  EXPECT_EQ(live.replayed(2), live.hash());
}

TEST(Mqtt, SomethingElseThanABrokerAndAHostThatIsNotThere) {
  LiveWorld nobody(sensor("s", "mqtt://nowhere.invalid/t"));
  EXPECT_TRUE(nobody.steps_until([&] { return nobody.says("s", "nowhere.invalid"); }));
  // Somebody who accepts and never says a word: nothing is heard, and the end does not wait for an answer.
  const test::Loopback silent(SOCK_STREAM, 0, true);
  auto live = std::make_unique<LiveWorld>(sensor("s", "mqtt://127.0.0.1:" + std::to_string(silent.port()) + "/t"));
  for (int i = 0; i < 50; ++i) live->step();
  EXPECT_EQ(live->quality("s"), "never");
  const auto begin = std::chrono::steady_clock::now();
  live.reset();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(8)) << "an answer is waited for ten seconds";
}

}  // namespace
}  // namespace bl::live
