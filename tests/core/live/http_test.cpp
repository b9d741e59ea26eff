// HTTP against a small server on the loopback: pages that are numbers, JSON, missing, endless or not there.
#include "tests/core/live/live_support.h"

namespace bl::live {
namespace {

using test::eventually;
using test::Folder;
using test::LiveWorld;
using test::Loopback;
using test::Program;
using test::sensor;

struct Server {
  Folder folder;
  int port = test::free_port();
  std::unique_ptr<Program> program;
  void start() {
    program = std::make_unique<Program>(std::vector<std::string>{"python3", "-m", "http.server", std::to_string(port), "--bind",
                                                                 "127.0.0.1", "--directory", folder.path()});
    ASSERT_TRUE(eventually([&] { return Loopback::is_open(port); }));
  }
  std::string page(const std::string& name) const { return "http://127.0.0.1:" + std::to_string(port) + "/" + name; }
};

TEST(Http, PagesAreAskedForAgainAndAgain) {
  Server server;
  server.folder.write("plain", "21.5\n");
  server.folder.write("json", R"({"now": {"ozone": 60}})");
  LiveWorld live(sensor("plain", server.page("plain"), R"(, "period": 0.1, "timeout": 0)") + "," +
                 sensor("json", server.page("json"), R"(, "field": "/now/ozone", "scale": 0.5, "period": 0.1, "timeout": 0)"));
  ASSERT_TRUE(live.steps_until([&] { return live.says("plain", "refuses the connection"); })) << live.message("plain");
  server.start();
  ASSERT_TRUE(live.steps_until([&] { return live.quality("plain") == "good" && live.quality("json") == "good"; }));
  EXPECT_EQ(live.number("plain"), 21.5);
  EXPECT_EQ(live.number("json"), 30);
  EXPECT_EQ(live.message("plain"), "");
  server.folder.write("plain", "22");
  EXPECT_TRUE(live.steps_until([&] { return live.number("plain") == 22; }));
  server.folder.write("plain", std::string(200000, '1'));
  EXPECT_TRUE(live.steps_until([&] { return live.says("plain", "the page is longer than the 65536 bytes"); }));
  EXPECT_EQ(live.quality("plain"), "invalid");
  EXPECT_EQ(live.number("plain"), 22);
  EXPECT_EQ(live.replayed(1), live.hash());
  EXPECT_EQ(live.replayed(2), live.hash());
}

TEST(Http, FailuresAreSentences) {
  Server server;
  server.start();
  LiveWorld live(sensor("missing", server.page("nothing"), R"(, "period": 0.1)") + "," +
                 sensor("nobody", "http://nowhere.invalid/x") + "," + sensor("file", "file:///etc/hostname"));
  EXPECT_TRUE(live.steps_until([&] { return live.says("missing", "the status 404"); })) << live.message("missing");
  EXPECT_TRUE(live.steps_until([&] { return live.says("nobody", "no host of that name"); })) << live.message("nobody");
  EXPECT_TRUE(live.says("file", "begins with none of")) << live.message("file");
}

TEST(Http, NothingIsConnectedToWithoutLeave) {
  Server server;
  server.folder.write("plain", "21.5\n");
  server.start();
  LiveWorld live(sensor("plain", server.page("plain"), R"(, "period": 0.1)"), "", {"", false, {}});
  for (int i = 0; i < 100; ++i) live.step();
  EXPECT_EQ(live.quality("plain"), "never");
  EXPECT_EQ(live.status("plain").node, "");
}

}  // namespace
}  // namespace bl::live
