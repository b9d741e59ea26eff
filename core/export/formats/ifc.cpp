// Site, buildings, storeys and spaces as IFC4, with quantities, uses as a classification and the place on Earth.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "core/base/hash.h"
#include "core/base/mathematics.h"
#include "core/export/facade_walls.h"
#include "core/export/format.h"
#include "core/export/identity.h"
#include "core/export/read_proposal.h"
#include "core/export/step_file.h"
#include "core/geometry/plan_ring.h"
#include "core/reading/figures.h"

namespace bl::exporting {

namespace {

struct IfcFormat {
  struct Options : FormOptions {
    bool slabs = true, walls = true, surroundings = true;
    double slab_thickness = 0.3, wall_thickness = 0.3;
  };

  static std::string why_not(VolumeForm form) {
    return form == VolumeForm::balls
               ? "a ball has no storeys that could be built, and IFC says buildings: use form=slabs or form=standing"
               : "";
  }

  static void declare(FormatBuilder<IfcFormat>& f) {
    f.id("ifc").label("Building model (IFC4)");
    f.doc(
        "A site with its place on Earth, a building for each volume, its storeys, and a space for each storey: the outline of "
        "the "
        "plate, extruded by the height of the storey, with floor area, volume, height and perimeter as base quantities. The use "
        "of "
        "a space is a classification. Each straight side and each curve of a standing "
        "storey has a wall, with what it borders on; towards neighbours it is no external one. A curve is an arc, or sides of "
        "less "
        "than 0.5 m that follow each other in nearly one direction; its wall has the length of all of them. A rounded volume is "
        "given as the "
        "plates that it is measured by, without walls, also as slabs or standing: what its sides border on is not known. "
        "Ground that is kept open or clear is a geographic element of the site. "
        "Identifiers follow from "
        "those of the scene, so that they are the same in every export.");
    f.ending(".ifc").begins(
        "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('ViewDefinition [DesignTransferView_V1.0]','BehaviourLinks");
    f.option(&Options::slabs, "slabs").doc("With a slab under each space.");
    f.option(&Options::slab_thickness, "slab_thickness").unit(Unit::metre).range(0.01, 5).doc("Thickness of the slabs.");
    f.option(&Options::walls, "walls").doc("With the walls of the façades of what stands, as simple bodies.");
    f.option(&Options::wall_thickness, "wall_thickness").unit(Unit::metre).range(0.01, 5).doc("Thickness of the walls.");
    f.option(&Options::surroundings, "surroundings").doc("With the buildings that stand already.");
    declare_form_option(f);
  }

  // 128 bits in the 64 signs of IFC, from a name that does not change.
  static std::string guid(const std::string& name) {
    constexpr const char* kSigns = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_$";
    Hash first, second;
    first.add(std::string_view("ifc a")), first.add(std::string_view(name));
    second.add(std::string_view("ifc b")), second.add(std::string_view(name));
    std::uint64_t high = first.value(), low = second.value();
    std::string text(22, '0');
    for (std::size_t k = text.size(); k-- > 0;) {
      text[k] = kSigns[low & 63];
      low = (low >> 6) | (high << 58);
      high >>= 6;
    }
    return "'" + text + "'";
  }

  struct IfcBuilder {
    using Names = std::vector<std::string>;
    const Proposal& proposal;
    const Options& options;
    StepFile file = {};
    std::string origin = {}, axis = {}, up = {}, body = {}, context = {}, site = {}, site_place = {};
    std::map<std::string, Names> spaces_of_use = {};
    Names outer_walls = {}, party_walls = {};
    std::map<std::string, std::string> styles = {};

    std::string point(const Point3& p) { return file.add("IFCCARTESIANPOINT", {step_coordinates(p)}); }
    std::string placement(const std::string& parent, double height) {
      const std::string at = height == 0 ? axis : file.add("IFCAXIS2PLACEMENT3D", {point({0, 0, height}), "$", "$"});
      return file.add("IFCLOCALPLACEMENT", {parent, at});
    }
    void aggregate(const std::string& name, const std::string& whole, const Names& parts) {
      if (!parts.empty()) file.add("IFCRELAGGREGATES", {guid("aggregate/" + name), "$", "$", "$", whole, step_list(parts)});
    }

