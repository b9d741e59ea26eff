// `serve --check`: what a session needs is measured before the day, and each figure gets a verdict.
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "core/define/json_text.h"
#include "core/file/file_io.h"
#include "core/host/self_test.h"
#include "core/journal/journal.h"
#include "core/reading/figures.h"
#include "core/room/room_state.h"
#include "core/serve/readiness.h"
#include "core/serve/server.h"
#include "ui/cli/commands.h"
#include "ui/cli/finding_lines.h"
#include "ui/cli/own_addresses.h"
#include "ui/cli/terminal.h"

namespace bl::cli {

namespace {

namespace fs = std::filesystem;
using serve::Finding;
using serve::Verdict;

struct OpenRooms {
  std::vector<std::string> codes;
  std::map<std::string, std::size_t> reached;  // by own address
};

// GET /health of whoever listens at this port of this computer. Nothing where it is no server of rooms, or one that encrypts.
std::optional<OpenRooms> rooms_at(int port) {
  const int link = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (link < 0) return std::nullopt;
  timeval patience{.tv_sec = 2, .tv_usec = 0};
  ::setsockopt(link, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  ::setsockopt(link, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
  sockaddr_in where{};
  where.sin_family = AF_INET;
  where.sin_port = htons(static_cast<std::uint16_t>(port));
  where.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const std::string request = "GET /health HTTP/1.1\r\nHost: 127.0.0.1\r\nConnection: close\r\n\r\n";
  std::string answer;
  // The functions of sockets take addresses of all kinds under one name.
  if (::connect(link, reinterpret_cast<const sockaddr*>(&where), sizeof where) == 0 &&
      ::send(link, request.data(), request.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(request.size())) {
    char part[4096];
    constexpr std::size_t kMost = 1 << 20;
    for (ssize_t count = 0; answer.size() < kMost && (count = ::recv(link, part, sizeof part, 0)) > 0;)
      answer.append(part, static_cast<std::size_t>(count));
  }
  ::close(link);
  const std::size_t body = answer.find("\r\n\r\n");
  const Json json = body == std::string::npos ? Json() : Json::parse(answer.substr(body + 4), nullptr, false);
  if (!json.is_object() || !json.contains("rooms") || !json["rooms"].is_array()) return std::nullopt;
  OpenRooms rooms;
  for (const Json& room : json["rooms"])
    if (room.is_object() && room.contains("code") && room["code"].is_string())
      rooms.codes.push_back(room["code"].get<std::string>());
  if (const auto reached = json.find("reached"); reached != json.end() && reached->is_object())
    for (const auto& [address, count] : reached->items())
      if (count.is_number_unsigned()) rooms.reached[address] = count.get<std::size_t>();
  return rooms;
}

struct PortCheck {
  Finding finding;
  std::optional<OpenRooms> rooms;
};

PortCheck check_port(const ServeOptions& options) {
  const std::string port = std::to_string(options.port);
  // The server itself tries; the certificate has a line of its own.
  const auto server = serve::Server::open({.address = options.bind,
                                           .port = static_cast<std::uint16_t>(options.port),
                                           .page_folder = {},
                                           .certificate = {},
                                           .key = {},
                                           .watched_folder = {},
                                           .proxy = options.proxy});
  if (server && options.port == 0)
    return {{Verdict::look, "port", "Any free port is taken, so the address is another one each time. Choose one, such as 8080."},
            {}};
  if (server) return {{Verdict::good, "port", "Port " + port + " is free."}, {}};
  if (server.error().code != ErrorCode::io || !server.error().place.starts_with("port "))
    return {{Verdict::bad, "port", server.error().text() + "."}, {}};
  auto rooms = rooms_at(options.port);
  if (!rooms) return {{Verdict::bad, "port", "P" + server.error().text().substr(1) + "."}, {}};
  std::string codes;
  for (const std::string& code : rooms->codes) codes += (codes.empty() ? "" : ", ") + code;
  return {{Verdict::look, "port", "Port " + port + " has an open room already: " + codes + ". Another room needs another port."},
          std::move(rooms)};
}

Finding check_encryption(const ServeOptions& options) {
  if (options.certificate.empty())
    return {Verdict::look, "encryption",
            "Without a certificate everybody in this network can read along. Use a Wi-Fi of your own with a password, "
            "and ask for no names."};
  using namespace std::chrono;
  const std::int64_t now = duration_cast<milliseconds>(system_clock::now().time_since_epoch()).count();
  const bool is_known = options.proxy.empty() || !options.name.empty();  // else people open the proxy's address
  const std::vector<std::string> hosts = is_known ? own_hosts(options) : std::vector<std::string>();
  Finding finding = serve::judge_certificate(serve::read_certificate(options.certificate, options.key, hosts), hosts, now);
  if (finding.verdict == Verdict::bad) return finding;
  // The server itself tries: it refuses some that can be read, such as those with a weak key.
  const auto server = serve::Server::open({.address = "127.0.0.1",
                                           .port = 0,
                                           .page_folder = {},
                                           .certificate = options.certificate,
                                           .key = options.key,
                                           .watched_folder = {},
                                           .proxy = {}});
  return server ? finding : Finding{Verdict::bad, "encryption", server.error().text() + "."};
}

std::vector<Finding> check_network(const ServeOptions& options, const serve::Machine& machine, const PortCheck& port) {
  std::vector<Finding> findings{port.finding};
  const bool is_everywhere = options.bind == "0.0.0.0" || options.bind == "::";
  bool has_any = false;
  for (const serve::NetworkAddress& one : serve::network_addresses()) {
    if (!is_everywhere && one.address != options.bind) continue;
    has_any = true;
    std::optional<std::size_t> reached;
    if (port.rooms) {
      const auto found = port.rooms->reached.find(one.address);
      reached = found == port.rooms->reached.end() ? 0 : found->second;
    }
    findings.push_back(serve::judge_address(one, url_of(options, one.address, options.port), machine, reached));
  }
  if (!has_any && (is_everywhere || serve::is_own_address(options.bind)))
    findings.push_back({Verdict::bad, "network",
                        "No other device can open the room: " +
                            (is_everywhere ? std::string("this computer is in no network. Join the Wi-Fi of the session.")
                                           : options.bind + " is an address of this computer alone. Choose another --bind.")});
  findings.push_back(check_encryption(options));
  return findings;
}

// The scene with which the room would begin or go on.
Result<SceneReading> scene_of(const std::string& source) {
  if (fs::path(source).extension() != ".blsession") {
    const auto text = read_file(source);
    if (!text) return text.error();
    return read_scene(*text, full_registry());
  }
  const auto journal = journal::Journal::open_to_read(source, full_registry());
  if (!journal) return journal.error();
  const auto loaded = (*journal)->load();
  if (!loaded) return loaded.error();
  const auto text = loaded->snapshot ? journal::unpack(loaded->snapshot->scene) : Result<std::string>(loaded->room.scene);
  if (!text) return text.error();
  return read_scene(*text, full_registry());
}

Finding describe_scene(const Scene& scene) {
  std::size_t cards = 0, votes = 0;
  for (const auto& [id, node] : scene.nodes) {
    cards += node.types.contains("stakeholder_group") ? 1 : 0;
    votes += node.types.contains("vote") ? 1 : 0;
  }
  const std::string text = reading::counted(scene.nodes.size(), "node") + ", " + reading::counted(cards, "role card") + ", " +
                           reading::counted(votes, "vote") + ".";
  if (cards > 0 || votes > 0) return {Verdict::good, "scene", text};
  return {Verdict::look, "scene",
          text +
              " People can comment, and designers can change things. Role cards and votes are nodes that "
              "are made before the session."};
}

// What is told and refuses no file, such as a role card that names a value that is not there: the holder of the card would find
// out.
void add_warnings(const std::string& source, const std::vector<Problem>& problems, std::vector<Finding>& findings) {
  const auto is_warning = [](const Problem& problem) { return !problem.is_error; };
  const auto first = std::find_if(problems.begin(), problems.end(), is_warning);
  if (first == problems.end()) return;
  const auto count = static_cast<std::size_t>(std::count_if(problems.begin(), problems.end(), is_warning));
  std::string text = first->error.within(source).text();
  if (!text.ends_with('?')) text += '.';
  if (count > 1) text += " `behaviourlinks check` lists this and " + std::to_string(count - 1) + " more.";
  findings.push_back({Verdict::look, "scene", std::move(text)});
}

void check_scene(const std::string& source, const PortCheck& port, std::vector<Finding>& findings) {
  const auto reading = scene_of(source);
  if (!reading) {
    // While a room is open, its file is its own.
    const bool is_open_here = port.rooms && reading.error().text().find("has this file open") != std::string::npos;
    return findings.push_back({is_open_here ? Verdict::look : Verdict::bad, "scene", reading.error().text() + "."});
  }
  std::optional<Error> fault;
  if (!reading->is_usable()) fault = reading->first_error();
  const std::vector<Problem> problems = check_scene(reading->scene, full_registry());
  for (const Problem& problem : problems)
    if (problem.is_error && !fault) fault = problem.error;
  if (fault) return findings.push_back({Verdict::bad, "scene", fault->within(source).text() + "."});
  findings.push_back(describe_scene(reading->scene));
  add_warnings(source, problems, findings);
  if (const auto ticks = serve::measure_ticks(reading->scene))
    findings.push_back(serve::judge_ticks(*ticks, room::RoomState().rate));
  else findings.push_back({Verdict::bad, "ticks", ticks.error().text() + "."});
}

std::vector<Finding> check_disk(const std::string& journal) {
  const std::string folder = fs::absolute(journal).parent_path().string();
  std::vector<Finding> findings;
  if (const auto times = serve::measure_commits(folder)) {
    findings.push_back(serve::judge_commits(*times));
  } else {
    findings.push_back({Verdict::bad, "disk",
                        "No session file can be written into " + folder + ": " + times.error().message +
                            ". Choose another folder, or make this one and allow writing to it."});
  }
  if (std::error_code ignored; fs::exists(journal, ignored))
    findings.push_back({Verdict::look, "file",
                        journal + " is there already. Its session goes on, with its people, votes and scene. "
                                  "For a new session choose another file."});
  return findings;
}

Finding check_invites(const std::string& path) {
  if (path.empty())
    return {Verdict::good, "invites",
            "The facilitator gets a key when the room opens, and sees the keys of the other roles in the room."};
  struct stat status {};
  const bool is_there = ::stat(path.c_str(), &status) == 0;
  if (auto may = may_write_file(path); !may) return {Verdict::bad, "invites", may.error().text() + "."};
  if (is_there && (status.st_mode & (S_IRGRP | S_IROTH)) != 0)
    return {Verdict::look, "invites",
            path + " can be read by others who use this computer. Who has a key comes in by it: chmod 600."};
  return {Verdict::good, "invites", "The keys of all roles are written into " + path + ". Who has a key comes in by it."};
}

std::vector<Finding> check_people(const ServeOptions& options) {
  std::vector<Finding> findings{check_invites(options.invites)};
  const char* named = std::getenv("BEHAVIOURLINKS_PAGE");
  const std::string page = !options.page.empty() ? options.page : named != nullptr ? named : "";
  std::error_code ignored;
  if (!page.empty() && fs::exists(fs::path(page) / "index.html", ignored))
    findings.push_back({Verdict::good, "page", "The page for phones is built."});
  else
    findings.push_back(
        {Verdict::look, "page",
         "The page for phones is not built. Phones get a simple one: plan, votes and comments. `./bl serve` builds it, "
         "which needs the Internet once."});
  findings.push_back(
      {Verdict::good, "consent",
       "Before people join, they read that no name is needed and what is stored. Say who keeps the session file."});
  return findings;
}

Finding check_numbers() {
  const host::SelfTest& self = host::self_test();
  const bool is_sound = !self.fingerprint.starts_with("unusable");
  return {is_sound ? Verdict::good : Verdict::bad, "numbers",
          is_sound ? "The self-test gives " + self.fingerprint +
                         ". Windows on other computers compute along where theirs gives the same."
                   : "The self-test cannot run: " + self.fingerprint + ". Install the program again."};
}

}  // namespace

int check_before_serving(const ServeOptions& options) {
  const std::string journal = journal_of(options, options.sources.front());
  const serve::Machine machine = serve::read_machine("", fs::absolute(journal).parent_path().string());
  const PortCheck port = check_port(options);
  std::vector<Finding> findings;
  for (const std::string& source : options.sources) check_scene(source, port, findings);
  const auto add = [&findings](std::vector<Finding> more) { findings.insert(findings.end(), more.begin(), more.end()); };
  add(check_disk(journal));
  add({serve::judge_free_disk(machine.disk_free), serve::judge_memory(machine.memory_free), serve::judge_power(machine),
       serve::judge_clock(serve::is_clock_set()), check_numbers()});
  add(check_network(options, machine, port));
  add(check_people(options));
  const bool is_bad = print_findings(findings);
  if (!options.json.empty()) {
    Json all = Json::array();
    for (const Finding& f : findings)
      all.push_back({{"verdict", serve::word_of(f.verdict)}, {"subject", f.subject}, {"text", f.text}});
    if (auto written = write_file(options.json, write_json(all) + "\n"); !written) {
      print_error(options.json, written.error());
      return kBadInput;
    }
  }
  return is_bad ? kNotMet : kDone;
}

}  // namespace bl::cli
