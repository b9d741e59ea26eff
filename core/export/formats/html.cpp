// One offline page: the model in three dimensions, plans by storey, tables, and the story of conflicts, with all data in it.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <nlohmann/json.hpp>

#include "core/drawing/markup.h"
#include "core/export/coarse_ground.h"
#include "core/export/drawn_levels.h"
#include "core/export/format.h"
#include "core/export/identity.h"
#include "core/export/plan_places.h"
#include "core/export/read_proposal.h"
#include "core/geometry/cell_mesh.h"
#include "core/reading/figures.h"

namespace bl::exporting {

namespace {

constexpr std::size_t kMostPageBytes = 3000000;
// Of what the page reads (ui/web/src/proposal/data.ts): a page built before or after a change of it stays blank.
constexpr int kDataVersion = 2;

struct HtmlFormat {
  using PageJson = nlohmann::ordered_json;
  struct Options : FormOptions {
    bool surroundings = true;
  };

  static void declare(FormatBuilder<HtmlFormat>& f) {
    f.id("html").label("Page for everybody (HTML)");
    f.doc(
        "One page that needs no network and no other file: the model in three dimensions, the plan of each cellar and each "
        "level, areas by "
        "building, storey and use, programme against result, indicators, plots, and the conflicts with who wants what. It works "
        "with the keyboard. At most 3 MB: where there is much to show, shapes become coarser, and a note says so.");
    f.ending(".html").begins("<!doctype html>\n<!-- BehaviourLinks proposal -->").shell("proposal.html");
    f.option(&Options::surroundings, "surroundings").doc("With the buildings that stand already, streets and terrain.");
    declare_form_option(f);
  }

  /// How coarse the shapes are: tried one after another until the page is small enough.
  struct Detail {
    double plan = 0;                 ///< [m] that a line of a plan may be off
    int depth = 0;                   ///< how often faces of rounded volumes are divided
    std::size_t most_triangles = 0;  ///< of one body; more: an upright body over its outline
    std::size_t most_of_ground = 0;  ///< triangles of all surfaces of the ground together
  };

  struct PageBuilder {
    const Proposal& proposal;
    const Options& options;
    const Detail detail;
    Point3 origin = {};
    PageJson paths = PageJson::array();
    std::map<std::string, std::size_t> path_numbers = {};
    // Bodies that were too fine, triangles of the ground and those that are shown.
    std::size_t upright = 0, upright_neighbours = 0, all_ground = 0, shown_ground = 0;

    static double whole(double metres) { return std::round(metres * 100) + 0.0; }

    // Without points that lie within `most` of the line that takes their place.
    static geometry::Ring thinned(const geometry::Ring& ring, double most) {
      geometry::Ring kept;
      for (std::size_t from = 0, next = 0; from < ring.size(); from = next) {
        kept.push_back(ring[from]);
        const auto is_straight = [&](std::size_t to) {
          const Point3& end = ring[to % ring.size()];
          const double length = distance(ring[from], end);
          for (std::size_t k = from + 1; k < to; ++k)
            if (std::abs(geometry::turn(ring[from], ring[k], end)) > most * length) return false;
          return length > 0;
        };
        next = from + 1;
        while (next < ring.size() && next - from < 64 && is_straight(next + 1)) ++next;
      }
      return kept.size() >= 3 ? kept : ring;
    }

    // Path data in decimetres, y downwards, to a centimetre.
    std::string path_of(const std::vector<geometry::PlateFace>& faces) const {
      drawing::PathText path;
      const auto add = [&](const geometry::Ring& ring) {
        std::vector<drawing::Pixel> line;
        for (const Point3& p : thinned(ring, detail.plan)) line.push_back({p.x * 10, -p.y * 10});
        path.polyline(line, true);
      };
      for (const geometry::PlateFace& face : faces) {
        add(face.outer);
        for (const geometry::Ring& hole : face.holes) add(hole);
      }
      return path.text();
    }
    // Equal storeys share one path.
    std::size_t path_number(const std::vector<geometry::PlateFace>& faces) {
      const auto [found, is_new] = path_numbers.emplace(path_of(faces), paths.size());
      if (is_new) paths.push_back(found->first);
      return found->second;
    }

