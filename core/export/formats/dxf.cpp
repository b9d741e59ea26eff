// Plans of all storeys as DXF R2000: metres, layers by storey and use, plots, surroundings, dimensions, title.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "core/base/mathematics.h"
#include "core/base/text.h"
#include "core/drawing/use_colours.h"
#include "core/export/drawn_levels.h"
#include "core/export/dxf_drawing.h"
#include "core/export/format.h"
#include "core/export/identity.h"
#include "core/export/plan_places.h"
#include "core/export/read_proposal.h"
#include "core/export/section.h"

namespace bl::exporting {

namespace {

enum class DxfArrangement { stacked, beside };

struct DxfFormat {
  struct Options : FormOptions {
    DxfArrangement storeys = DxfArrangement::stacked;
    bool surroundings = true;
    double text_height = 1;
    std::string section = "auto";
  };

  static void declare(FormatBuilder<DxfFormat>& f) {
    f.id("dxf").label("Plans of the storeys (DXF R2000)");
    f.doc(
        "One drawing in metres from the origin of the scene. Each storey of each building is one closed line, at its height, on "
        "a "
        "layer such as L02-HOUSING: level and use; the first storey below the ground is on L-1-HOUSING. Uses whose names are "
        "equal in such letters get a number. Arcs are arcs. Ground that is kept open is on "
        "OPEN-GARDEN and the like, that of streets on KEPT-STREET. Plots, the boundary, existing buildings, streets, texts, "
        "dimensions and the title have layers of their own. A section stands above the plans, on layers that begin with "
        "SECTION.");
    f.ending(".dxf").begins("999\nBehaviourLinks");
    f.option(
         &Options::storeys, "storeys",
         {{DxfArrangement::stacked, "stacked", "All storeys at their true place, one above another."},
          {DxfArrangement::beside, "beside", "Levels side by side, the ground floor at its true place and cellars to its left."}})
        .doc("How the storeys lie.");
    f.option(&Options::surroundings, "surroundings").doc("With existing buildings and streets.");
    f.option(&Options::section, "section")
        .doc(
            "Where the section is cut: X1,Y1,X2,Y2 in metres, one height for a level cut, `auto` along the longest side through "
            "the highest "
            "volume, or "
            "`none`.");
    f.option(&Options::text_height, "text_height").unit(Unit::metre).range(0.05, 50).doc("Height of the texts.");
    declare_form_option(f);
  }

  struct DxfPlans {
    const Proposal& proposal;
    const Options& options;
    DxfDrawing drawing = {};
    PlanExtent extent = plan_extent(proposal);
    std::map<std::string, std::string> layer_of_use = {};
    std::vector<std::string> notes = {};

    // Each use has layers and a colour of its own, also where its name falls together with another one.
    void name_layers() {
      std::set<std::string> taken = {"TEXT"};
      std::string told;
      for (const Building& b : proposal.buildings) {
        if (layer_of_use.contains(b.use)) continue;
        const std::string plain = DxfDrawing::layer_name(use_name(b.use));
        std::string name = plain;
        for (int k = 2; !taken.insert(name).second; ++k) name = plain + "_" + std::to_string(k);
        layer_of_use.emplace(b.use, name);
        if (name != plain || plain.find_first_not_of("_-") == std::string::npos)
          told += (told.empty() ? "`" : ", `") + name + "` is " + use_name(b.use);
      }
      if (!told.empty()) notes.push_back("names of layers have plain letters only, and no two uses share one: " + told);
    }

    Vector3 shift(int level) const {
      if (options.storeys == DxfArrangement::stacked) return {};
      return {level * 1.25 * std::max(1.0, extent.high.x - extent.low.x), 0, 0};
    }

