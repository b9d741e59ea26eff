// What a computer says of itself, from trees of files as Linux has them; and the verdicts on it.
#include "core/serve/machine.h"

#include <cmath>
#include <filesystem>
#include <fstream>

#include <unistd.h>

#include <gtest/gtest.h>

#include "core/serve/measuring.h"
#include "core/serve/readiness.h"

namespace bl::serve {
namespace {

class Machines : public ::testing::Test {
 protected:
  void SetUp() override {
    root_ = std::filesystem::temp_directory_path() / ("behaviourlinks_machine_" + std::to_string(::getpid()) + "_" +
                                                      ::testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(root_);
  }
  void TearDown() override { std::filesystem::remove_all(root_); }
  void write(const std::string& path, const std::string& text) {
    const auto file = root_ / path;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
  }
  void battery(const std::string& name, const std::string& percent, const std::string& status) {
    const std::string folder = "sys/class/power_supply/" + name + "/";
    write(folder + "type", "Battery\n");
    write(folder + "capacity", percent + "\n");
    write(folder + "status", status + "\n");
  }
  void mains(const std::string& online) {
    write("sys/class/power_supply/AC/type", "Mains\n");
    write("sys/class/power_supply/AC/online", online + "\n");
  }
  Machine read() { return read_machine(root_.string(), root_.string()); }
  std::filesystem::path root_;
};

TEST_F(Machines, AnEmptyTreeSaysNothingAndOnlyTheDiskIsKnown) {
  const Machine machine = read();
  EXPECT_FALSE(machine.battery || machine.is_on_mains || machine.memory_free);
  EXPECT_TRUE(machine.wireless.empty());
  ASSERT_TRUE(machine.disk_free);
  EXPECT_GE(*machine.disk_free, 0);
  EXPECT_EQ(judge_power(machine).verdict, Verdict::good) << "a computer without a battery is plugged in";
  EXPECT_FALSE(read_machine(root_.string(), (root_ / "nowhere").string()).disk_free);
}

TEST_F(Machines, ABatteryIsReadWithWhatFeedsIt) {
  battery("BAT0", "62", "Discharging");
  mains("0");
  EXPECT_NEAR(*read().battery, 0.62, 1e-12);
  EXPECT_FALSE(*read().is_on_mains);
  EXPECT_EQ(judge_power(read()).verdict, Verdict::look);
  battery("BAT0", "12", "Discharging");
  EXPECT_EQ(judge_power(read()).verdict, Verdict::bad);
  mains("1");
  EXPECT_TRUE(*read().is_on_mains);
  EXPECT_EQ(judge_power(read()).verdict, Verdict::good);
  battery("BAT1", "88", "Full");
  EXPECT_NEAR(*read().battery, 0.5, 1e-12) << "the mean of two";
}

TEST_F(Machines, TheBatteryOfAMouseIsNone) {
  battery("hid-mouse", "5", "Discharging");
  write("sys/class/power_supply/hid-mouse/scope", "Device\n");
  EXPECT_FALSE(read().battery);
}

TEST_F(Machines, WhatCannotBeReadIsMissing) {
  battery("BAT0", "many", "Discharging");
  battery("BAT1", "-7", "Discharging");
  battery("BAT2", "1e999", "Discharging");
  write("proc/meminfo", "MemAvailable: lots kB\n");
  write("proc/net/wireless", "garbage\nwlan0:\nwlan1: 0000 x. -1. -2.\n:\n");
  const Machine machine = read();
  EXPECT_FALSE(machine.battery || machine.memory_free);
  EXPECT_TRUE(machine.wireless.empty());
}

TEST_F(Machines, WirelessLinksAndMemoryAreRead) {
  write("proc/net/wireless",
        "Inter-| sta-|   Quality        |   Discarded packets               | Missed | WE\n"
        " face | tus | link level noise |  nwid  crypt   frag  retry   misc | beacon | 22\n"
        "wlp3s0: 0000   63.  -47.  -256        0      0      0      0     58        0\n"
        " wlan1: 0000   14.  -88.  -256        0      0      0      0      0        0\n");
  write("proc/meminfo", "MemTotal:       16000000 kB\nMemFree:          100 kB\nMemAvailable:    2000000 kB\n");
  const Machine machine = read();
  ASSERT_EQ(machine.wireless.size(), 2u);
  EXPECT_NEAR(machine.wireless.at("wlp3s0"), 0.9, 1e-12);
  EXPECT_NEAR(machine.wireless.at("wlan1"), 0.2, 1e-12);
  EXPECT_EQ(machine.memory_free, std::int64_t{2000000} * 1024);
  EXPECT_EQ(judge_wireless("wlp3s0", 0.9).verdict, Verdict::good);
  EXPECT_EQ(judge_wireless("wlan1", 0.2).verdict, Verdict::look);
}

TEST(Addresses, PrivateOnesAreThoseOfTheStandards) {
  for (const char* address : {"10.0.0.1", "10.255.255.255", "172.16.0.1", "172.31.255.1", "192.168.1.5", "169.254.7.7", "fd00::1",
                              "fe80::1", "127.0.0.1", "::1"})
    EXPECT_TRUE(is_private_address(address)) << address;
  for (const char* address : {"9.255.255.255", "11.0.0.1", "172.15.255.255", "172.32.0.1", "192.167.1.1", "192.169.1.1",
                              "8.8.8.8", "2001:db8::1", "nonsense", ""})
    EXPECT_FALSE(is_private_address(address)) << address;
  for (const NetworkAddress& one : network_addresses()) EXPECT_FALSE(is_own_address(one.address)) << one.address;
}

TEST(Addresses, DevicesThatComeAreCountedOnceAndThisComputerNever) {
  Reach reach;
  EXPECT_TRUE(reach.counts().empty());
  reach.note("192.168.1.5", "192.168.1.5");
  reach.note("127.0.0.1", "127.0.0.1");
  EXPECT_TRUE(reach.counts().empty()) << "this computer is no other device";
  for (int k = 0; k < 3; ++k) reach.note("192.168.1.5", "192.168.1.20");
  reach.note("192.168.1.5", "192.168.1.21");
  reach.note("10.0.0.2", "10.0.0.9");
  EXPECT_EQ(reach.counts(), (std::map<std::string, std::size_t>{{"10.0.0.2", 1}, {"192.168.1.5", 2}}));
  for (std::size_t k = 0; k < 2 * Reach::kMost; ++k) reach.note("10.0.0.2", "a" + std::to_string(k));
  EXPECT_EQ(reach.counts().at("10.0.0.2"), Reach::kMost);
}

// --- Verdicts -------------------------------------------------------------------------------------------------------

// More of what harms never gets a better verdict.
template <class Judge>
void expect_monotone(const std::vector<double>& rising, const Judge& judge) {
  Verdict before = Verdict::good;
  for (const double value : rising) {
    const Verdict now = judge(value).verdict;
    EXPECT_GE(now, before) << value;
    before = now;
  }
  EXPECT_EQ(before, Verdict::bad);
}

TEST(Verdicts, OnlyGetWorseWithWhatHarms) {
  std::vector<double> rising;
  for (double value = 1e-5; value < 10; value *= 1.3) rising.push_back(value);
  expect_monotone(rising, [](double s) { return judge_commits({s, 2 * s, 50}); });
  expect_monotone(rising, [](double s) { return judge_ticks({s, 2 * s, 50}, 10); });
  expect_monotone(rising, [](double s) { return judge_free_disk(static_cast<std::int64_t>(1e9 / s)); });
  expect_monotone(rising, [](double s) { return judge_memory(static_cast<std::int64_t>(1e9 / s)); });
  expect_monotone(rising, [](double s) { return judge_pace(s, 10, false); });
  expect_monotone(rising, [](double s) { return judge_storing(s, 2 * s); });
  EXPECT_EQ(judge_pace(0.09, 10, false).verdict, Verdict::look) << "ticks come late";
  EXPECT_EQ(judge_pace(9, 10, true).verdict, Verdict::good) << "a model that stands still is not late";
  EXPECT_EQ(judge_storing(0.004, 0.06).verdict, Verdict::look) << "a disk that is slow at times";
  EXPECT_EQ(judge_commits({0.004, 0.01, 50}).verdict, Verdict::good) << "a usual disk";
  EXPECT_EQ(judge_ticks({0.005, 0.01, 50}, 10).verdict, Verdict::good);
  EXPECT_EQ(judge_ticks({0.005, 0.2, 50}, 10).verdict, Verdict::look) << "a single slow tick";
  EXPECT_EQ(judge_clock(true).verdict, Verdict::good);
  EXPECT_EQ(judge_clock(false).verdict, Verdict::look);
  EXPECT_EQ(judge_clock(std::nullopt).verdict, Verdict::look);
}

TEST(Verdicts, AnAddressTellsWhoHasReachedIt) {
  Machine machine;
  machine.wireless["wlan0"] = 0.2;
  const NetworkAddress cable{"eth0", "192.168.1.5", true}, radio{"wlan0", "192.168.1.6", true}, open{"eth1", "8.8.8.8", false};
  EXPECT_EQ(judge_address(cable, "http://192.168.1.5:8080", machine, 3).verdict, Verdict::good);
  const Finding nobody = judge_address(cable, "http://192.168.1.5:8080", machine, 0);
  EXPECT_EQ(nobody.verdict, Verdict::look);
  EXPECT_NE(nobody.text.find("Nobody has reached it yet"), std::string::npos);
  EXPECT_EQ(judge_address(cable, "http://192.168.1.5:8080", machine, std::nullopt).verdict, Verdict::good);
  EXPECT_EQ(judge_address(radio, "http://192.168.1.6:8080", machine, 3).verdict, Verdict::look) << "weak";
  EXPECT_EQ(judge_address(open, "http://8.8.8.8:8080", machine, 3).verdict, Verdict::look);
}

TEST(Verdicts, ALineIsReadAsItWasWritten) {
  const Finding all[] = {judge_commits({0.2, 0.9, 50}),
                         judge_memory(5),
                         judge_clock(false),
                         {Verdict::bad, "port", "Port 80 is taken."},
                         {Verdict::good, "a_long_subject_of_its_own", "Text."}};
  for (const Finding& finding : all) {
    const auto read = finding_of_line(line_of(finding));
    ASSERT_TRUE(read) << line_of(finding);
    EXPECT_EQ(*read, finding);
  }
  EXPECT_EQ(line_of({Verdict::good, "disk", "one\ntwo"}).find('\n'), std::string::npos);
  for (const char* line : {"", "good", "good ", "good disk", "goodness disk x", "room BKRT at http://x"})
    EXPECT_FALSE(finding_of_line(line)) << line;
}

// --- Measuring ------------------------------------------------------------------------------------------------------

TEST_F(Machines, MeasuringTheDiskLeavesNothingBehind) {
  const auto times = measure_commits(root_.string(), 5);
  ASSERT_TRUE(times) << times.error().text();
  EXPECT_EQ(times->count, 5u);
  EXPECT_GT(times->median, 0);
  EXPECT_GE(times->worst, times->median);
  EXPECT_TRUE(std::filesystem::is_empty(root_));
  EXPECT_FALSE(measure_commits((root_ / "nowhere").string(), 5));
}

TEST(Measuring, DurationsAreTheMiddleAndTheWorst) {
  const Durations times = durations_of({3, 1, 2, 100, 2.5});
  EXPECT_EQ(times.median, 2.5);
  EXPECT_EQ(times.worst, 100);
  EXPECT_EQ(times.count, 5u);
}

}  // namespace
}  // namespace bl::serve
