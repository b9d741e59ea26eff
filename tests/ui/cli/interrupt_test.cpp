// One Ctrl-C ends each task within a second, and what was asked for is written.
#include <gtest/gtest.h>

#include <poll.h>
#include <pty.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <sstream>
#include <string>
#include <utility>

#include "core/base/random.h"
#include "tests/support/sanitized.h"
#include "tests/ui/cli/program.h"

namespace bl::test {
namespace {

// How a task that would run for minutes has ended. Where the program has ended by itself before, the code is not that of an
// interrupt.
struct Interrupted {
  Outcome outcome;
  double seconds = -1;  // of processors, from the interrupt to the end: what else the machine does takes nothing away from it
};

// What a process has used of processors until now, by what Linux says of it [s].
double used_by(pid_t process) {
  const std::string text = read_text("/proc/" + std::to_string(process) + "/stat");
  std::istringstream fields(text.substr(std::min(text.size(), text.rfind(')') + 1)));
  std::string other;
  for (int field = 3; field < 14; ++field) fields >> other;
  double user = 0, kernel = 0;
  fields >> user >> kernel;
  return (user + kernel) / static_cast<double>(::sysconf(_SC_CLK_TCK));
}

// Whether a process handles Ctrl-C itself, by what Linux says of it; before it does, the signal ends it without a word.
bool catches_interrupts(pid_t process) {
  std::istringstream lines(read_text("/proc/" + std::to_string(process) + "/status"));
  std::string line;
  while (std::getline(lines, line))
    if (line.starts_with("SigCgt:")) return (std::stoull(line.substr(7), nullptr, 16) >> (SIGINT - 1) & 1) != 0;
  return false;
}

// After so many seconds of processors at its work, however slow the machine is or what else runs on it. The work begins where
// the program has read its files and handles Ctrl-C.
Interrupted interrupt(const Workplace& place, const std::string& task, double after = 1.5) {
  const std::string line =
      "cd '" + place.path("").string() + "' && exec '" + program_path().string() + "' " + task + " >.out 2>.err </dev/null";
  const pid_t child = ::fork();
  if (child == 0) {
    ::execl("/bin/sh", "sh", "-c", line.c_str(), static_cast<char*>(nullptr));
    ::_exit(99);
  }
  const auto wait_while = [](int tries, const auto& goes_on) {
    for (; tries > 0 && goes_on(); --tries) ::usleep(20'000);
    return tries > 0;
  };
  siginfo_t state{};
  const auto is_running = [&] {
    return ::waitid(P_PID, static_cast<id_t>(child), &state, WEXITED | WNOHANG | WNOWAIT) == 0 && state.si_pid == 0;
  };
  (void)wait_while(6000, [&] { return is_running() && !catches_interrupts(child); });
  const double began = used_by(child);
  (void)wait_while(6000, [&] { return is_running() && used_by(child) < began + after; });
  const double before = used_by(child);
  ::kill(child, SIGINT);
  int status = 0;
  struct rusage used {};
  if (!wait_while(6000, [&] { return ::wait4(child, &status, WNOHANG, &used) == 0; })) {
    ::kill(child, SIGKILL);
    ::wait4(child, &status, 0, &used);
  }
  const auto seconds_of = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return {{WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), place.text(".out"), place.text(".err")},
          seconds_of(used.ru_utime) + seconds_of(used.ru_stime) - before};
}

void expect_at_once(const Interrupted& found) {
  EXPECT_EQ(found.outcome.code, 130) << found.outcome.out << found.outcome.err;
  EXPECT_LT(found.seconds, kIsSanitized ? 10 : 2);
}

// So many fits of five thousand volumes each, to a tolerance that no fit reaches: with feedback, seconds each on any machine.
std::string endless_fits(int cases) {
  std::string sites, demands;
  Random random(7);
  for (int i = 0; i < 5000; ++i) {
    sites += (i > 0 ? ",[" : "[") + std::to_string(random.uniform()) + "," + std::to_string(random.uniform()) + "," +
             std::to_string(random.uniform()) + "]";
    demands += (i > 0 ? "," : "") + std::to_string(1e-5 * static_cast<double>(1 + i % 7));
  }
  const std::string one = R"({"boundary": {"plan": [[0,0],[1,0],[1,1],[0,1]], "bottom": 0, "top": 1}, "sites": [)" + sites +
                          "], \"demands\": [" + demands + "]}";
  std::string text = "{\"cases\": [" + one;
  for (int k = 1; k < cases; ++k) text += "," + one;
  return text + "]}";
}

TEST(Interrupt, EndsARunAndWritesAllThatWasAskedFor) {
  const Workplace place;
  place.write("s.json", moving_scene());
  const auto found =
      interrupt(place, "run s.json --ticks 100000000 --json out.json --save saved.json --log log.jsonl --report page");
  expect_at_once(found);
  for (const char* file : {"out.json", "saved.json", "log.jsonl", "page/report.html"})
    EXPECT_TRUE(std::filesystem::exists(place.path(file))) << file;
  EXPECT_EQ(place.run({"check", "saved.json"}).code, 0);
}

// A run of so many ticks that has settled long before its end was still stopped, and says so.
TEST(Interrupt, ASettledRunSaysThatItWasStopped) {
  if (test::kIsSanitized) GTEST_SKIP() << "others of these tests end the same way";
  const Workplace place;
  place.write("s.json", moving_scene());
  const auto found = interrupt(place, "run s.json --ticks 100000000", 3);
  expect_at_once(found);
  EXPECT_TRUE(found.outcome.last_line().starts_with("stopped at tick ")) << found.outcome.last_line();
}

// Somebody is asked on a terminal, and answers with Ctrl-C.
TEST(Interrupt, EndsAQuestion) {
  const Workplace place;
  place.write("site.json", R"({"format": "behaviourlinks", "version": 1, "nodes": [{"id": "site", "types": {"boundary":
    {"form": "plan", "height": 30, "plan": [[0, 0, 0], [50, 0, 0], [50, 50, 0], [0, 50, 0]]}}}], "links": []})");
  place.write("house.geojson",
              R"({"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {"height": 12}, "geometry":
      {"type": "Polygon", "coordinates": [[[10, 10], [30, 10], [30, 30], [10, 30], [10, 10]]]}}]})");
  const std::string program = program_path().string(), folder = place.path("").string();
  int terminal = -1;
  const pid_t child = ::forkpty(&terminal, nullptr, nullptr, nullptr);
  ASSERT_GE(child, 0);
  if (child == 0) {
    if (::chdir(folder.c_str()) == 0)
      ::execl(program.c_str(), "behaviourlinks", "import", "house.geojson", "--into", "site.json", "--out", "all.json", "--crs",
              "local", "--as", "building", static_cast<char*>(nullptr));
    ::_exit(99);
  }
  // What the program writes, until it waits for an answer or says nothing more.
  const auto read_until = [terminal](const std::string& words, int milliseconds) {
    std::string text;
    struct pollfd line {
      terminal, POLLIN, 0
    };
    for (int waited = 0; waited < milliseconds && text.find(words) == std::string::npos; waited += 100) {
      char some[4096];
      if (::poll(&line, 1, 100) <= 0) continue;
      const ssize_t count = ::read(terminal, some, sizeof some);
      if (count <= 0) break;
      text.append(some, static_cast<std::size_t>(count));
    }
    return text;
  };
  const std::string question = read_until("keep / clear", 60000);
  EXPECT_NE(question.find("keep / clear"), std::string::npos) << question;
  ASSERT_EQ(::write(terminal, "\x03", 1), 1);
  (void)read_until("no such words", 60000);
  int status = 0;
  bool has_ended = false;
  for (int tries = 0; tries < 600 && !has_ended; ++tries) {
    has_ended = ::waitpid(child, &status, WNOHANG) == child;
    if (!has_ended) ::usleep(100'000);
  }
  EXPECT_TRUE(has_ended) << "it still waits for an answer";
  if (!has_ended) {
    ::kill(child, SIGKILL);
    ::waitpid(child, &status, 0);
  } else {
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 130) << status;
  }
  ::close(terminal);
  EXPECT_FALSE(std::filesystem::exists(place.path("all.json")));
}

