// Opening, saving and recovering a scene.
#include "ui/desktop/document/document.h"

#include <filesystem>

#include "core/file/file_io.h"
#include "core/guest/joining.h"
#include "core/guest/room_guest.h"
#include "core/reading/figures.h"
#include "ui/desktop/document/named_files.h"

namespace bl::desktop {

namespace {

// How the window signs what is done in it.
constexpr const char* kAuthor = "desk";
constexpr const char* kOrigin = "window";

}  // namespace

Document::Document(const Registry& registry, std::string path) : registry_(&registry) {
  (is_shipped(path) ? origin_ : path_) = std::move(path);
  static std::uint64_t made = 0;
  id_ = ++made;
}

Document::~Document() = default;

const std::string& shipped_folder() {
  static const std::string folder = BL_SCENES_DIR;
  return folder;
}

bool is_shipped(const std::string& path) {
  namespace files = std::filesystem;
  std::error_code error;
  static const files::path shipped = files::weakly_canonical(shipped_folder(), error);
  // Links lead to what they point at: another name of the same file is no copy of it.
  const files::path real = files::weakly_canonical(path, error);
  if (path.empty() || error) return false;
  const files::path inside = real.lexically_relative(shipped);
  return !inside.empty() && *inside.begin() != "..";
}

std::unique_ptr<Document> Document::open(const Registry& registry, const std::string& path, int threads,
                                         std::vector<Problem>& problems) {
  auto text = read_file(path);
  if (!text) {
    problems.push_back({true, text.error()});
    return nullptr;
  }
  return from_text(registry, *text, path, threads, problems);
}

std::unique_ptr<Document> Document::from_text(const Registry& registry, const std::string& text, const std::string& path,
                                              int threads, std::vector<Problem>& problems) {
  SceneReading reading = read_scene(text, registry);
  problems.insert(problems.end(), reading.problems.begin(), reading.problems.end());
  if (!reading.is_usable()) return nullptr;
  const SavedState* state = reading.state ? &*reading.state : nullptr;
  auto host = host::Host::start(registry, reading.scene, state, {.author = kAuthor, .origin = kOrigin, .threads = threads});
  if (!host) {
    problems.push_back({true, host.error().within("state")});
    return nullptr;
  }
  std::unique_ptr<Document> document(new Document(registry, path));
  document->host_ = std::move(*host);
  document->running_ = document->host_.get();
  document->host_->begin_journal(document->source(), write_scene(reading.scene, registry, state));
  if (!path.empty()) document->saved_ = std::move(reading.scene);  // without a file there is nothing that holds it
  document->read_imports(problems);
  return document;
}

std::unique_ptr<Document> Document::recover(const Registry& registry, const host::Journal::UnsavedJournal& remains, int threads,
                                            std::vector<Problem>& problems) {
  auto document = from_text(registry, remains.log.scene, remains.scene_path, threads, problems);
  if (!document) return nullptr;
  for (Error& misfit : document->host_->recover(remains.log.entries)) problems.push_back({false, std::move(misfit)});
  document->saved_.reset();  // whatever the file holds, it does not hold this
  return document;
}

Result<std::unique_ptr<Document>> Document::join(const Registry& registry, const std::string& address, int threads,
                                                 PersonSettings& person) {
  const auto room = guest::room_named(address);
  if (!room) return room.error();
  guest::JoinOptions how{.token = {}, .name = {}, .outbox = {}, .threads = threads, .keep_token = {}};
  if (!person.file.empty()) how.outbox = (std::filesystem::path(person.file).parent_path() / "outbox").string();
  if (const auto seat = person.seats.find(*room); seat != person.seats.end()) how.token = seat->second;
  how.keep_token = [&person, where = *room](const std::string& token) {
    if (token.empty()) person.seats.erase(where);
    else person.seats[where] = token;
    (void)write_person_settings(person);  // a seat that is not kept is taken anew
  };
  auto guest = guest::join_room(registry, address, std::move(how));
  if (!guest) return guest.error();
  std::unique_ptr<Document> document(new Document(registry, ""));
  document->guest_ = std::move(*guest);
  document->running_ = document->guest_.get();
  return document;
}

std::string Document::name() const {
  if (guest_) return (guest_->people().title.empty() ? "" : guest_->people().title + ", ") + "room " + guest_->code();
  if (!path_.empty()) return std::filesystem::path(path_).filename().string();
  return origin_.empty() ? "Untitled scene" : std::filesystem::path(origin_).stem().string() + " (copy, not saved yet)";
}

std::string Document::folder() const { return std::filesystem::path(source()).parent_path().string(); }

// As a step of its own, because ticks and undo have to see it too: its gesture, or 0 where all files are found as they are.
std::int64_t Document::name_files_from(const NamedFiles& named) {
  const auto note = [this](const std::string& sentence) { save_note_ += (save_note_.empty() ? "" : " ") + sentence; };
  if (!named.secrets.empty()) {
    std::string names;
    for (const std::string& name : named.secrets) names += (names.empty() ? "" : ", ") + name;
    note("Passwords and certificates were not copied: put " + names + " beside the new file.");
  }
  if (named.commands.empty()) return 0;
  const std::int64_t gesture = running_->new_gesture();
  if (auto done = submit(named.commands, gesture, "Name files from the new folder"); !done)
    return 0;  // somebody has taken the node away: then it names no file any more
  if (!named.copies.empty())
    note(reading::counted(named.copies.size(), "recorded table") +
         " copied into the scene's new folder, since recordings are played from there only.");
  if (const std::size_t rest = named.commands.size() - named.copies.size(); rest > 0)
    note(reading::counted(rest, "file") +
         " that the scene uses stayed in place; the scene now refers to them from its new folder.");
  return gesture;
}

namespace {

Result<void> copy_all(const std::vector<std::pair<std::string, std::string>>& copies) {
  for (const auto& [from, to] : copies) {
    const auto text = read_file(from);
    if (!text) return text.error();
    if (auto written = write_file(to, *text); !written) return written;
  }
  return {};
}

}  // namespace

Result<void> Document::save(const std::string& path) {
  if (is_shipped(path))
    return Error{ErrorCode::conflict, path,
                 "The scenes in this folder come with the program and are not overwritten: choose another folder."};
  save_note_.clear();
  if (guest_) {
    // A copy for this person: the room keeps its own.
    const SavedState state = bl::save(*running_->coming_state());
    save_note_ = "This is a copy. What is done in the room is stored there, and not in this file.";
    return write_file(path, write_scene(scene(), *registry_, state.tick > 0 ? &state : nullptr));
  }
  const NamedFiles named = files_named_from(scene(), folder(), std::filesystem::path(path).parent_path().string());
  const std::int64_t gesture = name_files_from(named);
  // Scene and running state of one and the same moment.
  const auto text_to_save = [this] {
    const SavedState state = bl::save(*running_->coming_state());
    return write_scene(scene(), *registry_, state.tick > 0 ? &state : nullptr);
  };
  const std::string text = text_to_save();
  const auto copied = copy_all(named.copies);
  const auto written = copied ? write_file(path, text) : copied;
  if (written) {
    path_ = path;
    origin_.clear();
    saved_ = scene();
    is_unsaved_ = false;
    compared_size_ = running_->log().size();
    write_imports(path);
  } else if (gesture != 0) {
    save_note_.clear();
    running_->abandon(gesture);
  }
  if (written) host_->begin_journal(source(), text);  // what was before it is safe
  return written;
}

std::string Document::imports_path(const std::string& scene_path) {
  return std::filesystem::path(scene_path).replace_extension(".import.csv").string();
}

void Document::add_imports(const importing::ImportReports& reports) {
  imports_.insert(imports_.end(), reports.begin(), reports.end());
  ++imports_revision_;
}

void Document::read_imports(std::vector<Problem>& problems) {
  if (source().empty()) return;
  const std::string path = imports_path(source());
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return;
  const auto text = read_file(path);
  auto reports = text ? importing::read_import_csv(*text) : Result<importing::ImportReports>(text.error());
  if (!reports)
    problems.push_back({false, {reports.error().code, path, reports.error().text() + " The scene itself is unchanged."}});
  else add_imports(*reports);
}

void Document::write_imports(const std::string& scene_path) {
  if (imports_.empty()) return;
  const std::string path = imports_path(scene_path);
  if (auto written = write_file(path, import_csv(imports_)); !written)
    save_note_ += (save_note_.empty() ? "" : " ") + ("The import report could not be written: " + written.error().text());
}

// What devices have said since the file was written is no change of anybody's: it is taken on in what is compared with, too.
bool Document::is_unsaved() {
  if (guest_) return guest_->standing().waiting > 0;
  if (!saved_) return true;
  const auto& log = running_->log();
  bool has_persons = false;
  for (; compared_size_ < log.size(); ++compared_size_) {
    const LogEntry& entry = log[compared_size_];
    if (entry.author.kind != AuthorKind::device) {
      has_persons = true;
      continue;
    }
    SceneEdit edit(*saved_, *registry_);
    if (!entry.is_command()) continue;
    (void)bl::apply(edit, entry.command);  // of a node that the file does not have, it says nothing
  }
  // Undone changes leave nothing to save: what counts is what people have said, not that it ran on.
  if (has_persons) is_unsaved_ = !(*saved_ == scene());
  return is_unsaved_;
}

Result<void> Document::save_log(const std::string& path) const {
  if (!host_) return Error{ErrorCode::conflict, path, "The log of a room is kept by its server."};
  return write_file(path, host_->log_text());
}

}  // namespace bl::desktop
