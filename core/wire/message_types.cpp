// The messages as types of TypeScript, so that the page's compiler knows what the server declares.
#include <nlohmann/json.hpp>

#include "core/define/schema.h"
#include "core/wire/messages.h"

namespace bl::wire {

namespace {

// Of a value by its schema. What a schema leaves open, such as content in JSON, is `unknown`: whoever reads it has to say more.
std::string type_of(const Json& schema) {
  if (schema.contains("enum")) {
    std::string choices;
    for (const Json& one : schema["enum"]) choices += (choices.empty() ? "" : " | ") + one.dump();
    return choices;
  }
  const std::string type = schema.value("type", "");
  if (type == "boolean" || type == "string") return type;
  if (type == "number" || type == "integer") return "number";
  if (type != "array") return "unknown";
  const std::string item = schema.contains("items") ? type_of(schema["items"]) : "unknown";
  return item.find(' ') == std::string::npos ? item + "[]" : "(" + item + ")[]";
}

std::string interface_of(const char* name, const char* doc, bool is_from_page) {
  std::string text = std::string("\n\n/// ") + doc + "\nexport interface " + name + " {\n";
  for (const MessageDefinition* kind : message_kinds()) {
    if (kind->is_from_page != is_from_page) continue;
    text += "  /** " + kind->doc + " */\n  " + kind->id + ": {\n    t: \"" + kind->id + "\";\n";
    for (const PortDefinition& port : kind->ports)
      text +=
          "    /** " + port.doc + " */\n    " + port.id + (port.is_required ? ": " : "?: ") + type_of(value_schema(port)) + ";\n";
    text += "  };\n";
  }
  return text + "}";
}

}  // namespace

std::string message_types() {
  return "// The messages between a room's server and its pages; made by `behaviourlinks schema --messages --typescript`." +
         interface_of("FromPage", "What pages and windows say, by kind.", true) +
         interface_of("FromServer", "What the server says, by kind. Fields with their usual values are left out.", false);
}

}  // namespace bl::wire
