// OSC by hand-made datagrams on the loopback: every type, bundles, noise; and what an actuator sends, byte by byte.
#include <cstring>
#include <utility>

#include "core/base/random.h"
#include "core/live/commands.h"
#include "tests/core/live/live_support.h"

namespace bl::live {
namespace {

using test::LiveWorld;
using test::Loopback;
using test::sensor;

// A text of OSC: a zero at its end, filled up to a multiple of four.
std::string padded(std::string text) {
  text += '\0';
  while (text.size() % 4 != 0) text += '\0';
  return text;
}

std::string word(std::uint32_t bits) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(bits >> shift & 0xff);
  return bytes;
}

std::string real(float number) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &number, sizeof bits);
  return word(bits);
}

std::string packet(const std::string& path, const std::string& types, const std::string& arguments) {
  return padded(path) + padded("," + types) + arguments;
}

std::string bundle(const std::vector<std::string>& packets) {
  std::string bytes = padded("#bundle") + word(0) + word(1);
  for (const std::string& inside : packets) bytes += word(static_cast<std::uint32_t>(inside.size())) + inside;
  return bytes;
}

struct Osc {
  int port = Loopback(SOCK_DGRAM).port();
  Loopback hand{SOCK_DGRAM};
  LiveWorld live{sensor("light", "osc://" + std::to_string(port) + "/light", R"(, "timeout": 0)") + "," +
                 sensor("second", "osc://" + std::to_string(port) + "/pair", R"(, "field": "1", "timeout": 0)")};

  bool shows(const std::string& bytes, const char* node, double number) {
    return test::eventually([&] {
      hand.send(port, bytes);
      live.step();
      return live.quality(node) == "good" && live.number(node) == number;
    });
  }
  bool says(const std::string& bytes, const char* node, const std::string& sentence) {
    return test::eventually([&] {
      hand.send(port, bytes);
      live.step();
      return live.says(node, sentence);
    });
  }
};

TEST(Osc, NumbersOfEveryTypeAndInBundles) {
  Osc osc;
  EXPECT_TRUE(osc.shows(packet("/light", "f", real(0.5f)), "light", 0.5));
  EXPECT_TRUE(osc.shows(packet("/light", "i", word(7)), "light", 7));
  EXPECT_TRUE(osc.shows(packet("/light", "s", padded("8.25")), "light", 8.25));
  EXPECT_TRUE(osc.shows(packet("/light", "d", word(0x40240000) + word(0)), "light", 10));
  EXPECT_TRUE(osc.shows(packet("/light", "T", ""), "light", 1));
  EXPECT_TRUE(osc.shows(packet("/pair", "if", word(3) + real(4.5f)), "second", 4.5));
  EXPECT_TRUE(osc.shows(bundle({packet("/other", "i", word(1)), bundle({packet("/light", "i", word(12))})}), "light", 12));
  EXPECT_EQ(osc.live.number("second"), 4.5);
  EXPECT_EQ(osc.live.replayed(2), osc.live.hash());
}

TEST(Osc, NoiseIsSaidAndHarmsNobody) {
  Osc osc;
  ASSERT_TRUE(osc.shows(packet("/light", "i", word(5)), "light", 5));
  EXPECT_TRUE(osc.says("no message", "light", "is no OSC message"));
  EXPECT_TRUE(osc.says(packet("/pair", "i", word(1)), "second", "the message has 1 arguments, and number 1"));
  EXPECT_TRUE(osc.says(packet("/light", "s", padded("dark")), "light", "`dark` is no number"));
  EXPECT_TRUE(osc.says(packet("/light", "f", word(0x7fc00000)), "light", "not finite"));
  EXPECT_TRUE(osc.says(packet("/light", "N", ""), "light", "of the OSC type `N` holds no number"));
  EXPECT_TRUE(osc.says(padded("#bundle") + word(0) + word(1) + word(0xfffffff0) + "abcd", "light", "is no OSC message"));
  std::string nested = packet("/light", "i", word(1));
  for (int i = 0; i < 200; ++i) nested = bundle({nested});
  EXPECT_TRUE(osc.says(nested, "light", "is no OSC message"));
  Random random(3, 9);
  for (int i = 0; i < 3000; ++i) {
    std::string bytes = i % 2 == 0 ? packet("/light", "if", word(1) + real(2)) : "";
    const std::uint64_t extra = random.below(64);
    for (std::uint64_t k = 0; k < extra; ++k) {
      const char byte = static_cast<char>(random.below(256));
      if (!bytes.empty() && i % 2 == 0) bytes[random.below(bytes.size())] = byte;
      else bytes += byte;
    }
    osc.hand.send(osc.port, bytes);
    if (i % 100 == 0) osc.live.step();
  }
  EXPECT_TRUE(osc.shows(packet("/light", "i", word(6)), "light", 6));
  EXPECT_EQ(osc.live.replayed(1), osc.live.hash());
}