    // A list of points is a third of the text of single points; the first one stands at the end again, so that it is closed.
    std::string curve(const geometry::Ring& ring) {
      Names points;
      for (const Point3& corner : ring) points.push_back(step_coordinates(corner, false));
      points.push_back(points.front());
      return file.add("IFCINDEXEDPOLYCURVE", {file.add("IFCCARTESIANPOINTLIST2D", {step_list(points)}), "$", "$"});
    }
    std::string extrusion(const geometry::PlateFace& face, double from, double height, const std::string& style) {
      const std::string outer = curve(face.outer);
      Names holes;
      for (const geometry::Ring& hole : face.holes) holes.push_back(curve(hole));
      const std::string profile = holes.empty()
                                      ? file.add("IFCARBITRARYCLOSEDPROFILEDEF", {".AREA.", "$", outer})
                                      : file.add("IFCARBITRARYPROFILEDEFWITHVOIDS", {".AREA.", "$", outer, step_list(holes)});
      const std::string at = from == 0 ? axis : file.add("IFCAXIS2PLACEMENT3D", {point({0, 0, from}), "$", "$"});
      const std::string solid = file.add("IFCEXTRUDEDAREASOLID", {profile, at, up, step_real(height)});
      if (!style.empty()) file.add("IFCSTYLEDITEM", {solid, step_list({style}), "$"});
      return solid;
    }
    std::string shape(const std::vector<geometry::PlateFace>& faces, double from, double height, const std::string& style) {
      Names solids;
      for (const geometry::PlateFace& face : faces) solids.push_back(extrusion(face, from, height, style));
      const std::string items = file.add("IFCSHAPEREPRESENTATION", {body, "'Body'", "'SweptSolid'", step_list(solids)});
      return file.add("IFCPRODUCTDEFINITIONSHAPE", {"$", "$", step_list({items})});
    }
    std::string style_of(const std::string& name, const drawing::Colour& colour) {
      std::string& style = styles[name];
      if (!style.empty()) return style;
      const std::string rgb =
          file.add("IFCCOLOURRGB", {"$", step_real(colour.red), step_real(colour.green), step_real(colour.blue)});
      const std::string shading = file.add("IFCSURFACESTYLESHADING", {rgb, "0."});
      return style = file.add("IFCSURFACESTYLE", {step_text(name), ".BOTH.", step_list({shading})});
    }

    void start() {
      const std::string length = file.add("IFCSIUNIT", {"*", ".LENGTHUNIT.", "$", ".METRE."}),
                        area = file.add("IFCSIUNIT", {"*", ".AREAUNIT.", "$", ".SQUARE_METRE."}),
                        volume = file.add("IFCSIUNIT", {"*", ".VOLUMEUNIT.", "$", ".CUBIC_METRE."}),
                        angle = file.add("IFCSIUNIT", {"*", ".PLANEANGLEUNIT.", "$", ".RADIAN."});
      const std::string units = file.add("IFCUNITASSIGNMENT", {step_list({length, area, volume, angle})});
      up = file.add("IFCDIRECTION", {step_coordinates({0, 0, 1})});
      origin = point({0, 0, 0});
      axis = file.add("IFCAXIS2PLACEMENT3D", {origin, "$", "$"});
      const double turn = proposal.reference.true_north * std::numbers::pi / 180;
      const std::string north =
          file.add("IFCDIRECTION", {step_coordinates({mathematics::sine(turn), mathematics::cosine(turn), 0}, false)});
      context = file.add("IFCGEOMETRICREPRESENTATIONCONTEXT", {"$", "'Model'", "3", "1.E-5", axis, north});
      body = file.add("IFCGEOMETRICREPRESENTATIONSUBCONTEXT",
                      {"'Body'", "'Model'", "*", "*", "*", "*", context, "$", ".MODEL_VIEW.", "$"});
      const std::string project = file.add("IFCPROJECT", {guid("project/" + proposal.file), "$", step_text(proposal.name()),
                                                          step_text(proposal.about), "$", "$", "$", step_list({context}), units});
      place();
      aggregate("project", project, {site});
    }

