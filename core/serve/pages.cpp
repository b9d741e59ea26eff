// Which request gets which answer.
#include "core/serve/pages.h"

#include <algorithm>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "core/base/moment.h"
#include "core/define/json_text.h"
#include "core/drawing/markup.h"
#include "core/export/option_text.h"
#include "core/file/file_io.h"
#include "core/minutes/minutes.h"
#include "core/room/secrets.h"
#include "core/serve/plain_page.h"
#include "core/serve/qr_code.h"
#include "core/wire/base64.h"

namespace bl::serve {

namespace {

Response sentence(int status, const std::string& text) {
  return {.status = status, .type = "text/plain; charset=utf-8", .body = text + "\n"};
}

Response moved(const std::string& where) {
  Response response = sentence(303, "See " + where);
  response.fields["Location"] = where;
  return response;
}

std::string type_of_file(const std::string& name) {
  static const std::map<std::string, std::string> kTypes = {{".html", "text/html; charset=utf-8"},
                                                            {".js", "text/javascript; charset=utf-8"},
                                                            {".css", "text/css; charset=utf-8"},
                                                            {".svg", "image/svg+xml"},
                                                            {".png", "image/png"},
                                                            {".json", "application/json"},
                                                            {".jsonl", "application/x-ndjson"},
                                                            {".csv", "text/csv; charset=utf-8"},
                                                            {".woff2", "font/woff2"},
                                                            {".webmanifest", "application/manifest+json"}};
  const auto found = kTypes.find(std::filesystem::path(name).extension().string());
  return found == kTypes.end() ? "application/octet-stream" : found->second;
}

// A name of the built page: letters, digits, `-`, `_` and single dots; nothing that leads out of its folder.
bool is_plain_name(const std::string& name) {
  const auto is_fine = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' || c == '.'; };
  return !name.empty() && name[0] != '.' && name.find("..") == std::string::npos &&
         std::all_of(name.begin(), name.end(), is_fine);
}

// Codes are typed on phones, in whatever case.
std::string code_in(std::string text) {
  std::erase_if(text, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); });
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

// The built page has its style and the beginning of its script in itself, which saves people on slow networks a round trip each.
// Only these exact texts are allowed (CSP level 3, 2.3.1): whatever else gets into the page does not run.
std::string inline_sources_of(const std::string& page) {
  std::string sources;
  for (const std::string tag : {"script", "style"}) {
    const std::string open = "<" + tag + ">", close = "</" + tag + ">";
    for (std::size_t at = page.find(open); at != std::string::npos; at = page.find(open, at)) {
      at += open.size();
      const std::size_t end = std::min(page.find(close, at), page.size());
      const std::string digits = room::digest_of(page.substr(at, end - at));
      std::string bytes;
      for (std::size_t k = 0; k < digits.size(); k += 2) bytes += static_cast<char>(std::stoi(digits.substr(k, 2), nullptr, 16));
      sources += " 'sha256-" + wire::base64_of(bytes) + "'";
    }
  }
  return sources;
}

}  // namespace

Response Pages::door(const std::string& mistaken) const {
  drawing::Markup page;
  page.raw(
      "<!doctype html><html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width\"><title>BehaviourLinks</title><link rel=\"stylesheet\" "
      "href=\"/plain.css\"></head><body><main><h1>Join a session</h1>");
  if (!mistaken.empty())
    page.raw("<p class=\"notice\" role=\"status\">There is no room with the code “")
        .text(code_in(mistaken).substr(0, 12))
        .raw("”. Look at the beamer, and type its four letters.</p>");
  page.raw(
      "<form method=\"get\" action=\"/\"><label for=\"code\">Code "
      "of the room</label><input id=\"code\" name=\"code\" autocomplete=\"off\" autocapitalize=\"characters\" "
      "required><button>Join</button></form></main></body></html>");
  return {.status = mistaken.empty() ? 200 : 404, .body = page.str()};
}

