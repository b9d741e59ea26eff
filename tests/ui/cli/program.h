// Runs the built program as people do: arguments in, exit code and text out, in a folder of its own.
#pragma once

#include <sys/wait.h>
#include <unistd.h>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace bl::test {

struct Outcome {
  int code = -1;
  std::string out, err;
  /// Standard output without its line feed at the end, from the last line feed on.
  std::string last_line() const {
    const std::string text = out.substr(0, out.find_last_not_of('\n') + 1);
    return text.substr(text.rfind('\n') == std::string::npos ? 0 : text.rfind('\n') + 1);
  }
};

inline std::string read_text(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// The program stands beside the tests in the build folder: build/X/tests/ui_cli_tests and build/X/ui/cli/behaviourlinks.
inline std::filesystem::path program_path() {
#ifdef BL_PROGRAM
  return BL_PROGRAM;
#else
  return std::filesystem::read_symlink("/proc/self/exe").parent_path().parent_path() / "ui/cli/behaviourlinks";
#endif
}

/// A folder that is gone with its owner, and the program run inside it.
class Workplace {
 public:
  Workplace() {
    std::string pattern = (std::filesystem::temp_directory_path() / "behaviourlinks-XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
  }
  ~Workplace() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  Workplace(const Workplace&) = delete;
  Workplace& operator=(const Workplace&) = delete;

  std::filesystem::path path(const std::string& name) const { return folder_ / name; }
  void write(const std::string& name, const std::string& text) const { std::ofstream(path(name), std::ios::binary) << text; }
  std::string text(const std::string& name) const { return read_text(path(name)); }
  nlohmann::json json(const std::string& name) const { return nlohmann::json::parse(text(name)); }

  /// `before`: shell commands that go before the program, such as limits; `after` what follows it, such as `& sleep 1`.
  Outcome shell(const std::string& line) const {
    const std::string full = "cd '" + folder_.string() + "' && export BEHAVIOURLINKS='" + program_path().string() + "' && { " +
                             line + "\n} >.out 2>.err </dev/null";
    const int status = std::system(full.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), text(".out"), text(".err")};
  }
  Outcome run(const std::vector<std::string>& arguments) const { return start("\"$BEHAVIOURLINKS\"", arguments); }
  /// The bench, which stands in build/X/tests/bench.
  Outcome bench(const std::vector<std::string>& arguments) const {
    return start("\"$(dirname \"$BEHAVIOURLINKS\")\"/../../tests/bench/behaviourlinks-bench", arguments);
  }

 private:
  Outcome start(std::string line, const std::vector<std::string>& arguments) const {
    for (const std::string& argument : arguments) {
      std::string quoted;
      for (const char c : argument) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
      line += " '" + quoted + "'";
    }
    return shell(line);
  }

  std::filesystem::path folder_;
};

/// A scene of a box of 40 by 40 by 20 m with a solver, and whatever nodes and links are added.
inline std::string scene_text(const std::string& nodes, const std::string& links = "", const std::string& boundary = "{}") {
  return R"({"format": "behaviourlinks", "version": 1, "nodes": [
    {"id": "site", "types": {"boundary": )" +
         boundary + R"(}}, {"id": "solver", "types": {"smart_volumes_solver": {}}})" + (nodes.empty() ? "" : ",\n" + nodes) +
         "], \"links\": [" + links + "]}\n";
}

inline std::string volume_text(const std::string& id, const std::string& position, const std::string& demand = "1000") {
  return R"({"id": ")" + id + R"(", "position": )" + position + R"(, "types": {"smart_volume": {"use": "housing", "demand": )" +
         demand + "}}}";
}

/// Two volumes that settle side by side, and a third that one of them keeps at a distance, so that something moves.
inline std::string moving_scene() {
  return scene_text(
      volume_text("east", "[8, 0, 8]") + "," + volume_text("west", "[-8, 0, 8]", "2000") + "," +
          volume_text("guest", "[9, 3, 8]", "500"),
      R"({"id": "apart", "kind": "keep_distance", "from": "east", "to": "guest", "parameters": {"minimum": 14, "maximum": 18}})");
}

}  // namespace bl::test
