// Finds fields of the panels by their keys, and uses them as a person would.
#pragma once

#include <string>

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include "tests/ui/desktop/null_desktop.h"
#include "ui/desktop/panels/panel_memory.h"

namespace bl::desktop {

class PanelDesktop : public NullDesktop {
 public:
  explicit PanelDesktop(const std::string& scene) : NullDesktop(scene, {1440, 2400}) {}

  bool has(const std::string& key) { return memory_of(editor()).places.contains(key); }
  ImVec4 place(const std::string& key) {
    if (!has(key)) ADD_FAILURE() << "there is no field " << key;
    return memory_of(editor()).places[key];
  }
  ImVec2 middle(const std::string& key) {
    const ImVec4 p = place(key);
    return {(p.x + p.z) / 2, (p.y + p.w) / 2};
  }
  void press_on(const std::string& key) { click(middle(key)); }
  void choose(const std::string& node) {
    editor().picks.only_node(node);
    frames(2);
  }
  void choose_link(const std::string& link) {
    editor().picks.only_link(link);
    frames(2);
  }
  /// Clicks into a field, types over what stands there, and leaves it by a key.
  void type_into(const std::string& key, const std::string& text, int leave = GLFW_KEY_ENTER) {
    press_on(key);
    frames(3);
    this->key(GLFW_KEY_A, true);
    type(text);
    this->key(leave);
    frames(2);
  }
  std::string complaint() { return memory_of(editor()).complaint_key.empty() ? "" : memory_of(editor()).complaint; }
  std::size_t steps() {
    std::size_t count = 0;
    for (const host::HistoryStep& step : editor().document->history()) count += step.is_undone ? 0 : 1;
    return count;
  }
  const Value& setting(const std::string& node, const std::string& type, const std::string& port) {
    const TypificationDefinition& definition = *full_registry().typification(type);
    return set_value(editor().scene(), editor().scene().nodes.at(node), definition, *definition.find_port(port));
  }
  double number(const std::string& node, const std::string& type, const std::string& port) {
    return as_number(setting(node, type, port));
  }
};

}  // namespace bl::desktop