// What of the computer tells strangers nothing that they could use. Its addresses are told on this computer alone.
namespace {

Json machine_json(const Machine& machine) {
  Json json = Json::object();
  if (machine.battery) json["battery"] = *machine.battery;
  if (machine.is_on_mains) json["mains"] = *machine.is_on_mains;
  if (!machine.wireless.empty()) json["wireless"] = machine.wireless;
  if (machine.memory_free) json["memory_free"] = *machine.memory_free;
  if (machine.disk_free) json["disk_free"] = *machine.disk_free;
  return json;
}

}  // namespace

Response Pages::health(bool is_local) const {
  Json rooms = Json::array();
  double disk = 0;
  for (const auto& [code, room] : *rooms_) {
    const RoomHost::Health health = room->health();
    Json one = {{"code", code},        {"seats", health.seats}, {"guests", health.guests},
                {"tick", health.tick}, {"seq", health.seq},     {"hash", health.hash}};
    one["tick_ms"] = health.tick_seconds * 1000;
    if (health.waiting > 0) one["waiting"] = health.waiting;
    if (health.followers > 0) one["followers"] = health.followers;
    if (!health.problem.empty()) one["problem"] = health.problem;
    rooms.push_back(std::move(one));
    disk = std::max(disk, health.disk_seconds);
  }
  Json all = {{"rooms", rooms}, {"disk_ms", disk * 1000}};
  if (surroundings_) {
    const Surroundings around = surroundings_();
    all["machine"] = machine_json(around.machine);
    if (is_local) all["reached"] = around.reached;
  }
  return {.type = "application/json", .body = write_json_line(all) + "\n", .fields = {{"Cache-Control", "no-store"}}};
}

// The address as the one who asks has it: that is the one that others reach as well.
Response Pages::qr(const std::string& name, const Request& request) const {
  const std::string code = code_in(name.substr(0, name.find('.')));
  if (!rooms_->contains(code) || request.host.empty() || !name.ends_with(".svg"))
    return sentence(404, "There is no room with this code.");
  auto svg = qr_svg(request.scheme + "://" + request.host + "/" + code);
  return svg ? Response{.type = "image/svg+xml", .body = std::move(*svg), .fields = {{"Cache-Control", "no-cache"}}}
             : sentence(414, svg.error().message);
}

constexpr std::size_t kMostNotes = 1500;  // [bytes] before they are escaped

// What was made for one person alone, and is kept nowhere.
Response file_for_one(const Errands::Made& made) {
  Response response{.type = type_of_file(made.name), .body = made.content, .fields = {{"Cache-Control", "no-store"}}};
  response.fields["Content-Disposition"] = "attachment; filename=\"" + made.name.substr(made.name.rfind('/') + 1) + "\"";
  // Browsers take fields of some kilobytes; what is beyond that is counted.
  std::string notes;
  std::size_t told = 0;
  for (; told < made.notes.size() && notes.size() < kMostNotes; ++told) notes += (told == 0 ? "" : "\n") + made.notes[told];
  if (told < made.notes.size()) notes += "\nand " + std::to_string(made.notes.size() - told) + " more";
  // Fields of HTTP hold no line ends, and letters of English only.
  if (!notes.empty()) response.fields["Notes"] = form_text(notes);
  return response;
}

Response no_file(const std::string& what, const Error& error) {
  return sentence(error.code == ErrorCode::conflict ? 409 : 500, what + ": " + error.text() + ".");
}

// What somebody has asked for wrongly, or what this plan cannot give, is no fault of the server. Places of options are named as
// in commands, which nobody has typed here.
Response no_plan_file(const Error& error) {
  const bool is_ours = error.code == ErrorCode::conflict || error.code == ErrorCode::io || error.code == ErrorCode::internal;
  if (is_ours) return no_file("The file cannot be made", error);
  const std::string text = error.text();
  return sentence(400, (text.starts_with("--") ? text.substr(2) : text) + ".");
}