    void ring(const std::string& layer, const geometry::Ring& corners, double height, const Vector3& by) {
      std::vector<DxfDrawing::Corner> line;
      for (const Point3& corner : corners) line.push_back({corner + by, 0});
      drawing.polyline(layer, line, true, height);
    }
    void faces(const std::string& layer, const std::vector<geometry::PlateFace>& all, double height, const Vector3& by) {
      for (const geometry::PlateFace& face : all) {
        ring(layer, face.outer, height, by);
        for (const geometry::Ring& hole : face.holes) ring(layer, hole, height, by);
      }
    }
    static double bulge_of(const Point3& from, const Point3& to, const Point3& centre) {
      const Vector3 u = from - centre, v = to - centre;
      double angle = mathematics::arc_tangent(u.x * v.y - u.y * v.x, u.x * v.x + u.y * v.y);
      if (angle <= 0) angle += 2 * std::numbers::pi;
      return mathematics::sine(angle / 4) / mathematics::cosine(angle / 4);
    }
    // A whole circle has one corner, which no line of arcs can do with: it gets the opposite one as well.
    static std::vector<DxfDrawing::Corner> line_of(const geometry::PlateRing& plate, const Point3& centre) {
      const std::size_t count = plate.corners.size();
      if (count == 1) return {{plate.corners[0].at, 1}, {centre + (centre - plate.corners[0].at), 1}};
      std::vector<DxfDrawing::Corner> line;
      for (std::size_t k = 0; k < count; ++k) {
        const Point3 &from = plate.corners[k].at, &to = plate.corners[(k + 1) % count].at;
        line.push_back({from, plate.corners[k].is_arc ? bulge_of(from, to, centre) : 0});
      }
      return line;
    }
    // The other way round: each side then begins where it ended.
    static void turn_round(std::vector<DxfDrawing::Corner>& line) {
      std::reverse(line.begin(), line.end());
      const double first = line.front().bulge;
      for (std::size_t k = 0; k + 1 < line.size(); ++k) line[k].bulge = -line[k + 1].bulge;
      line.back().bulge = -first;
    }
    void arcs(const std::string& layer, const std::vector<geometry::PlateRing>& rings, bool is_turned, const Building& b,
              const Storey& storey, const Vector3& by) {
      for (const geometry::PlateRing& plate : rings) {
        if (plate.corners.empty()) continue;
        std::vector<DxfDrawing::Corner> line = line_of(plate, {b.arc_centre.x, b.arc_centre.y, 0});
        if (is_turned) turn_round(line);
        for (DxfDrawing::Corner& corner : line) corner.at = corner.at + by;
        drawing.polyline(layer, line, true, storey.bottom);
      }
    }

    void storey(const Building& b, const Storey& s, int colour) {
      const std::string level = "L" + std::string(s.level >= 0 && s.level < 10 ? "0" : "") + std::to_string(s.level) + "-";
      const std::string layer = level + layer_of_use.at(b.use), words = level + "TEXT";
      drawing.layer(layer, colour);
      drawing.layer(words, 7);
      const Vector3 by = shift(s.level);
      if (s.rings.empty()) faces(layer, s.faces, s.bottom, by);
      arcs(layer, s.rings, false, b, s, by);
      arcs(layer, s.courtyards, true, b, s, by);
      Point3 middle = geometry::middle_of(s.faces) + by;
      middle.z = s.bottom;
      drawing.text(words, middle, options.text_height, b.label + "  " + fixed(s.floor_area, 1) + " m²", true);
    }

    // Ground that is kept open, with its name and area, on a layer for each use; and that of streets, on one for each kind.
    void open_ground() {
      std::set<std::string> taken;
      const auto layer_of = [&](const std::string& prefix, const std::string& name, int colour) {
        const std::string plain = prefix + DxfDrawing::layer_name(name);
        std::string layer = plain;
        for (int k = 2; !taken.insert(layer).second; ++k) layer = plain + "_" + std::to_string(k);
        drawing.layer(layer, colour);
        return layer;
      };
      for (const OpenSpace& open : proposal.open_spaces) {
        if (open.faces.empty()) continue;
        const std::string layer = layer_of("OPEN-", open.use, drawing::use_colour(open.use).cad);
        faces(layer, open.faces, proposal.ground, {});
        Point3 middle = label_place(open.faces).middle;
        middle.z = proposal.ground;
        drawing.text(layer, middle, options.text_height, open.use + "  " + fixed(open.area, 1) + " m²", true);
      }
      for (const KeptGround& kept : proposal.kept)
        faces(layer_of("KEPT-", kept.kind, drawing::use_colour(kept.kind).cad), kept.faces, proposal.ground, {});
    }

    void surroundings() {
      for (const Neighbour& n : proposal.neighbours) faces("EXISTING", {n.face}, n.bottom, {});
      for (const Street& street : proposal.streets) {
        std::vector<DxfDrawing::Corner> line;
        for (const Point3& p : street.line) line.push_back({p, 0});
        drawing.polyline("STREETS", line, false, street.line.empty() ? 0 : street.line.front().z);
      }
    }

    // A line with its ends marked, and its length beside it.
    void dimension(const Point3& from, const Point3& to, const Vector3& out) {
      const double gap = 2 * options.text_height;
      const Point3 a = from + gap * out, b = to + gap * out;
      drawing.line("DIMENSIONS", a, b);
      drawing.line("DIMENSIONS", from, a + 0.5 * gap * out);
      drawing.line("DIMENSIONS", to, b + 0.5 * gap * out);
      drawing.text("DIMENSIONS", 0.5 * (a + b) + options.text_height * out, options.text_height, fixed(distance(from, to), 2),
                   true);
    }

    // At its true place and height, so that it lies in the model where it was cut.
    Result<void> level_section(double height) {
      if (auto met = check_level_cut(proposal, height); !met) return met;
      drawing.layer("SECTION-CUT", 5);
      drawing.layer("SECTION-TEXT", 7);
      for (const Building& b : proposal.buildings) faces("SECTION-CUT", level_part(b, height).faces, height, {});
      drawing.text("SECTION-TEXT", {extent.low.x, extent.high.y + 4 * options.text_height, height}, 2 * options.text_height,
                   "Level cut at " + std::string(height >= 0 ? "+" : "") + fixed(height, 2) + " m");
      return {};
    }