    PageJson surface(const Mesh& mesh, double storey, double bottom) const {
      PageJson points = PageJson::array(), triangles = PageJson::array();
      for (const Point3& v : mesh.vertices)
        for (const double at : {v.x - origin.x, v.y - origin.y, v.z - origin.z})
          points.push_back(static_cast<std::int64_t>(whole(at)));
      for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t corner : triangle) triangles.push_back(corner);
      PageJson made = {{"t", "surface"}, {"points", points}, {"triangles", triangles}};
      if (storey > 0) made["storey"] = whole(storey), made["bottom"] = whole(bottom - origin.z);
      return made;
    }
    PageJson prism(const geometry::Ring& outline, double bottom, double top) const {
      PageJson ring = PageJson::array();
      for (const Point3& p : thinned(outline, 0.5))
        for (const double at : {p.x - origin.x, p.y - origin.y}) ring.push_back(static_cast<std::int64_t>(whole(at)));
      return {{"t", "prism"}, {"ring", ring}, {"low", whole(bottom - origin.z)}, {"high", whole(top - origin.z)}};
    }
    PageJson lines(const std::vector<geometry::Ring>& all, bool is_closed, double width, double height) const {
      PageJson points = PageJson::array(), counts = PageJson::array();
      for (const geometry::Ring& line : all) {
        counts.push_back(line.size());
        for (const Point3& p : line)
          for (const double at : {p.x - origin.x, p.y - origin.y, height + p.z - origin.z})
            points.push_back(static_cast<std::int64_t>(whole(at)));
      }
      PageJson made = {{"t", "lines"}, {"points", points}, {"counts", counts}};
      if (is_closed) made["is_closed"] = true;
      if (width > 0) made["width"] = whole(width);
      return made;
    }

    std::shared_ptr<const Mesh> light_mesh(const Building& b) const {
      if (detail.most_triangles == 0 || b.light_mesh != nullptr || !b.shape) return b.light_mesh;
      return std::make_shared<const Mesh>(*geometry::mesh_of_depth(b.shape, detail.depth));
    }

    // What the picture in three dimensions shows, by the keys of the view that pages of a room get.
    PageJson shapes() {
      double ground = proposal.ground;
      for (const Land& land : proposal.lands)
        if (land.is_boundary) ground = std::min(ground, land.ground);
      PageJson all = {{"space",
                       {{"t", "space"},
                        {"origin", {origin.x, origin.y, origin.z}},
                        {"true_north", proposal.reference.true_north},
                        {"ground", whole(ground - origin.z)}}}};
      for (const Building& b : proposal.buildings) {
        const std::shared_ptr<const Mesh> light = light_mesh(b);
        if (light != nullptr && light->triangles.size() <= detail.most_triangles) {
          all["n/building/" + b.id] = surface(*light, b.storey_height, b.bottom);
        } else if (!b.outline.empty()) {
          ++upright;
          all["n/building/" + b.id] = prism(b.outline.front().outer, b.bottom, b.top);
        }
      }
      for (const Land& land : proposal.lands) {
        std::vector<geometry::Ring> rings;
        for (const geometry::PlateFace& face : land.faces) rings.push_back(face.outer);
        all[(land.is_boundary ? "n/site/" : "n/plot/") + land.id] = lines(rings, true, 0, land.ground);
      }
      if (!options.surroundings) return all;
      for (const Neighbour& n : proposal.neighbours) {
        if (n.mesh && n.mesh->triangles.size() <= detail.most_triangles) all["n/existing/" + n.id] = surface(*n.mesh, 0, 0);
        else all["n/existing/" + n.id] = prism(n.face.outer, n.bottom, n.top), upright_neighbours += n.mesh ? 1 : 0;
      }
      for (std::size_t k = 0; k < proposal.streets.size(); ++k)
        if (proposal.streets[k].line.size() > 1)
          all["n/street/" + std::to_string(k)] = lines({proposal.streets[k].line}, false, 6, 0);
      for (std::size_t k = 0; k < proposal.terrains.size(); ++k) {
        const Mesh coarse = coarse_ground(*proposal.terrains[k], detail.most_of_ground / proposal.terrains.size());
        all_ground += proposal.terrains[k]->triangles.size();
        shown_ground += coarse.triangles.size();
        all["n/terrain/" + std::to_string(k)] = surface(coarse, 0, 0);
      }
      return all;
    }

    // What is shown coarser than it is; empty: nothing.
    std::string coarser() const {
      std::string told;
      for (const auto& [count, noun] : {std::pair(upright, "volume"), std::pair(upright_neighbours, "existing building")})
        if (count > 0)
          told += (told.empty() ? "" : ", ") + reading::counted(count, noun) +
                  (count == 1 ? " is an upright body over its outline" : " are upright bodies over their outlines");
      if (shown_ground < all_ground)
        told += (told.empty() ? "" : ", ") + std::string("the ground has ") + std::to_string(shown_ground) + " of " +
                std::to_string(all_ground) + " triangles";
      return told;
    }

    PageJson looks() const {
      PageJson all;
      for (const Building& b : proposal.buildings)
        all["building/" + b.id] = {{"kind", "volume"}, {"fill", drawing::hex(b.colour)}, {"name", b.label}};
      for (const Land& land : proposal.lands)
        all[(land.is_boundary ? "site/" : "plot/") + land.id] = {
            {"kind", land.is_boundary ? "boundary" : "plot"}, {"fill", ""}, {"name", land.name}};
      return all;
    }

