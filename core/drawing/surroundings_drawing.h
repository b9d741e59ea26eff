// Draws what stands around the volumes, in plan and from aside, lighter than the proposal.
#pragma once

#include <string>
#include <vector>

#include "core/drawing/furniture.h"
#include "core/drawing/markup.h"
#include "core/drawing/projection.h"
#include "core/reading/surroundings.h"

namespace bl::drawing {

/// Below the site: ground, data and sun; then streets with their load, and buildings.
void draw_ground_layers(Markup& svg, const Sheet& sheet, const reading::Surroundings& surroundings);
void draw_streets_and_buildings(Markup& svg, const Sheet& sheet, const reading::Surroundings& surroundings);
void draw_plots(Markup& svg, const Sheet& sheet, const reading::Surroundings& surroundings);
/// Names and heights of buildings, loads of streets, sun of receivers, for a placer of labels; those inside `frame` on the sheet.
std::vector<Label> surroundings_labels(const Sheet& sheet, const reading::Surroundings& surroundings, const Box& frame);
/// Samples with their words, in rows of the sheet's width from `at` on; returns the height that they take.
double draw_surroundings_legend(Markup* svg, const Sheet& sheet, const reading::Surroundings& surroundings, Pixel at);
/// The same seen from aside, whose picture has the `id`: streets and sun on the ground at height `ground` inside the frame, then
/// the buildings behind the middle of the core, and, after the volumes, those before it, which are pale so that they hide
/// nothing.
void draw_ground_aside(Markup& svg, const Sheet& sheet, const reading::Surroundings& surroundings,
                       const std::vector<Point3>& frame, double ground, const std::string& id);
void draw_buildings_aside(Markup& svg, const Sheet& sheet, const reading::Surroundings& surroundings,
                          const std::vector<Point3>& frame, const Point3& middle, const Vector3& to_sun, bool before);

/// What the plan shows of it, in words.
std::string surroundings_caption(const reading::Surroundings& surroundings);

}  // namespace bl::drawing