    // Degrees, minutes, seconds, millionths of a second.
    static std::string compound(double degrees) {
      const std::int64_t all = std::llround(std::abs(degrees) * 3600e6), sign = degrees < 0 ? -1 : 1;
      Names parts;
      for (const std::int64_t part : {all / 3600000000, all / 60000000 % 60, all / 1000000 % 60, all % 1000000})
        parts.push_back(std::to_string(sign * part));
      return step_list(parts);
    }

    void place() {
      const importing::GeoReference& reference = proposal.reference;
      if (reference.crs.starts_with("EPSG:")) {
        const std::string system = file.add("IFCPROJECTEDCRS", {step_text(reference.crs), "$", "$", "$", "$", "$", "$"});
        file.add("IFCMAPCONVERSION",
                 {context, system, step_real(reference.origin_x), step_real(reference.origin_y), "0.", "$", "$", "$"});
      }
      site_place = placement("$", 0);
      const bool is_known = reference.is_on_earth();
      site = file.add("IFCSITE", {guid("site/" + proposal.file), "$", step_text(proposal.name()), "$", "$", site_place, "$", "$",
                                  ".ELEMENT.", is_known ? compound(reference.latitude) : "$",
                                  is_known ? compound(reference.longitude) : "$", "0.", "$", "$"});
      Names properties;
      for (const auto& [name, value] : identity_of(proposal))
        properties.push_back(
            file.add("IFCPROPERTYSINGLEVALUE", {step_text(name), "$", "IFCTEXT(" + step_text(value) + ")", "$"}));
      define("identity", site,
             file.add("IFCPROPERTYSET", {guid("identity"), "$", "'BehaviourLinks'", "$", step_list(properties)}));
    }

    void define(const std::string& name, const std::string& object, const std::string& set) {
      file.add("IFCRELDEFINESBYPROPERTIES", {guid("define/" + name), "$", "$", "$", step_list({object}), set});
    }
    std::string quantity(const char* kind, const char* name, double value) {
      return file.add(kind, {step_text(name), "$", "$", step_real(value), "$"});
    }
    void quantities(const std::string& id, const std::string& object, const char* set, const Names& all) {
      define(id, object,
             file.add("IFCELEMENTQUANTITY", {guid("quantities/" + id), "$", step_text(set), "$", "$", step_list(all)}));
    }

    static double perimeter_of(const std::vector<geometry::PlateFace>& faces) {
      double sum = 0;
      for (const geometry::PlateFace& face : faces) {
        sum += geometry::perimeter(face.outer);
        for (const geometry::Ring& hole : face.holes) sum += geometry::perimeter(hole);
      }
      return sum;
    }

    std::string storey(const Building& b, const Storey& s, const std::string& parent) {
      const std::string id = b.id + "/" + std::to_string(s.number),
                        name = step_text(b.label + ", storey " + std::to_string(s.number));
      const std::string at = placement(parent, s.bottom);
      const std::string made = file.add(
          "IFCBUILDINGSTOREY", {guid("storey/" + id), "$", name, "$", "$", at, "$", "$", ".ELEMENT.", step_real(s.bottom)});
      const double height = s.top - s.bottom;
      const std::string use = use_name(b.use);
      const std::string space = file.add(
          "IFCSPACE", {guid("space/" + id), "$", name, "$", step_text(use), placement(at, 0),
                       shape(s.faces, 0, height, style_of(use, b.colour)), step_text(b.label), ".ELEMENT.", ".SPACE.", "$"});
      quantities("space/" + id, space, "Qto_SpaceBaseQuantities",
                 {quantity("IFCQUANTITYAREA", "GrossFloorArea", s.floor_area),
                  quantity("IFCQUANTITYVOLUME", "GrossVolume", area_of(s.faces) * height),
                  quantity("IFCQUANTITYLENGTH", "Height", height),
                  quantity("IFCQUANTITYLENGTH", "GrossPerimeter", perimeter_of(s.faces))});
      spaces_of_use[use].push_back(space);
      aggregate("storey/" + id, made, {space});
      Names contained = walls(b, s, id, at, height);
      if (options.slabs) {
        const std::string slab = file.add(
            "IFCSLAB", {guid("slab/" + id), "$", name, "$", "$", placement(at, 0),
                        shape(s.faces, -options.slab_thickness, options.slab_thickness, style_of("slab", {0.75, 0.75, 0.75})),
                        "$", s.number == (b.cellars.empty() ? 0 : b.cellars.back().number) ? ".BASESLAB." : ".FLOOR."});
        contained.push_back(slab);
      }
      if (!contained.empty())
        file.add("IFCRELCONTAINEDINSPATIALSTRUCTURE", {guid("contained/" + id), "$", "$", "$", step_list(contained), made});
      return made;
    }

