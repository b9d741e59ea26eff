// The actions that panels share: submit, undo, open, notify.
#include "ui/desktop/editor/editor.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <new>

#include <imgui.h>

#include "core/base/scarcity.h"
#include "core/base/text.h"
#include "core/guest/joining.h"
#include "core/guest/room_guest.h"
#include "core/host/device_door.h"

namespace bl::desktop {

namespace {

constexpr std::size_t kMostNotices = 4;

// That there is nothing is no error; that it does not fit any more is one, and says so itself.
void report_error(Editor& editor, const Error& error, const char* nothing) {
  const bool is_nothing = error.code == ErrorCode::not_found && error.place.empty();
  editor.notify(is_nothing ? NoticeKind::told : NoticeKind::error, is_nothing ? nothing : error.text());
}

// What was left because others have written there since is told in one sentence, the first place of all.
void tell_left(Editor& editor, const Result<TakenBack>& done, const char* nothing) {
  if (!done) return report_error(editor, done.error(), nothing);
  if (done->misfit) report_error(editor, *done->misfit, nothing);
  if (done->left.empty()) return;
  const std::size_t more = done->left.size() - 1;
  editor.notify(NoticeKind::told,
                "Not changed: " + text_of(done->left.front()) + (more == 0 ? "." : ", and " + std::to_string(more) + " more."));
}

}  // namespace

std::string fresh_key(const std::string& wish, const std::function<bool(const std::string&)>& is_taken) {
  std::string key = wish;
  for (int k = 2; is_taken(key); ++k) key = wish + "-" + std::to_string(k);
  return key;
}

std::string Editor::name_of(const std::string& node) const {
  const auto found = scene().nodes.find(node);
  return found == scene().nodes.end() || found->second.name.empty() ? node : found->second.name;
}

bool Editor::submit(const std::vector<Command>& commands, std::int64_t gesture, const std::string& label) {
  if (!document) return false;
  auto done = document->submit(commands, gesture, label);
  if (!done) notify(NoticeKind::error, done.error().text());
  return done.ok();
}

bool Editor::show(const std::vector<Command>& commands, std::int64_t gesture) {
  if (!document) return false;
  auto done = document->show(commands, gesture);
  if (!done) notify(NoticeKind::error, done.error().text());
  return done.ok();
}

void Editor::end_gesture(std::int64_t gesture) {
  if (!document) return;
  if (auto done = document->running().end_gesture(gesture); !done) notify(NoticeKind::error, done.error().text());
}

bool Editor::arrange(const JsonValue& patch, std::int64_t gesture) { return submit(command<SetView>({patch, false}), gesture); }

void Editor::undo() {
  if (!document) return;
  tell_left(*this, document->running().undo(), "Nothing to undo.");
}

void Editor::redo() {
  if (!document) return;
  tell_left(*this, document->running().redo(), "Nothing to redo.");
}

std::string Editor::fresh_id(const std::string& wish) const {
  // Two people who add something at the same moment give it two ids.
  const guest::RoomGuest* room = document->room();
  const std::string own = room == nullptr ? wish : wish + "_" + std::to_string(room->seat());
  return fresh_key(to_identifier(own),
                   [&](const std::string& id) { return scene().nodes.contains(id) || scene().links.contains(id); });
}

void Editor::point_at(Area where) {
  const ImGuiIO& io = ImGui::GetIO();
  const bool is_used = io.MouseDelta.x != 0 || io.MouseDelta.y != 0 || io.MouseWheel != 0 ||
                       std::any_of(std::begin(io.MouseClicked), std::end(io.MouseClicked), [](bool clicked) { return clicked; });
  if (is_used) area = where;
}

void Editor::notify(NoticeKind kind, std::string text) {
  text = bounded({ErrorCode::internal, "", std::move(text)}).message;
  std::erase_if(notices, [&](const Notice& n) { return n.text == text; });
  notices.push_back({.kind = kind, .text = std::move(text)});
  if (notices.size() > kMostNotices) notices.erase(notices.begin());
  go_on();
}

void Editor::list_problems(std::string file, std::vector<Problem> found) {
  problem_file = std::move(file);
  problems = std::move(found);
  for (Problem& problem : problems) problem.error.message = bounded({problem.error.code, "", problem.error.message}).message;
  ++problems_revision;
  go_on();
}

bool Editor::join(const std::string& address) {
  auto joined = Document::join(program, address, kTickThreads, person);
  if (!joined) {
    notify(NoticeKind::error, "This room cannot be joined: " + joined.error().text());
    return false;
  }
  person.remember(person.recent_rooms, address);
  list_problems("", {});
  take(std::move(*joined));
  return true;
}

const Other* Editor::holder_of(const std::string& node) const {
  const auto found = std::find_if(others.begin(), others.end(), [&](const Other& other) { return other.holds.contains(node); });
  return found == others.end() ? nullptr : &*found;
}

// What has come from the room since the last frame, in words and in colours.
void Editor::hear_room() {
  others.clear();
  guest::RoomGuest* room = document ? document->room() : nullptr;
  if (room == nullptr) {
    followed = 0;
    return;
  }
  for (const guest::Refused& refused : room->take_refusals())
    notify(NoticeKind::warning,
           refused.what + " was refused: " + refused.text +
               (refused.place.empty() || refused.text.find(refused.place) != std::string::npos ? std::string()
                                                                                               : " (" + refused.place + ")"));
  for (const std::string& notice : room->take_notices()) notify(NoticeKind::told, notice);
  for (const auto& [seat, where] : room->people().whereabouts) {
    const auto person_there = room->people().seats.find(seat);
    if (seat == room->seat() || person_there == room->people().seats.end()) continue;
    Other other;
    other.seat = seat;
    other.name = person_there->second.name;
    other.colour = colour_of_text(person_there->second.colour);
    other.holds.insert(where.holds.begin(), where.holds.end());
    if (!where.is_hidden) other.cursor = where.cursor;
    if (!where.camera.is_null()) other.camera = where.camera.text();
    others.push_back(std::move(other));
  }
  wake_at(now + std::max(0.0, room->next_turn() - host::real_clock().now()));
}

bool Editor::open(const std::string& wanted, bool plays) {
  if (guest::is_room_address(wanted)) return join(wanted);
  std::error_code error;
  const auto absolute = std::filesystem::absolute(wanted, error);
  const std::string path = error ? wanted : absolute.lexically_normal().string();
  std::vector<Problem> found;
  std::unique_ptr<Document> fresh;
  try {
    fresh = Document::open(program, path, kTickThreads, found);
  } catch (const std::bad_alloc&) {
    found = {{true, {ErrorCode::out_of_range, "", "The file is too large for this machine: " + memory_sentence()}}};
  }
  list_problems(path, std::move(found));
  if (!fresh) {
    notify(NoticeKind::error, document ? "This scene could not be opened; the problems list says why."
                                       : "This scene could not be opened; the start page says why.");
    return false;
  }
  person.remember(person.recent, path);
  take(std::move(fresh));
  document->running().play(plays);
  if (!problems.empty()) notify(NoticeKind::warning, "The scene was opened; the problems list says what is idle in it.");
  return true;
}

void Editor::take(std::unique_ptr<Document> fresh) {
  document = std::move(fresh);
  if (host::LiveSession* session = document->local())
    session->make_ticks_wait(serves_ticks && host::has_recordings(document->scene(), program));
  moment = document->running().moment();
  picks = {};
  panels = nullptr;
  script_watch.clear();
}

const Registry& Editor::types() const {
  if (!document) return program;
  const Scripts& scripts = scene().scripts;
  if (!scripts.texts().empty() && (held_.empty() || &held_.back().types(program) != &scripts.types(program)))
    held_.push_back(scripts);
  return scripts.types(program);
}

void Editor::begin_frame() {
  if (document)
    if (auto done = document->running().keep_up(); !done) notify(NoticeKind::error, done.error().text());
  hear_room();
  held_before_ = std::move(held_);
  held_.clear();
  (void)types();
}

}  // namespace bl::desktop