// A tick of a script that has minutes of work in it is dropped: what is saved is the tick before.
TEST(Interrupt, EndsAScriptInTheMiddleOfATick) {
  const Workplace place;
  std::string links;
  for (int k = 0; k < 1500; ++k)
    links += (k > 0 ? "," : "") + std::string(R"({"id": "l)") + std::to_string(k) +
             R"(", "kind": "slow", "from": "east", "to": "west"})";
  std::string scene = scene_text(volume_text("east", "[8, 0, 8]") + "," + volume_text("west", "[-8, 0, 8]"), links);
  place.write("slow.lua", R"(return {
  id = "slow",
  label = "Slow",
  doc = "Counts for long.",
  reads = {here = {at = "to", port = "node.position", unit = "m"}},
  proposes = {move = {at = "to", port = "node.position", unit = "m"}},
  evaluate = function(params, ends, tick)
    local sum = 0
    for i = 1, 80000 do sum = sum + i % 7 end
    return {move = point(0, 0, 0 * sum)}
  end,
}
)");
  place.write("s.json", scene);
  const auto found = interrupt(place, "run s.json --script slow.lua --ticks 1000000 --save saved.json");
  expect_at_once(found);
  EXPECT_TRUE(std::filesystem::exists(place.path("saved.json")));
}