// A paused or late clock must not make an old message a young one.
TEST(Osc, AMessageIsAsOldAsItHasWaited) {
  const int port = Loopback(SOCK_DGRAM).port();
  const Loopback hand(SOCK_DGRAM);
  LiveWorld live(sensor("s", "osc://" + std::to_string(port) + "/x", R"(, "timeout": 0.02, "tick_length": 0.001)"));
  live.step();
  ASSERT_TRUE(test::eventually([&] {
    hand.send(port, packet("/x", "i", word(2)));
    return live.status("s").traffic.received > 0;
  }));
  // Several may have been sent before the first came: as long as others come, the wait begins anew.
  std::int64_t received = 0;
  auto came = std::chrono::steady_clock::now();
  ASSERT_TRUE(test::eventually([&] {
    if (live.status("s").traffic.received != std::exchange(received, live.status("s").traffic.received))
      came = std::chrono::steady_clock::now();
    return std::chrono::steady_clock::now() - came > std::chrono::milliseconds(200);
  }));
  live.step();
  EXPECT_EQ(live.quality("s"), "stale");
  EXPECT_GE(live.number("s", "sensor.age"), 0.1);
  EXPECT_EQ(live.replayed(2), live.hash());
}

// What was saved of a connection is of that run.
TEST(Osc, AnOldLineIsForgottenWhereNobodyIsConnectedTo) {
  LiveWorld live(sensor("s", "osc://9000/x", R"(, "connection": "the server refuses")"), "", {"", false, {}});
  live.step();
  EXPECT_FALSE(live.says("s", "refuses")) << live.message("s");
  EXPECT_EQ(live.reports(), 1);
  live.step();
  EXPECT_EQ(live.reports(), 1);
}

TEST(Osc, ATakenPortIsASentenceAndIsTriedAgain) {
  auto taken = std::make_unique<Loopback>(SOCK_DGRAM);
  const int port = taken->port();
  LiveWorld live(sensor("s", "osc://" + std::to_string(port) + "/x"));
  ASSERT_TRUE(live.steps_until([&] { return live.says("s", "is taken by another program"); })) << live.message("s");
  taken.reset();
  const Loopback hand(SOCK_DGRAM);
  EXPECT_TRUE(live.steps_until([&] {
    hand.send(port, packet("/x", "i", word(2)));
    return live.quality("s") == "good";
  }));
  EXPECT_EQ(live.message("s"), "");
}

TEST(Osc, AnActuatorSendsANumberOrAText) {
  const Loopback ear(SOCK_DGRAM);
  const std::string place = "osc://127.0.0.1:" + std::to_string(ear.port());
  LiveWorld live(R"({"id": "a", "types": {"actuator": {"address": ")" + place + R"(/dim", "value": 0.5}}},
    {"id": "b", "types": {"actuator": {"address": ")" +
                 place + R"(/say", "value": 250, "unit": "cm", "format": "{value} cm"}}})");
  std::vector<std::string> heard;
  ASSERT_TRUE(live.steps_until([&] {
    if (const std::string bytes = ear.received(); !bytes.empty()) heard.push_back(bytes);
    return heard.size() == 2;
  }));
  std::sort(heard.begin(), heard.end());
  EXPECT_EQ(heard[0], packet("/dim", "f", real(0.5f)));
  EXPECT_EQ(heard[1], packet("/say", "s", padded("25000 cm")));
}

// A default is no order: a machine hears nothing before somebody has said something, be it the default itself.
TEST(Osc, AnActuatorThatNobodySteersIsSilent) {
  const Loopback ear(SOCK_DGRAM);
  const std::string place = "osc://127.0.0.1:" + std::to_string(ear.port());
  LiveWorld live(
      R"({"id": "a", "types": {"actuator": {"address": ")" + place + R"(/dim"}}},
    {"id": "b", "types": {"actuator": {"address": ")" +
          place + R"(/told", "value": 0}}},
    {"id": "c", "types": {"actuator": {"address": ")" +
          place + R"(/led"}}}, {"id": "s", "types": {"sensor": {}}})",
      R"({"id": "l", "kind": "sensor_to_parameter", "from": "s", "to": "c", "parameters": {"target": "actuator.value"}})");
  std::vector<std::string> heard;
  const auto listen = [&] {
    if (const std::string bytes = ear.received(); !bytes.empty()) heard.push_back(bytes);
  };
  ASSERT_TRUE(live.steps_until([&] {
    listen();
    return !heard.empty();
  }));
  for (int i = 0; i < 20; ++i) live.step(), listen();
  ASSERT_EQ(heard.size(), 1u);
  EXPECT_EQ(heard[0], packet("/told", "f", real(0))) << "somebody has said 0";
  // Its sensor speaks: now the link does, too.
  ASSERT_EQ(live.world().submit(command<Receive>({"s", 3, "", "", live.world().state().tick + 1, false})), "");
  ASSERT_TRUE(live.steps_until([&] {
    listen();
    return heard.size() > 1;
  }));
  EXPECT_EQ(heard[1], packet("/led", "f", real(3)));
}

}  // namespace
}  // namespace bl::live