// A form, so that the token stands in no address. Rooms that there are not are answered as wrong tokens are: nobody learns codes
// here.
void Pages::minutes(const Request& request, const Reply& reply) const {
  auto fields = form_fields(request.body);
  const auto room = rooms_->find(code_in(fields["room"]));
  const std::int64_t seat = room == rooms_->end() ? 0 : room->second->seat_of_token(fields["token"]);
  if (room == rooms_->end() || !room->second->may_read_minutes(seat, fields["file"]))
    return reply(sentence(403, "Only who leads a room gets its minutes, and their page whoever it was shared with."));
  const auto zone = fields["zone"].empty() ? 0 : read_zone(fields["zone"]);
  if (!zone) return reply(sentence(400, "The field `zone` is UTC, or hours and minutes such as +01:00."));
  room->second->make_minutes(fields["file"], *zone, !room->second->leads(seat), [reply](const Result<Errands::Made>& made) {
    if (!made && made.error().code == ErrorCode::not_found) return reply(sentence(404, "These minutes have no such file."));
    if (!made) return reply(no_file("The minutes cannot be made", made.error()));
    Response response = file_for_one(*made);
    if (made->name == minutes::kMinutesPage) {
      response.inline_sources = inline_sources_of(response.body);
      response.fields.erase("Content-Disposition");
    }
    reply(std::move(response));
  });
}

// As minutes are asked for. The fields `option.NAME` are those of the format.
void Pages::plan_file(const Request& request, const Reply& reply) const {
  static constexpr std::string_view kOption = "option.";
  auto fields = form_fields(request.body);
  const auto room = rooms_->find(code_in(fields["room"]));
  if (room == rooms_->end() || !room->second->may_export(room->second->seat_of_token(fields["token"])))
    return reply(sentence(403, "Only who leads a room, and its designers, get files of its plan."));
  ExportWish wish{.format = fields["format"], .options = {}, .page_folder = folder_};
  for (const auto& [name, value] : fields)
    if (name.starts_with(kOption)) wish.options.push_back(name.substr(kOption.size()) + "=" + value);
  room->second->make_export(
      wish, [reply](const Result<Errands::Made>& made) { reply(made ? file_for_one(*made) : no_plan_file(made.error())); });
}

// The build leaves a packed file beside each one.
Response Pages::file(const std::string& path, bool is_immutable, bool takes_gzip) const {
  if (folder_.empty()) return sentence(404, "There is no such page.");
  auto packed = takes_gzip ? read_file(folder_ + "/" + path + ".gz") : Result<std::string>(Error{});
  auto content = packed ? std::move(packed) : read_file(folder_ + "/" + path);
  if (!content) return sentence(404, "There is no such page.");
  const bool is_packed = takes_gzip && content->starts_with("\x1f\x8b");
  Response response{.type = type_of_file(path), .body = std::move(*content)};
  response.fields["Cache-Control"] = is_immutable ? "public, max-age=31536000, immutable" : "no-cache";
  response.fields["Vary"] = "Accept-Encoding";
  if (is_packed) response.fields["Content-Encoding"] = "gzip";
  return response;
}