TEST(Interrupt, EndsAFitAndWritesAllCases) {
  if (test::kIsSanitized) GTEST_SKIP() << "others of these tests end the same way";
  const Workplace place;
  place.write("s.json", endless_fits(16));
  const auto found = interrupt(place, "fit s.json --json out.json --method feedback --tolerance 1e-16 --steps 100000", 3);
  expect_at_once(found);
  const auto cases = place.json("out.json")["cases"];
  ASSERT_EQ(cases.size(), 16u);
  EXPECT_EQ(cases.back()["status"], "cancelled");
  for (const auto& one : cases) EXPECT_EQ(one["weights"].size(), 5000u);
}

TEST(Interrupt, EndsAnAssignmentAndWritesHowFarItHasCome) {
  if (test::kIsSanitized) GTEST_SKIP() << "others of these tests end the same way";
  const Workplace place;
  constexpr int kZones = 160, kAside = 3;
  std::string links, trips;
  const auto node = [](int row, int column) { return std::to_string(row * kZones + column + 1); };
  int count = 0;
  for (int row = 0; row < kAside; ++row)
    for (int column = 0; column < kZones; ++column)
      for (const auto& [r, c] : {std::pair{row + 1, column}, {row - 1, column}, {row, column + 1}, {row, column - 1}}) {
        if (r < 0 || r >= kAside || c < 0 || c >= kZones) continue;
        links +=
            node(row, column) + " " + node(r, c) + " 900 1 " + std::to_string(1 + (row * 7 + c * 3) % 5) + " 0.15 4 0 0 1 ;\n";
        ++count;
      }
  for (int from = 1; from <= kZones; ++from) {
    trips += "Origin " + std::to_string(from) + "\n";
    for (int to = 1; to <= kZones; ++to)
      if (to != from) trips += std::to_string(to) + " : " + std::to_string(1 + (from * to) % 9) + ".0; ";
    trips += "\n";
  }
  place.write("n_net.tntp",
              "<NUMBER OF ZONES> " + std::to_string(kZones) + "\n<NUMBER OF NODES> " + std::to_string(kAside * kZones) +
                  "\n<FIRST THRU NODE> 1\n<NUMBER OF LINKS> " + std::to_string(count) +
                  "\n<END OF METADATA>\n~ init term capacity length free_flow_time b power speed toll link_type ;\n" + links);
  place.write("n_trips.tntp", "<NUMBER OF ZONES> " + std::to_string(kZones) + "\n<TOTAL OD FLOW> 0\n<END OF METADATA>\n" + trips);
  const auto found = interrupt(place, "assign n_net.tntp n_trips.tntp --gap 1e-300 --iterations 1000000 --json out.json");
  expect_at_once(found);
  ASSERT_TRUE(std::filesystem::exists(place.path("out.json"))) << found.outcome.out << found.outcome.err;
  const auto out = place.json("out.json");
  EXPECT_EQ(out["links"].size(), static_cast<std::size_t>(count));
  EXPECT_GT(out["equilibrium"]["gap"].get<double>(), 0);
}