    // Walls to the outside, and those towards neighbours.
    Names walls(const Building& b, const Storey& s, const std::string& id, const std::string& at, double height) {
      Names made;
      if (!options.walls) return made;
      for (const FacadeWall& wall : facade_walls(s, b.arc_centre, options.wall_thickness)) {
        const bool is_party = wall.side == FacadeWall::Side::neighbour;
        const char* kind = is_party                                   ? "Party wall"
                           : wall.side == FacadeWall::Side::courtyard ? "Courtyard façade"
                           : wall.side == FacadeWall::Side::plot      ? "Façade at the border of the plot"
                                                                      : "Façade";
        const std::string name = id + "/" + std::to_string(made.size());
        const std::string style = is_party ? style_of("party wall", {0.62, 0.62, 0.62}) : style_of("façade", {0.93, 0.91, 0.87});
        const std::string one = file.add(
            "IFCWALL", {guid("wall/" + name), "$", step_text(b.label + ", wall " + std::to_string(made.size())), "$",
                        step_text(kind), placement(at, 0), shape({{wall.outline, {}}}, 0, height, style), "$", ".SOLIDWALL."});
        quantities("wall/" + name, one, "Qto_WallBaseQuantities",
                   {quantity("IFCQUANTITYLENGTH", "Length", wall.length), quantity("IFCQUANTITYLENGTH", "Height", height),
                    quantity("IFCQUANTITYLENGTH", "Width", options.wall_thickness),
                    quantity("IFCQUANTITYAREA", "GrossSideArea", wall.length * height)});
        (is_party ? party_walls : outer_walls).push_back(one);
        made.push_back(one);
      }
      return made;
    }

    // Whether walls are external is said once for all of a kind.
    void common() {
      for (const auto& [walls, is_external] : {std::pair(&outer_walls, true), std::pair(&party_walls, false)}) {
        if (walls->empty()) continue;
        const std::string name = is_external ? "outer" : "party";
        const std::string value =
            file.add("IFCPROPERTYSINGLEVALUE", {"'IsExternal'", "$", is_external ? "IFCBOOLEAN(.T.)" : "IFCBOOLEAN(.F.)", "$"});
        const std::string set =
            file.add("IFCPROPERTYSET", {guid("walls/" + name), "$", "'Pset_WallCommon'", "$", step_list({value})});
        file.add("IFCRELDEFINESBYPROPERTIES", {guid("define/walls/" + name), "$", "$", "$", step_list(*walls), set});
      }
    }

    void buildings() {
      Names all;
      for (const Building& b : proposal.buildings) {
        const std::string at = placement(site_place, 0);
        const std::string made = file.add("IFCBUILDING", {guid("building/" + b.id), "$", step_text(b.label), "$",
                                                          step_text(b.use), at, "$", "$", ".ELEMENT.", "$", "$", "$"});
        Names storeys;
        double cellars = 0;
        for (auto s = b.cellars.rbegin(); s != b.cellars.rend(); ++s)
          storeys.push_back(storey(b, *s, at)), cellars += s->floor_area;
        for (const Storey& s : b.storeys) storeys.push_back(storey(b, s, at));
        aggregate("building/" + b.id, made, storeys);
        quantities(
            "building/" + b.id, made, "Qto_BuildingBaseQuantities",
            {quantity("IFCQUANTITYAREA", "GrossFloorArea", b.floor_area), quantity("IFCQUANTITYVOLUME", "GrossVolume", b.volume),
             quantity("IFCQUANTITYAREA", "FootprintArea", b.footprint),
             quantity("IFCQUANTITYLENGTH", "Height", b.top - b.bottom)});
        // Of cellars by itself: the floor area is that above the ground.
        if (cellars > 0)
          quantities("cellar/" + b.id, made, "BehaviourLinks_Cellar", {quantity("IFCQUANTITYAREA", "CellarArea", cellars)});
        all.push_back(made);
      }
      aggregate("site", site, all);
    }

