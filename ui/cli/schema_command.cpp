// `schema`: the JSON Schema of scene files or of the messages of rooms, and these as types of TypeScript.
#include <nlohmann/json.hpp>

#include "core/define/schema.h"
#include "core/file/file_io.h"
#include "core/file/scene_file.h"
#include "core/wire/messages.h"
#include "ui/cli/commands.h"
#include "ui/cli/terminal.h"

namespace bl::cli {

int schema_command(const SchemaOptions& options) {
  const std::string text = options.is_types         ? wire::message_types()
                           : options.is_of_messages ? write_json(wire::message_schema())
                                                    : write_json(scene_schema(full_registry(), settings_type(), kSceneVersion));
  if (options.out.empty()) {
    print_page(text);
    return kDone;
  }
  if (auto written = write_file(options.out, text + "\n"); !written) {
    print_error(options.out, written.error());
    return kBadInput;
  }
  return kDone;
}

}  // namespace bl::cli
