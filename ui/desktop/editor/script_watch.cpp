// Makes set_script commands of files; one that cannot be read is listed among the problems, and its old version stays in force.
#include "ui/desktop/editor/script_watch.h"

#include <algorithm>

#include "core/making/script_file.h"
#include "ui/desktop/editor/editor.h"

namespace bl::desktop {

namespace {

constexpr double kLook = 0.3;  // between two looks at the files [s]

bool has_changed(const std::string& path, std::filesystem::file_time_type& written, std::uintmax_t& size) {
  std::error_code error;
  const auto time = std::filesystem::last_write_time(path, error);
  if (error) return false;  // an editor that saves by renaming may have it away for a moment
  const auto bytes = std::filesystem::file_size(path, error);
  if (error || (time == written && bytes == size)) return false;
  written = time;
  size = bytes;
  return true;
}

}  // namespace

void ScriptWatch::add(Editor& editor, const std::string& path) {
  const std::string name = making::script_name(path);
  File& file = files_[name];
  file.path = path;
  (void)has_changed(path, file.written, file.size);
  take(editor, name, file);
}

bool ScriptWatch::poll(Editor& editor) {
  if (!editor.document || editor.now < next_look_) return false;
  next_look_ = editor.now + kLook;
  bool has_news = false;
  for (auto& [name, file] : files_)
    if (has_changed(file.path, file.written, file.size)) {
      take(editor, name, file);
      has_news = true;
    }
  return has_news;
}

void ScriptWatch::take(Editor& editor, const std::string& name, const File& file) {
  const std::string place = "scripts/" + name;
  std::vector<Problem> problems = editor.problems;
  std::erase_if(problems, [&](const Problem& problem) { return problem.error.place == place; });
  const auto& texts = editor.scene().scripts.texts();
  const bool was_there = texts.contains(name);
  const auto command = making::script_command(file.path);
  const auto done = command ? editor.document->submit({*command}) : Result<void>(command.error());
  if (!done) problems.push_back({true, {done.error().code, place, done.error().message}});
  if (problems.size() != editor.problems.size() || !done) editor.list_problems(editor.problem_file, std::move(problems));
  if (!done) {
    return editor.notify(NoticeKind::error, done.error().message + (was_there ? " The old version stays in force." : ""));
  }
  const std::string& id = editor.scene().scripts.kinds().at(name);
  const std::string label = editor.types().link(id)->label;
  editor.notify(NoticeKind::told,
                was_there ? "\xe2\x80\x9c" + label + "\xe2\x80\x9d was read again."
                          : "Links can be \xe2\x80\x9c" + label + "\xe2\x80\x9d now; the file is read again when it is saved.");
}

}  // namespace bl::desktop
