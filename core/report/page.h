// The page around the drawings: figures, tables and notes for a designer and her client.
#pragma once

#include <string>
#include <string_view>

#include "core/drawing/pictures.h"
#include "core/report/report.h"

namespace bl::report {

/// The whole page, one self-contained XHTML document.
std::string write_page(const ReportModel& model, const ReportData& data, const Palette& palette);

/// Its parts, in the order of the page.
void write_programme(Markup& page, const ReportModel& model, const State& state, const Palette& palette);
void write_volumes(Markup& page, const ReportModel& model, const State& state, const Palette& palette);
/// Nothing where no volume is dressed, or no picture stands in the scene.
void write_facades(Markup& page, const ReportModel& model, const State& state);
void write_pictures(Markup& page, const State& state);
void write_conflicts(Markup& page, const ReportModel& model);
void write_pullers(Markup& page, const ReportModel& model);
void write_problems(Markup& page, const ReportModel& model);

/// The rules of its look, for screens in light and dark and for paper.
std::string_view page_style();
/// A swatch with the use's letter and its name.
void write_use(Markup& page, const std::string& use, const Palette& palette);
/// What a volume's standing is called in front of people: "met", "off", or its state.
std::string standing_of(const VolumeRow& volume, double tolerance);

}  // namespace bl::report