    // Above the plans, where the height is the way up; the line in the plan has the letter of the section at its ends.
    Result<void> section() {
      if (options.section == "none") return {};
      if (const auto height = level_cut(options.section)) return level_section(*height);
      const auto cut = section_line(proposal, options.section == "auto" ? "" : options.section);
      if (!cut) return cut.error();
      const Section made = section_of(proposal, *cut, options.surroundings);
      if (auto shown = check_section(made); !shown) return shown;
      const Vector3 way = (cut->to - cut->from) / distance(cut->from, cut->to);
      for (const auto& [name, colour] : std::initializer_list<std::pair<const char*, int>>{{"SECTION-LINE", 6},
                                                                                           {"SECTION-CUT", 5},
                                                                                           {"SECTION-CELLAR", 151},
                                                                                           {"SECTION-SLAB", 7},
                                                                                           {"SECTION-BEYOND", 8},
                                                                                           {"SECTION-GROUND", 34},
                                                                                           {"SECTION-EXISTING", 8},
                                                                                           {"SECTION-TEXT", 7}})
        drawing.layer(name, colour);
      const Point3 start = cut->from + made.low.x * way, end = cut->from + made.high.x * way;
      drawing.line("SECTION-LINE", start, end);
      for (const Point3& place : {start, end}) drawing.text("SECTION-LINE", place, 2 * options.text_height, "A", true);
      const Vector3 by{extent.low.x - made.low.x, extent.high.y + 12 * options.text_height - made.low.y, 0};
      const auto rings = [&](const char* layer, const std::vector<geometry::Ring>& all) {
        for (const geometry::Ring& one : all) ring(layer, one, 0, by);
      };
      for (const SectionPart& part : made.parts) {
        rings(part.building ? "SECTION-BEYOND" : "SECTION-EXISTING", part.beyond);
        rings(part.building ? "SECTION-CUT" : "SECTION-EXISTING", part.cut);
        rings("SECTION-CELLAR", part.cellars);
        rings("SECTION-SLAB", part.slabs);
      }
      for (const auto& line : made.grounds)
        for (std::size_t k = 0; k + 1 < line.size(); ++k) drawing.line("SECTION-GROUND", line[k] + by, line[k + 1] + by);
      for (const double height : made.heights)
        drawing.text("SECTION-TEXT", Point3{made.low.x - 8 * options.text_height, height, 0} + by, options.text_height,
                     (height >= 0 ? "+" : "") + fixed(height, 2));
      drawing.text("SECTION-TEXT", Point3{made.low.x, made.high.y + 2 * options.text_height, 0} + by, 2 * options.text_height,
                   "Section A");
      return {};
    }

    Result<std::string> write() {
      name_layers();
      for (const auto& [name, colour] : std::initializer_list<std::pair<const char*, int>>{
               {"PLOT", 3}, {"BOUNDARY", 1}, {"EXISTING", 8}, {"STREETS", 9}, {"DIMENSIONS", 7}, {"TITLE", 7}})
        drawing.layer(name, colour);
      for (const Land& land : proposal.lands) faces(land.is_boundary ? "BOUNDARY" : "PLOT", land.faces, land.ground, {});
      open_ground();
      if (options.surroundings) surroundings();
      for (const Building& b : proposal.buildings)
        for (const Storey* s : drawn_storeys(b)) storey(b, *s, drawing::use_colour(b.use).cad);
      if (auto done = section(); !done) return done.error();
      const Point3 a = {extent.low.x, extent.low.y, 0}, b = {extent.high.x, extent.low.y, 0},
                   c = {extent.high.x, extent.high.y, 0};
      dimension(a, b, {0, -1, 0});
      dimension(b, c, {1, 0, 0});
      double y = extent.low.y - 8 * options.text_height;
      for (const auto& [name, value] : identity_of(proposal)) {
        drawing.text("TITLE", {extent.low.x, y, 0}, options.text_height, name + ": " + value);
        y -= 1.8 * options.text_height;
      }
      if (drawing.has_lost_letters()) notes.push_back("letters that DXF R2000 has no number for are question marks in this file");
      return drawing.str("BehaviourLinks: " + identity_line(proposal));
    }
  };

  static Result<ExportFiles> write(const Proposal& proposal, const Options& options) {
    DxfPlans plans{proposal, options};
    auto text = plans.write();
    if (!text) return text.error();
    return ExportFiles{{{"plans.dxf", std::move(*text)}}, std::move(plans.notes)};
  }
};

}  // namespace

BL_FORMAT(dxf, DxfFormat)

}  // namespace bl::exporting
