// The link kinds that people wrote for one scene: their texts and definitions, in addition to the types of the program.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>

#include "core/define/registry.h"

namespace bl {

/// Immutable and shared: copies of a scene and running plans keep the definitions alive that they use.
class Scripts {
 public:
  Scripts() = default;
  /// Reads all texts, in ascending name. A text that cannot be read is kept with the reason.
  static Scripts read(std::map<std::string, std::string> texts, const Registry& program);

  /// By name, which is the file's without ".lua".
  const std::map<std::string, std::string>& texts() const;
  /// Why texts cannot be read, by name.
  const std::map<std::string, Error>& errors() const;
  /// The id of the kind of each text that could be read.
  const std::map<std::string, std::string>& kinds() const;
  /// The types of the program and the kinds of these scripts. With no scripts it is `program` itself.
  const Registry& types(const Registry& program) const { return content_ ? content_->types : program; }

  /// About how much memory they take that `before` do not.
  std::size_t unshared_bytes(const Scripts& before) const;
  bool operator==(const Scripts& other) const { return content_ == other.content_ || texts() == other.texts(); }

 private:
  struct Content {
    std::map<std::string, std::string> texts, kinds;
    std::map<std::string, Error> errors;
    Registry types;
  };
  static const Content& nothing();
  std::shared_ptr<const Content> content_;
};

}  // namespace bl
