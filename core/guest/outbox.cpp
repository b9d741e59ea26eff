// One JSON object in a line: what was said, and what was answered. A line that a crash has cut off was never sent.
#include "core/guest/outbox.h"

#include <unistd.h>
#include <algorithm>
#include <filesystem>
#include <optional>

#include <nlohmann/json.hpp>

#include "core/define/json_text.h"
#include "core/file/descriptor.h"
#include "core/file/file_io.h"
#include "core/file/private_file.h"

namespace bl::guest {

namespace {

constexpr int kMostWindows = 32;  // of one room, on one computer

std::int64_t whole(const Json& json, const char* key) {
  return json.contains(key) && json[key].is_number_integer() ? json[key].get<std::int64_t>() : 0;
}

std::string text_at(const Json& json, const char* key) {
  return json.contains(key) && json[key].is_string() ? json[key].get<std::string>() : std::string();
}

std::string line_of(const Json& json) { return write_json_line(json) + "\n"; }

}  // namespace

Result<Outbox> Outbox::open(const std::string& stem, const std::string& run) {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::path(stem).parent_path();
  std::filesystem::create_directories(folder, error);
  std::filesystem::permissions(folder, std::filesystem::perms::owner_all, error);  // where the file system has rights
  std::optional<Outbox> chosen;
  for (int number = 1; number <= kMostWindows; ++number) {
    Outbox one(run);
    one.path_ = stem + "-" + std::to_string(number) + ".outbox";
    const bool is_there = std::filesystem::exists(one.path_, error);
    if (!is_there && chosen) break;
    const auto file = open_private_log(one.path_);
    if (!file && file.error().code == ErrorCode::duplicate) continue;
    if (!file) return file.error();
    one.file_.reset(*file);
    std::setvbuf(*file, nullptr, _IONBF, 0);  // what is written is at the system, whatever becomes of this program
    auto text = read_file(one.path_);
    if (!text) return text.error();
    text->resize(text->rfind('\n') + 1);  // also to nothing: npos + 1 is 0
    if (::ftruncate(::fileno(*file), static_cast<off_t>(text->size())) != 0) return io_error(one.path_, "cannot be written");
    one.read(*text);
    const bool has_waiting = !one.waiting_.empty();
    if (!chosen || has_waiting) chosen = std::move(one);
    if (has_waiting || !is_there) break;
  }
  if (!chosen) return Error{ErrorCode::io, stem, "too many windows of this room are open"};
  if (auto begun = chosen->write(chosen->first_line()); !begun) return begun.error();
  return std::move(*chosen);
}

void Outbox::read(const std::string& text) {
  length_ = static_cast<std::int64_t>(text.size());
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at);
    if (end == std::string::npos) break;
    const auto json = parse_json(std::string_view(text).substr(at, end - at));
    at = end + 1;
    if (!json || !json->is_object()) continue;
    if (std::string name = text_at(*json, "run"); !name.empty()) {
      run_ = std::move(name);
      last_id_ = whole(*json, "id");
      last_answered_ = whole(*json, "last_answered");
      last_gesture_ = whole(*json, "gesture");
    } else if (const std::int64_t said = whole(*json, "said"); said == last_id_ + 1) {
      last_id_ = said;
      last_gesture_ = std::max(last_gesture_, whole(*json, "gesture"));
      waiting_.push_back({said, text_at(*json, "frame"), text_at(*json, "what")});
    } else if (const std::int64_t answer = whole(*json, "answered"); answer > 0) {
      std::erase_if(waiting_, [&](const Sent& sent) { return sent.id == answer; });
      last_answered_ = std::max(last_answered_, answer);
    }
  }
}

std::string Outbox::first_line() const {
  return line_of({{"run", run_}, {"id", last_id_}, {"last_answered", last_answered_}, {"gesture", last_gesture_}});
}

Result<void> Outbox::write(const std::string& line) {
  if (!file_) return {};
  if (std::fwrite(line.data(), 1, line.size(), file_.get()) == line.size()) {
    length_ += static_cast<std::int64_t>(line.size());
    return {};
  }
  const Error error = io_error(path_, "cannot be written");
  std::clearerr(file_.get());
  (void)::ftruncate(::fileno(file_.get()), length_);  // half a line is worth nothing
  return error;
}

Result<void> Outbox::keep(Sent sent, std::int64_t gesture) {
  sent.id = last_id_ + 1;
  const Json said = {{"said", sent.id}, {"gesture", gesture}, {"what", sent.what}, {"frame", sent.frame}};
  if (auto kept = write(line_of(said)); !kept) return kept;
  last_id_ = sent.id;
  last_gesture_ = std::max(last_gesture_, gesture);
  waiting_.push_back(std::move(sent));
  return {};
}

bool Outbox::answered(std::int64_t id) {
  const auto found = std::find_if(waiting_.begin(), waiting_.end(), [&](const Sent& sent) { return sent.id == id; });
  if (found == waiting_.end()) return false;
  waiting_.erase(found);
  last_answered_ = std::max(last_answered_, id);
  // Without this line it is said once more, and answered as before.
  (void)write(line_of({{"answered", id}}));
  if (waiting_.empty() && length_ > kLongFile) shorten();
  return true;
}

void Outbox::go_on_behind(std::int64_t done) {
  if (done <= last_id_) return;
  last_id_ = done;
  // Should the line get lost, the next welcome says the same.
  (void)write(first_line());
}

// A crash in between leaves an empty file, which is as good as a new one: nothing waits.
void Outbox::shorten() {
  if (!file_ || ::ftruncate(::fileno(file_.get()), 0) != 0) return;
  length_ = 0;
  (void)write(first_line());
}

std::deque<Sent> Outbox::begin_anew(const std::string& run) {
  run_ = run;
  last_id_ = last_answered_ = last_gesture_ = 0;
  shorten();
  return std::exchange(waiting_, {});
}

}  // namespace bl::guest