    void surroundings() {
      Names all;
      for (const Neighbour& n : proposal.neighbours)
        if (n.top > n.bottom)
          all.push_back(file.add(
              "IFCBUILDINGELEMENTPROXY",
              {guid("existing/" + n.id), "$", step_text(n.name), "'Existing building'", step_text(n.use),
               placement(site_place, 0), shape({n.face}, n.bottom, n.top - n.bottom, style_of("existing", {0.8, 0.8, 0.78})), "$",
               ".NOTDEFINED."}));
      if (!all.empty())
        file.add("IFCRELCONTAINEDINSPATIALSTRUCTURE", {guid("contained/existing"), "$", "$", "$", step_list(all), site});
    }

    // A thin body below the ground of each use, and of streets that are kept clear.
    void open_ground() {
      constexpr double kThickness = 0.1;  // [m]
      Names all;
      const auto add = [&](const std::string& id, const std::string& name, const char* kind, const drawing::Colour& colour,
                           const std::vector<geometry::PlateFace>& faces) {
        const std::string one =
            file.add("IFCGEOGRAPHICELEMENT",
                     {guid(id), "$", step_text(name), step_text(kind), step_text(name), placement(site_place, 0),
                      shape(faces, proposal.ground - kThickness, kThickness, style_of("ground of " + name, colour)), "$",
                      ".USERDEFINED."});
        all.push_back(one);
        return one;
      };
      for (const OpenSpace& open : proposal.open_spaces) {
        if (open.faces.empty()) continue;
        const std::string id = "open_space/" + open.use;
        const std::string one = add(id, open.use, "Open space", drawing::mix(open.colour, drawing::kWhite, 0.3), open.faces);
        quantities(
            id, one, "BehaviourLinks_OpenSpace",
            {quantity("IFCQUANTITYAREA", "OpenArea", open.area), quantity("IFCQUANTITYAREA", "AskedArea", open.asked_area)});
      }
      for (const KeptGround& kept : proposal.kept)
        add("kept_clear/" + kept.kind, kept.kind, "Ground kept clear", {0.85, 0.85, 0.83}, kept.faces);
      if (!all.empty())
        file.add("IFCRELCONTAINEDINSPATIALSTRUCTURE", {guid("contained/ground"), "$", "$", "$", step_list(all), site});
    }

    void classification() {
      const std::string system = file.add("IFCCLASSIFICATION", {"$", "$", "$", "'Uses of the scene'", "$", "$", "$"});
      for (const auto& [use, spaces] : spaces_of_use) {
        const std::string one = file.add("IFCCLASSIFICATIONREFERENCE", {"$", step_text(use), step_text(use), system, "$", "$"});
        file.add("IFCRELASSOCIATESCLASSIFICATION", {guid("use/" + use), "$", "$", "$", step_list(spaces), one});
      }
    }
  };

  static Result<ExportFiles> write(const Proposal& proposal, const Options& options) {
    IfcBuilder made{proposal, options};
    made.start();
    made.buildings();
    made.open_ground();
    if (options.surroundings) made.surroundings();
    made.classification();
    made.common();
    ExportFiles files;
    if (!proposal.reference.crs.starts_with("EPSG:"))
      files.notes.push_back("the scene has no coordinate system with an EPSG code: the model has no map conversion" +
                            way_to_system(proposal));
    // Bodies that another form makes of rounded volumes.
    const auto bare =
        static_cast<std::size_t>(std::count_if(proposal.buildings.begin(), proposal.buildings.end(), [](const Building& b) {
          return b.is_standing && b.storeys.front().rings.empty();
        }));
    if (options.walls && bare > 0)
      files.notes.push_back(reading::counted(bare, "volume") + " " + reading::choice_of(proposal.form).measured +
                            (bare == 1 ? " has" : " have") + " no walls: what the sides border on is not known");
    files.files.push_back({"proposal.ifc", made.file.str("BehaviourLinks: " + identity_line(proposal), proposal.file, "IFC4")});
    return files;
  }
};

}  // namespace

BL_FORMAT(ifc, IfcFormat)

}  // namespace bl::exporting
