// The page around the drawings: figures, tables and notes for a designer and her client.
#pragma once

#include <string>
#include <string_view>

#include "core/drawing/pictures.h"
#include "core/report/report.h"

namespace bl::report {

/// The whole page, one self-contained XHTML document.
std::string write_page(const reading::ReportModel& model, const ReportData& data, const drawing::Palette& palette);

/// Its parts, in the order of the page.
void write_programme(drawing::Markup& page, const reading::ReportModel& model, const State& state,
                     const drawing::Palette& palette);
void write_volumes(drawing::Markup& page, const reading::ReportModel& model, const State& state, const drawing::Palette& palette);
/// Nothing where no volume is dressed, or no picture stands in the scene.
void write_facades(drawing::Markup& page, const reading::ReportModel& model, const State& state);
void write_pictures(drawing::Markup& page, const State& state);
void write_conflicts(drawing::Markup& page, const reading::ReportModel& model);
void write_pullers(drawing::Markup& page, const reading::ReportModel& model);
void write_problems(drawing::Markup& page, const reading::ReportModel& model);

/// The rules of its look, for screens in light and dark and for paper.
std::string_view page_style();
/// A swatch with the use's letter and its name.
void write_use(drawing::Markup& page, const std::string& use, const drawing::Palette& palette);
/// What a volume's standing is called in front of people: "met", "off", or its state.
std::string standing_of(const reading::VolumeRow& volume, double tolerance);

}  // namespace bl::report