void Pages::answer(const Request& request, const Reply& reply) {
  const std::string path = path_of(request.target);
  const bool is_read = request.method == "GET" || request.method == "HEAD";
  if (!is_read && request.method != "POST") {
    Response response = sentence(405, "This server answers GET, HEAD and POST.");
    response.fields["Allow"] = "GET, HEAD, POST";
    return reply(std::move(response));
  }
  if (path.starts_with("/plain/")) {
    const std::string rest = path.substr(7);
    const std::size_t slash = rest.find('/');
    const auto room = rooms_->find(code_in(rest.substr(0, slash)));
    if (room == rooms_->end()) return reply(sentence(404, "There is no room with this code."));
    const std::string what = slash == std::string::npos ? "" : rest.substr(slash + 1);
    return plain(*room->second, request, what, reply);
  }
  // What joins people to a Wi-Fi holds its password: it comes as a form does, so that it stands in no address, and is kept
  // nowhere.
  if (!is_read && path == "/qr") {
    auto svg = qr_svg(request.body);
    return reply(svg ? Response{.type = "image/svg+xml", .body = std::move(*svg), .fields = {{"Cache-Control", "no-store"}}}
                     : sentence(414, svg.error().message));
  }
  if (!is_read && path == "/minutes") return minutes(request, reply);
  if (!is_read && path == "/export") return plan_file(request, reply);
  if (!is_read) return reply(sentence(404, "There is no such form."));
  if (path == "/health") return reply(health(request.is_local));
  if (path == "/formats")
    return reply({.type = "application/json", .body = exporting::formats_json(), .fields = {{"Cache-Control", "no-cache"}}});
  if (path.starts_with("/qr/")) return reply(qr(path.substr(4), request));
  if (path == "/plain.css")
    return reply({.type = "text/css; charset=utf-8", .body = plain_style(), .fields = {{"Cache-Control", "no-cache"}}});
  if (path.starts_with("/assets/")) {
    const std::string name = path.substr(8);
    return reply(is_plain_name(name) ? file("assets/" + name, true, request.takes_gzip)
                                     : sentence(404, "There is no such page."));
  }
  if (path == "/") {
    const std::size_t query = request.target.find('?');
    const auto fields =
        query == std::string::npos ? std::map<std::string, std::string>() : form_fields(request.target.substr(query + 1));
    const auto code = fields.find("code");
    if (code != fields.end() && rooms_->contains(code_in(code->second))) return reply(moved("/" + code_in(code->second)));
    return reply(door(code == fields.end() ? "" : code->second));
  }
  const auto room = rooms_->find(code_in(path.substr(1)));
  if (path.find_first_of("/.", 1) != std::string::npos) return reply(sentence(404, "There is no such page."));
  if (room == rooms_->end()) return reply(door(path.substr(1)));
  Response page = file("index.html", false, request.takes_gzip);
  if (page.status != 200) return reply(moved("/plain/" + room->first));
  page.inline_sources = inline_sources_of(file("index.html", false, false).body);
  return reply(std::move(page));
}

void Pages::plain(RoomHost& room, const Request& request, const std::string& what, const Reply& reply) {
  if (request.method != "POST")
    return reply(what.empty() ? Response{.body = plain_door(room, "")} : sentence(404, "There is no such page."));
  const auto fields = form_fields(request.body);
  const std::string token = fields.contains("token") ? fields.at("token") : "";
  const auto show = [&room, reply](std::int64_t seat, const std::string& key, const std::string& notice,
                                   const PlainWish* taken = nullptr) {
    reply({.body = plain_room(room, seat, key, notice, taken), .fields = {{"Cache-Control", "no-store"}}});
  };
  if (what == "join") {
    const auto admitted = room.admit_by_code();
    if (const auto* refusal = std::get_if<room::Refusal>(&admitted))
      return reply({.status = 403, .body = plain_door(room, refusal->text)});
    const auto& admission = std::get<room::Admission>(admitted);
    return room.when_stored([show, admission] { show(admission.seat, admission.token, ""); });
  }
  const std::int64_t seat = room.seat_of_token(token);
  if (seat == 0) return reply({.status = 403, .body = plain_door(room, "Your seat is gone; please join again.")});
  if (what.empty()) return show(seat, token, "");
  if (what != "vote" && what != "comment") return reply(sentence(404, "There is no such form."));
  const auto wish = what == "vote" ? wish_of_vote(room, seat, fields) : wish_of_comment(room, seat, fields);
  if (const auto* why = std::get_if<std::string>(&wish)) return show(seat, token, *why);
  const auto& asked = std::get<PlainWish>(wish);
  room.say_for(seat, asked.kind, asked.content, [show, seat, token, what, asked](const room::Answer& answer) {
    if (const auto* refusal = std::get_if<room::Refusal>(&answer)) return show(seat, token, "Not taken: " + refusal->text + ".");
    show(seat, token, what == "vote" ? "Your ballot is counted." : "Your comment is stored.", &asked);
  });
}

}  // namespace bl::serve
