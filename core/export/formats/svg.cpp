// Plans at scale as SVG: width, height and view box in millimetres, groups with ids, one file for each level.
#include <cmath>

#include "core/base/text.h"
#include "core/drawing/markup.h"
#include "core/export/format.h"
#include "core/export/identity.h"
#include "core/export/sheet_options.h"

namespace bl::exporting {

namespace {

struct SvgFormat {
  struct Options : SheetOptions {
    std::int64_t level = 0, cellar = 0;
  };

  static void declare(FormatBuilder<SvgFormat>& f) {
    f.id("svg").label("Plans at scale (SVG)");
    f.doc(
        "Plans on paper in millimetres: title, legend, scale bar, north, dimensions; a group for each use. A folder gets one "
        "file for each cellar and each level and one for the section, a file gets one of them. Levels are as high as the lowest "
        "storey of the "
        "proposal; a building is drawn "
        "in full where one of its storeys belongs to the level, and pale where a higher storey passes through.");
    f.ending(".svg").begins("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- BehaviourLinks");
    f.option(&Options::level, "level").range(-1, 10000).doc("Which level a single file shows, from 0; -1: the section.");
    f.option(&Options::cellar, "cellar")
        .range(0, 10000)
        .doc("Which storey below the ground a single file shows instead, from 1 downwards; 0: none.");
    declare_sheet_options(f);
  }

  // Millionths of a millimetre: what is measured in the drawing is then what was drawn.
  static std::string millimetres(double value) { return shortest(std::round(value * 1e6) / 1e6 + 0.0); }

  static std::string path_of(const SheetShape& shape) {
    std::string path;
    for (const std::vector<SheetPoint>& line : shape.lines) {
      for (std::size_t k = 0; k < line.size(); ++k)
        path += (k == 0 ? "M" : "L") + millimetres(line[k].x) + " " + millimetres(line[k].y);
      if (shape.is_closed && !line.empty()) path += "Z";
    }
    return path;
  }

  static void add_shape(const SheetShape& shape, drawing::Markup& out) {
    out.open("path", {{"d", path_of(shape)},
                      {"fill", shape.is_filled ? drawing::hex(shape.fill) : "none"},
                      {"fill-rule", "evenodd"},
                      {"stroke", shape.is_stroked ? drawing::hex(shape.stroke) : "none"},
                      {"stroke-width", millimetres(shape.width)},
                      {"stroke-dasharray", shape.is_dashed ? "3 1.5" : "none"}});
    if (!shape.name.empty()) out.element("title", shape.name);
    out.close();
  }

  static void add_text(const SheetText& text, drawing::Markup& out) {
    const char* anchor = text.anchor == SheetAnchor::start ? "start" : text.anchor == SheetAnchor::middle ? "middle" : "end";
    out.element("text", text.words,
                {{"x", millimetres(text.at.x)},
                 {"y", millimetres(text.at.y)},
                 {"font-size", millimetres(text.size)},
                 {"text-anchor", anchor},
                 {"font-weight", text.is_bold ? "bold" : "normal"}});
  }

  static std::string svg_of(const PlanSheet& sheet, const Proposal& proposal) {
    drawing::Markup out;
    const std::string width = millimetres(sheet.width), height = millimetres(sheet.height);
    out.open("svg", {{"xmlns", "http://www.w3.org/2000/svg"},
                     {"width", width + "mm"},
                     {"height", height + "mm"},
                     {"viewBox", "0 0 " + width + " " + height},
                     {"font-family", "Inter, Helvetica, Arial, sans-serif"}});
    out.element("title", sheet.title).element("desc", identity_line(proposal) + "; scale 1:" + shortest(sheet.scale));
    out.open("defs").open("clipPath", {{"id", "window"}});
    out.leaf("rect", {{"x", millimetres(sheet.window_low.x)},
                      {"y", millimetres(sheet.window_low.y)},
                      {"width", millimetres(sheet.window_high.x - sheet.window_low.x)},
                      {"height", millimetres(sheet.window_high.y - sheet.window_low.y)}});
    out.close().close();
    out.leaf("rect", {{"width", width}, {"height", height}, {"fill", "#ffffff"}});
    for (const SheetGroup& group : sheet.groups) {
      out.open("g", {{"id", group.id}, {"clip-path", group.is_clipped ? "url(#window)" : "none"}});
      out.element("title", group.label);
      for (const SheetShape& shape : group.shapes) add_shape(shape, out);
      for (const SheetText& text : group.texts) add_text(text, out);
      out.close();
    }
    out.close();
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- BehaviourLinks -->\n" + out.str() + "\n";
  }

  // Which of the levels a single file shows.
  static Result<int> chosen_level(const Proposal& proposal, const Options& options) {
    const auto refusal = [](const std::string& text) { return Error{ErrorCode::out_of_range, "", "there is no " + text}; };
    const int cellars = cellar_levels(proposal);
    if (options.cellar > cellars)
      return refusal("cellar " + std::to_string(options.cellar) +
                     (cellars == 0 ? ", since no volume has one" : "; the deepest is " + std::to_string(cellars)));
    if (options.level >= proposal.levels)
      return refusal("level " + std::to_string(options.level) + "; the highest is " + std::to_string(proposal.levels - 1));
    return static_cast<int>(options.cellar > 0 ? -options.cellar : options.level);
  }

  static Result<ExportFiles> write(const Proposal& proposal, const Options& options, bool is_folder) {
    ExportFiles made;
    const bool is_section = !is_folder && options.level < 0;
    if (is_section && options.section == "none")
      return Error{ErrorCode::out_of_range, "", "level=-1 asks for the section, and section=none for none"};
    if (is_section && options.cellar > 0)
      return Error{ErrorCode::out_of_range, "", "level=-1 asks for the section, and cellar for a plan; a file shows one of them"};
    const Result<int> chosen = is_folder || is_section ? Result<int>(0) : chosen_level(proposal, options);
    if (!chosen) return chosen.error();
    for (const DrawnLevel& level : drawn_levels(proposal)) {
      if (is_section || (!is_folder && level.number != *chosen)) continue;
      auto sheet = plan_sheet(proposal, level, options);
      if (!sheet) return sheet.error();
      made.files.push_back({level.file_stem() + ".svg", svg_of(*sheet, proposal)});
    }
    if (is_section || (is_folder && options.section != "none")) {
      auto sheet = section_sheet(proposal, options);
      if (!sheet) return sheet.error();
      made.files.push_back({"section.svg", svg_of(*sheet, proposal)});
    }
    return made;
  }
};

}  // namespace

BL_FORMAT(svg, SvgFormat)

}  // namespace bl::exporting
