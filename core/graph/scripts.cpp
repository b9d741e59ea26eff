// Reading the scripts of a scene over a copy of the program's types.
#include "core/graph/scripts.h"

#include "core/base/heap_bytes.h"
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

std::size_t Scripts::unshared_bytes(const Scripts& before) const {
  if (!content_ || content_ == before.content_) return 0;
  // Of the texts of a port (label, doc, keys), and of the code behind a type.
  constexpr std::size_t kBytesOfTexts = 512, kBytesOfCode = 512;
  std::size_t bytes = 0;
  for (const auto& [name, text] : content_->texts) bytes += 2 * (text.size() + kBytesOfBlock);  // as text, and as it runs
  const auto add = [&](const auto& types) {
    for (const auto& [id, type] : types)
      bytes += kBytesOfBlock + sizeof(type) + kBytesOfCode + type.ports.size() * (sizeof(PortDefinition) + kBytesOfTexts);
  };
  add(content_->types.typifications());
  add(content_->types.links());
  add(content_->types.commands());
  return bytes;
}

const std::map<std::string, std::string>& Scripts::texts() const { return content_ ? content_->texts : nothing().texts; }
const std::map<std::string, Error>& Scripts::errors() const { return content_ ? content_->errors : nothing().errors; }
const std::map<std::string, std::string>& Scripts::kinds() const { return content_ ? content_->kinds : nothing().kinds; }

}  // namespace bl