    PageJson buildings() {
      PageJson all = PageJson::array();
      const auto storeys_of = [&](const std::vector<Storey>& all_of_it) {
        PageJson storeys = PageJson::array();
        for (const Storey& s : all_of_it)
          storeys.push_back({{"number", s.number},
                             {"level", s.level},
                             {"bottom", s.bottom},
                             {"top", s.top},
                             {"area", s.floor_area},
                             {"path", path_number(s.faces)}});
        return storeys;
      };
      const auto add = [&](const Building& b, const char* form, const std::string& reason) {
        const Point3 at = b.storeys.empty() ? b.place : geometry::middle_of(b.storeys.front().faces);
        all.push_back({{"id", b.id},
                       {"name", b.label},
                       {"use", b.use},
                       {"fill", drawing::hex(b.colour)},
                       {"form", form},
                       {"why", reason},
                       {"at", {whole(at.x) / 10, -whole(at.y) / 10}},
                       {"area", b.floor_area},
                       {"asked_area", b.asked_area},
                       {"volume", b.volume},
                       {"asked_volume", b.asked_volume},
                       {"footprint", b.footprint},
                       {"bottom", b.bottom},
                       {"top", b.top},
                       {"storeys", storeys_of(b.storeys)},
                       {"cellars", storeys_of(b.cellars)}});
      };
      for (const Building& b : proposal.buildings) add(b, b.is_standing ? "standing" : "rounded", "");
      for (const Building& b : proposal.shapeless) add(b, "no shape", b.why_shapeless);
      return all;
    }

    static PageJson use_of(const UseRow& row) {
      return {{"use", row.use},
              {"letter", row.letter},
              {"fill", drawing::hex(row.colour)},
              {"buildings", row.buildings},
              {"area", row.floor_area},
              {"asked_area", row.asked_area},
              {"volume", row.volume},
              {"asked_volume", row.asked_volume}};
    }

    PageJson plan() {
      PageJson lands = PageJson::array(), existing = PageJson::array(), streets = PageJson::array();
      for (const Land& land : proposal.lands)
        lands.push_back({{"name", land.name}, {"is_boundary", land.is_boundary}, {"path", path_of(land.faces)}});
      if (options.surroundings) {
        for (const Neighbour& n : proposal.neighbours) existing.push_back({{"name", n.name}, {"path", path_of({n.face})}});
        for (const Street& street : proposal.streets) {
          drawing::PathText path;
          std::vector<drawing::Pixel> line;
          for (const Point3& p : street.line) line.push_back({p.x * 10, -p.y * 10});
          path.polyline(line, false);
          streets.push_back({{"name", street.name}, {"path", path.text()}});
        }
      }
      const PlanExtent extent = plan_extent(proposal);
      PageJson levels = PageJson::array();
      for (const DrawnLevel& level : drawn_levels(proposal))
        levels.push_back(
            {{"number", level.number}, {"name", level.name()}, {"heights", level.heights()}, {"bottom", level.lowest}});
      return {{"box",
               {whole(extent.low.x) / 10, -whole(extent.high.y) / 10, whole(extent.high.x - extent.low.x) / 10,
                whole(extent.high.y - extent.low.y) / 10}},
              {"levels", levels},
              {"level_height", proposal.level_height},
              {"lands", lands},
              {"existing", existing},
              {"streets", streets}};
    }

    static PageJson rule_of(const std::optional<double>& limit) { return limit ? PageJson(*limit) : PageJson(); }