// The first trips of a network of thousands of origins, for which the shortest ways alone take many times as long as is waited.
TEST(Interrupt, EndsTheLoadingOfTheFirstTrips) {
  const Workplace place;
  constexpr int kAside = 120, kNodes = kAside * kAside;
  std::string links, trips;
  int count = 0;
  const auto node = [](int row, int column) { return std::to_string(row * kAside + column + 1); };
  for (int row = 0; row < kAside; ++row)
    for (int column = 0; column < kAside; ++column)
      for (const auto& [r, c] : {std::pair{row + 1, column}, {row - 1, column}, {row, column + 1}, {row, column - 1}}) {
        if (r < 0 || r >= kAside || c < 0 || c >= kAside) continue;
        links +=
            node(row, column) + " " + node(r, c) + " 900 1 " + std::to_string(1 + (row * 7 + c * 3) % 5) + " 0.15 4 0 0 1 ;\n";
        ++count;
      }
  for (int from = 1; from <= kNodes; ++from)
    trips += "Origin " + std::to_string(from) + "\n" + std::to_string(1 + (from * 37 + 11) % kNodes) + " : 2.0;\n";
  place.write("n_net.tntp",
              "<NUMBER OF ZONES> " + std::to_string(kNodes) + "\n<NUMBER OF NODES> " + std::to_string(kNodes) +
                  "\n<FIRST THRU NODE> 1\n<NUMBER OF LINKS> " + std::to_string(count) +
                  "\n<END OF METADATA>\n~ init term capacity length free_flow_time b power speed toll link_type ;\n" + links);
  place.write("n_trips.tntp", "<NUMBER OF ZONES> " + std::to_string(kNodes) + "\n<TOTAL OD FLOW> 0\n<END OF METADATA>\n" + trips);
  const auto found = interrupt(place, "assign n_net.tntp n_trips.tntp --gap 1e-300 --iterations 1000000 --json out.json", 0.5);
  expect_at_once(found);
  ASSERT_TRUE(std::filesystem::exists(place.path("out.json"))) << found.outcome.out << found.outcome.err;
  const auto figures = place.json("out.json")["equilibrium"];
  EXPECT_GT(figures["waiting"].get<double>(), 0) << "it came to an end by itself: make the network larger";
  EXPECT_EQ(figures["gap"], 1);
  EXPECT_NE(found.outcome.out.find("were not loaded before it was stopped"), std::string::npos) << found.outcome.out;
}

// Six files of many houses, each of which takes longer than is waited; the scene that they were to come into stays as it is.
TEST(Interrupt, EndsAnImportAndLeavesTheSceneAlone) {
  const Workplace place;
  std::string text = R"({"type": "FeatureCollection", "features": [)";
  for (int k = 0; k < 60000; ++k) {
    const double x = 15.0 * (k % 250), y = 15.0 * (k / 250);
    const auto corner = [](double a, double b) { return "[" + std::to_string(a) + "," + std::to_string(b) + "]"; };
    text += (k > 0 ? ",\n" : "") + std::string(R"({"type": "Feature", "properties": {"height": 9}, "geometry": )") +
            R"({"type": "Polygon", "coordinates": [[)" + corner(x, y) + "," + corner(x + 10, y) + "," + corner(x + 10, y + 10) +
            "," + corner(x, y + 10) + "," + corner(x, y) + "]]}}";
  }
  std::string files;
  for (int k = 0; k < 6; ++k) {
    const std::string name = "town" + std::to_string(k) + ".geojson";
    place.write(name, text + "]}");
    files += name + " ";
  }
  place.write("s.json", moving_scene());
  const auto found = interrupt(place, "import " + files + "--crs local --into s.json --out s_town.json --report account.csv");
  expect_at_once(found);
  EXPECT_FALSE(std::filesystem::exists(place.path("s_town.json")));
  EXPECT_EQ(place.text("s.json"), moving_scene());
  EXPECT_NE(found.outcome.err.find("stopped"), std::string::npos) << found.outcome.out << found.outcome.err;
}

TEST(Interrupt, EndsAComparisonAndWritesThePage) {
  if (test::kIsSanitized) GTEST_SKIP() << "others of these tests end the same way";
  const Workplace place;
  place.write("a.json", moving_scene());
  place.write("b.json", moving_scene());
  const auto found = interrupt(place, "compare a.json b.json --ticks 100000000 --report page.html");
  expect_at_once(found);
  EXPECT_TRUE(std::filesystem::exists(place.path("page.html")));
}

}  // namespace
}  // namespace bl::test
