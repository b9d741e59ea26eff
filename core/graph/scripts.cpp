// Reading the scripts of a scene over a copy of the program's types.
#include "core/graph/scripts.h"

#include "core/script/link_script.h"

namespace bl {

Scripts Scripts::read(std::map<std::string, std::string> texts, const Registry& program) {
  Scripts scripts;
  if (texts.empty()) return scripts;
  auto content = std::make_shared<Content>();
  content->types = program;
  for (const auto& [name, text] : texts) {
    auto kind = script::read_link_script(name, text, content->types);
    if (!kind) {
      content->errors.emplace(name, kind.error());
      continue;
    }
    content->kinds.emplace(name, kind->id);
    content->types.add(std::move(*kind));
  }
  content->texts = std::move(texts);
  scripts.content_ = std::move(content);
  return scripts;
}

const Scripts::Content& Scripts::nothing() {
  static const Content kNothing;
  return kNothing;
}

const std::map<std::string, std::string>& Scripts::texts() const { return content_ ? content_->texts : nothing().texts; }
const std::map<std::string, Error>& Scripts::errors() const { return content_ ? content_->errors : nothing().errors; }
const std::map<std::string, std::string>& Scripts::kinds() const { return content_ ? content_->kinds : nothing().kinds; }

}  // namespace bl