    PageJson document() {
      const PlanExtent extent = plan_extent(proposal);
      origin = {std::round((extent.low.x + extent.high.x) / 2), std::round((extent.low.y + extent.high.y) / 2), 0};
      PageJson identity = PageJson::array(), plots = PageJson::array(), indicators = PageJson::array(),
               conflicts = PageJson::array(), troubles = PageJson::array(), uses = PageJson::array(), open = PageJson::array();
      for (const auto& [name, value] : identity_of(proposal)) identity.push_back({name, value});
      for (const Land& land : proposal.lands)
        plots.push_back({{"name", land.name},
                         {"is_boundary", land.is_boundary},
                         {"area", land.area},
                         {"fsi", land.fsi},
                         {"gsi", land.gsi},
                         {"fsi_max", rule_of(land.fsi_max)},
                         {"gsi_max", rule_of(land.gsi_max)},
                         {"height_max", rule_of(land.height_max)}});
      for (const Indicator& one : proposal.indicators)
        indicators.push_back({{"name", one.name},
                              {"value", one.value},
                              {"target", one.target},
                              {"unit", one.unit},
                              {"direction", one.direction},
                              {"status", one.status},
                              {"score", one.score}});
      for (const Conflict& one : proposal.conflicts)
        conflicts.push_back({{"node", one.node}, {"port", one.port}, {"tension", one.tension}, {"pulls", one.pulls}});
      for (const Trouble& one : proposal.troubles) troubles.push_back({{"place", one.place}, {"message", one.message}});
      for (const UseRow& row : proposal.uses) uses.push_back(use_of(row));
      for (const OpenSpace& one : proposal.open_spaces)
        open.push_back({{"use", one.use}, {"area", one.area}, {"asked_area", one.asked_area}, {"why", one.why_short}});
      PageJson all = {{"title", proposal.name()},
                      {"about", proposal.about},
                      {"settled", proposal.is_settled},
                      {"identity", identity},
                      {"true_north", proposal.reference.true_north},
                      {"plan", plan()},
                      {"buildings", buildings()},
                      {"uses", uses},
                      {"all", use_of(proposal.all)},
                      {"open", open},
                      {"plots", plots},
                      {"indicators", indicators},
                      {"conflicts", conflicts},
                      {"minor_conflicts", proposal.minor_conflicts},
                      {"troubles", troubles},
                      {"shapes", shapes()},
                      {"looks", looks()}};
      all["paths"] = paths;
      return all;
    }
  };

  // Within a script element no `<` may stand as it is.
  static std::string script_text(const PageJson& json) {
    std::string text;
    for (const char c : json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)) {
      if (c == '<') text += "\\u003c";
      else text += c;
    }
    return text;
  }

  // The data that a built page reads; empty where it does not say.
  static std::string version_of(const std::string& shell) {
    constexpr std::string_view kSays = "<meta name=\"data-version\" content=\"";
    const std::size_t begin = shell.find(kSays);
    if (begin == std::string::npos) return "";
    const std::size_t from = begin + kSays.size();
    return shell.substr(from, std::min<std::size_t>(shell.find('"', from) - from, 12));
  }

  static Result<ExportFiles> write(const Proposal& proposal, const Options& options) {
    constexpr std::string_view kTitle = "PAGE_TITLE", kData = "PAGE_DATA";
    const std::size_t title = proposal.shell.find(kTitle), data = proposal.shell.find(kData);
    if (title == std::string::npos || data == std::string::npos)
      return Error{
          ErrorCode::missing, "",
          "the page is not built; `./bl export` builds it where npm is installed (the Debian packages nodejs and npm), and "
          "the variable BEHAVIOURLINKS_PAGE names the folder of a built one"};
    if (const std::string version = version_of(proposal.shell); version != std::to_string(kDataVersion))
      return Error{ErrorCode::version, "",
                   "the built page reads data of version " + (version.empty() ? std::string("1 or older") : version) +
                       ", and this program writes version " + std::to_string(kDataVersion) +
                       ": build the page again with `./bl export`, or name the folder of one that fits in BEHAVIOURLINKS_PAGE"};
    ExportFiles made;
    constexpr std::array<Detail, 5> kDetails = {
        {{0.01, 3, 8000, 64000}, {0.02, 2, 4000, 32000}, {0.1, 1, 1500, 12000}, {0.3, 1, 400, 4000}, {1, 1, 0, 1000}}};
    const auto rounded = static_cast<std::size_t>(std::count_if(proposal.buildings.begin(), proposal.buildings.end(),
                                                                [](const Building& b) { return b.light_mesh == nullptr; }));
    for (const Detail& detail : kDetails) {
      // What is certainly too large is not made: a cell of a dozen faces has some sixty triangles, each division four times as
      // many.
      constexpr std::size_t kLeastBytes = 60 * 12;
      if (detail.most_triangles > 0 && (rounded * kLeastBytes << 2 * detail.depth) > 2 * kMostPageBytes) continue;
      PageBuilder builder{proposal, options, detail};
      std::string page = proposal.shell;
      page.replace(data, kData.size(), script_text(builder.document()));
      page.replace(title, kTitle.size(), drawing::Markup().text(proposal.name()).str());
      if (page.size() > kMostPageBytes) continue;
      const std::string told = builder.coarser();
      if (!told.empty() || detail.plan > kDetails.front().plan)
        made.notes.push_back("so that the page stays below 3 MB, shapes are coarser" + (told.empty() ? "" : ": " + told));
      made.files.push_back({"proposal.html", std::move(page)});
      return made;
    }
    return Error{ErrorCode::out_of_range, "",
                 "the proposal is too large for a page of 3 MB; --option surroundings=no makes it smaller"};
  }
};

}  // namespace

BL_FORMAT(html, HtmlFormat)

}  // namespace bl::exporting
