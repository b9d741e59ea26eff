// Nothing is chosen: what holds for the whole scene.
#include <imgui.h>
#include <nlohmann/json.hpp>

#include "core/define/codec.h"
#include "core/reading/figures.h"
#include "ui/desktop/panels/inspector.h"
#include "ui/desktop/panels/inspector_quantity.h"

namespace bl::desktop {

namespace {

// The scripts that the scene carries; the cross takes one away, and its links rest.
void list_scripts(Workbench& editor) {
  const Scripts scripts = editor.scene().scripts;
  for (const auto& [name, text] : scripts.texts()) {
    const auto kind = scripts.kinds().find(name);
    const LinkDefinition* link = kind == scripts.kinds().end() ? nullptr : editor.types().link(kind->second);
    bool wants_removal = false;
    const std::string doc = link != nullptr ? link->doc : scripts.errors().at(name).message;
    if (section(editor, "script." + name, name + ".lua", doc, &wants_removal)) {
      ImGui::PushTextWrapPos();
      ImGui::TextUnformatted(link != nullptr ? ("Link kind: " + link->label + ". " + doc).c_str() : doc.c_str());
      ImGui::PopTextWrapPos();
    }
    if (wants_removal) editor.submit(command<RemoveScript>({name}));
  }
}

}  // namespace

void inspect_scene(Workbench& editor) {
  const Scene& scene = editor.scene();
  const TypeDefinition& type = settings_type();
  const auto title = scene.settings.find("title");
  const auto* text = title == scene.settings.end() ? nullptr : std::get_if<std::string>(&title->second);
  heading(editor, text != nullptr && !text->empty() ? *text : editor.document->name(),
          reading::counted(scene.nodes.size(), "node") + ", " + reading::counted(scene.links.size(), "link"));
  for (const PortDefinition& port : type.ports) {
    const std::string key = "settings." + port.id;
    const auto found = scene.settings.find(port.id);
    const Value value = found == scene.settings.end() ? port.default_value : found->second;
    const bool is_default = port.keeps_default ? found == scene.settings.end() : value == port.default_value;
    float width = 0;
    const RowEvent event =
        begin_row(editor, key, label_of(port.id), port.doc, facts_of(port, port.unit), {!is_default, false, false, false}, width);
    auto change = value_field(editor, {key, &port, port.unit, value, false, false, is_default}, width);
    draw_complaint(editor, key, width);
    end_row();
    if (event.wants_reset) editor.submit(command<SetSetting>({port.id, {"null"}}));
    if (event.wants_reset || !change) continue;
    PanelMemory& memory = memory_of(editor);
    if (memory.complaint_key == key) memory.complaint_key.clear();
    const Value fresh = change->make(value);
    if (auto checked = check_value(port, fresh, ""); !checked) {
      complain(editor, key, checked.error().message);
      continue;
    }
    if (fresh == value && !(port.keeps_default && is_default)) continue;
    const Command set = command<SetSetting>({port.id, JsonValue::of(value_to_json(fresh, port))});
    if (change->is_live) editor.show({set}, memory.scrub.gesture);
    else editor.submit(set);
  }
  list_scripts(editor);
}

}  // namespace bl::desktop
