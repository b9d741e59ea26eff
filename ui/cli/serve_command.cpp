// `serve`: opens rooms for scenes and session files, and serves them until it is stopped.
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include <nlohmann/json.hpp>

#include "core/define/json_text.h"
#include "core/file/file_io.h"
#include "core/serve/qr_code.h"
#include "core/serve/server.h"
#include "ui/cli/commands.h"
#include "ui/cli/interrupt.h"
#include "ui/cli/own_addresses.h"
#include "ui/cli/terminal.h"

namespace bl::cli {

namespace {

namespace fs = std::filesystem;

std::int64_t wall_time() {
  using namespace std::chrono;
  return duration_cast<milliseconds>(system_clock::now().time_since_epoch()).count();
}

// Four letters without vowels, so that no code is a word, and without L, which looks like I: 160 000 of them.
std::string new_code() {
  static constexpr std::string_view kLetters = "BCDFGHJKMNPQRSTVWXYZ";
  std::string code;
  for (const char byte : room::system_random_bytes(4)) code += kLetters[static_cast<unsigned char>(byte) % kLetters.size()];
  return code;
}

Result<void> write_invites(const std::string& path, const serve::Rooms& rooms) {
  Json all = Json::object();
  for (const auto& [code, room] : rooms) {
    all[code] = room->invites();
    all[code]["follow"] = room->follow_key();
  }
  return write_file(path, write_json(all) + "\n");
}

// What only the facilitator should see.
void tell_keys(const serve::RoomHost& room, const std::string& address) {
  complain(room.title() + ": the facilitator comes in by " + address + "#k=" + room.invites().at("facilitator"));
  complain(room.title() + ": a second laptop follows by --follow " + address + " --token " + room.follow_key());
}

// One line for scripts, the code for phones, and the keys.
void tell_addresses(const serve::Rooms& rooms, const std::string& server) {
  for (const auto& [code, room] : rooms) {
    const std::string address = server + "/" + code;
    print_line("room " + code + " at " + address);
    if (const auto code_picture = serve::qr_text(address); code_picture && isatty(STDOUT_FILENO) != 0) print_page(*code_picture);
    tell_keys(*room, address);
  }
}

// Whoever reads the file of keys finds the new ones there.
void tell_renewal(const ServeOptions& options, const serve::Rooms& rooms, const serve::RoomHost& room,
                  const std::string& server) {
  complain(room.title() + ": the facilitator has renewed the keys. Invitations of before open no seat any more.");
  tell_keys(room, server + "/" + room.code());
  if (options.invites.empty()) return;
  if (auto written = write_invites(options.invites, rooms); !written) print_error(options.invites, written.error());
}

// Whoever has changed the scene since expects it in the room.
void tell_going_on(const serve::RoomHost& room, const std::string& journal, const std::string& source) {
  complain(room.title() + ": goes on with " + journal + ", with its people, votes and scene. What stands in " + source +
           " now is not read. For a new session give another --journal, or move the file away.");
}

// One for each source. False where one cannot be opened, which it has said.
bool open_rooms(const ServeOptions& options, serve::RoomHostOptions how, serve::Rooms& rooms) {
  for (const std::string& source : options.sources) {
    std::string code = new_code();
    while (rooms.contains(code)) code = new_code();
    if (options.is_live) how.live = live::LiveOptions{fs::path(source).parent_path().string(), true, {}};
    const std::string journal = journal_of(options, source);
    std::error_code ignored;
    const bool goes_on = journal != source && fs::exists(journal, ignored) && fs::file_size(journal, ignored) > 0;
    auto room = serve::RoomHost::open(journal, code, source, how);
    if (!room) {
      print_error(source, room.error());
      return false;
    }
    if (goes_on) tell_going_on(**room, journal, source);
    code = (*room)->code();
    if (!rooms.emplace(code, std::move(*room)).second) {
      print_error(source, {ErrorCode::duplicate, "", "a room with the code " + code + " is open already"});
      return false;
    }
  }
  return true;
}

}  // namespace

std::string journal_of(const ServeOptions& options, const std::string& source) {
  if (fs::path(source).extension() == ".blsession") return source;
  const std::string name = fs::path(source).stem().string() + ".blsession";
  if (options.journal.empty()) return name;
  std::error_code ignored;
  return fs::is_directory(options.journal, ignored) || options.sources.size() > 1 ? (fs::path(options.journal) / name).string()
                                                                                  : options.journal;
}

int serve_command(ServeOptions options) {
  const bool has_followed = !options.follow.empty();
  if (!has_followed && options.sources.empty()) {
    print_error("serve", {ErrorCode::missing, "", "expects a scene, a session file, or --follow"});
    return kBadInput;
  }
  if (options.is_checking) return check_before_serving(options);
  if (has_followed)
    if (const auto code = follow_room(options)) return *code;
  serve::ServerOptions how{.address = options.bind,
                           .port = static_cast<std::uint16_t>(options.port),
                           .page_folder = options.page,
                           .certificate = options.certificate,
                           .key = options.key,
                           .proxy = options.proxy};
  if (how.page_folder.empty())
    if (const char* page = std::getenv("BEHAVIOURLINKS_PAGE")) how.page_folder = page;
  std::error_code none;
  if (!how.page_folder.empty() && !fs::exists(fs::path(how.page_folder) / "index.html", none))
    complain(how.page_folder +
             " holds no built page: people get pages without scripts. ui/web/build.sh builds it into build/web.");
  const fs::path stored = fs::absolute(journal_of(options, options.sources.front()));
  how.watched_folder = stored.parent_path().string();
  auto server = serve::Server::open(how);
  if (!server) {
    print_error("serve", server.error());
    return kBadInput;
  }
  serve::Rooms& rooms = (*server)->rooms();
  serve::RoomHostOptions room_options;
  room_options.allowances = {.scripts = options.scripts, .live = options.is_live};
  room_options.wall_time = wall_time;
  room_options.takes_over = has_followed;
  const std::vector<std::string> addresses = own_addresses(options, (*server)->port());
  if (options.proxy.empty()) room_options.addresses = addresses;  // else people know the proxy's
  room_options.keys_renewed = [&](const serve::RoomHost& room) { tell_renewal(options, rooms, room, addresses.front()); };
  room_options.surroundings = [&server] { return (*server)->surroundings(); };
  room_options.on_own_thread = [&server](std::function<void()> task) { (*server)->post(std::move(task)); };
  if (!open_rooms(options, std::move(room_options), rooms)) return kBadInput;
  if (!options.invites.empty())
    if (auto written = write_invites(options.invites, rooms); !written) {
      print_error(options.invites, written.error());
      return kBadInput;
    }
  catch_interrupts();             // whoever has read that it is ready may end it at once
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is a disk that is full, and no reason to end
  tell_addresses(rooms, addresses.front());
  if (options.certificate.empty()) complain("Without a certificate everybody in this network can read along.");
  // Signals set a flag; this thread looks at it, because a handler may not do more.
  std::thread watch([&server] {
    while (!is_interrupted()) std::this_thread::sleep_for(std::chrono::milliseconds(100));
    (*server)->stop();
  });
  (*server)->run();
  watch.join();
  return kDone;
}

}  // namespace bl::cli
