// Which of its values a node shows on the canvas, and how they are written.
#pragma once

#include "ui/desktop/panels/canvas/model.h"

namespace bl::desktop::canvas {

/// A section for each typification that has something to show, and for each unknown one.
std::vector<Section> sections_of(const Registry& registry, const NodeRecord& node);
float height_of(const std::vector<Section>& sections);
/// "floor area".
std::string label_of(const PortDefinition& port);

/// The value as the last tick has left it, or as set where no tick has seen the node yet.
const Value* value_of(const Workbench& editor, const NodeBox& box, const Section& section, std::size_t port);
/// With its unit: "84.2 m²", "12 rows", "on".
std::string text_of(const Workbench& editor, const NodeBox& box, const Section& section, std::size_t port);
/// Brings the texts of the rows up to the state, `revision` of which the model counts.
void refresh_texts(const Workbench& editor, const NodeBox& box, Section& section, std::size_t revision);

}  // namespace bl::desktop::canvas
