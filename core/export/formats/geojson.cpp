// Footprints, plots and surroundings with their figures as GeoJSON (RFC 7946): longitude and latitude, right-hand rule.
#include <cmath>
#include <optional>

#include <nlohmann/json.hpp>

#include "core/export/digits.h"
#include "core/export/format.h"
#include "core/export/identity.h"
#include "core/export/read_proposal.h"

namespace bl::exporting {

namespace {

using Ordered = nlohmann::ordered_json;

enum class GeoFrame { wgs84, scene };

struct GeoJsonFormat {
  struct Options : FormOptions {
    GeoFrame coordinates = GeoFrame::wgs84;
    bool surroundings = true;
  };

  static void declare(FormatBuilder<GeoJsonFormat>& f) {
    f.id("geojson").label("Footprints (GeoJSON)");
    f.doc(
        "Outlines of buildings, plots and surroundings with their figures as properties, by RFC 7946: longitude and latitude on "
        "WGS84, outer rings counter-clockwise. A scene that does not say where it lies on Earth is refused, unless its own "
        "metres "
        "are asked for.");
    f.ending(".geojson").begins("{\"type\":\"FeatureCollection\",\"generator\":\"BehaviourLinks\"");
    f.option(&Options::coordinates, "coordinates",
             {{GeoFrame::wgs84, "wgs84", "Longitude and latitude, as RFC 7946 wants them."},
              {GeoFrame::scene, "scene",
               "Metres of the scene's coordinate system, or from its origin where it has none; a note says so."}})
        .doc("What the coordinates are.");
    f.option(&Options::surroundings, "surroundings").doc("With the buildings that stand already, and streets.");
    declare_form_option(f);
  }

  static Result<ExportFiles> write(const Proposal& proposal, const Options& options) {
    return GeoWriter{proposal, options}.write();
  }

  struct GeoWriter {
    const Proposal& proposal;
    const Options& options;
    std::optional<WayToEarth> way = {};
    Ordered features = Ordered::array();
    bool is_all_finite = true;
    double west = 1e300, south = 1e300, east = -1e300, north = -1e300;

    double digits(double value) const { return way ? to_map_digits(value) : to_millionths(value); }

    Ordered place(const Point3& p) {
      const Point3 there =
          way ? way->degrees(p) : Point3{p.x + proposal.reference.origin_x, p.y + proposal.reference.origin_y, 0};
      is_all_finite = is_all_finite && std::isfinite(there.x) && std::isfinite(there.y);
      west = std::min(west, there.x), east = std::max(east, there.x);
      south = std::min(south, there.y), north = std::max(north, there.y);
      return Ordered::array({digits(there.x), digits(there.y)});
    }

    Ordered ring(const geometry::Ring& corners) {
      Ordered list = Ordered::array();
      for (const Point3& corner : corners) list.push_back(place(corner));
      if (!list.empty()) list.push_back(list.front());
      return list;
    }

    Ordered polygons(const std::vector<geometry::PlateFace>& faces) {
      Ordered all = Ordered::array();
      for (const geometry::PlateFace& face : faces) {
        Ordered polygon = Ordered::array({ring(face.outer)});
        for (const geometry::Ring& hole : face.holes) polygon.push_back(ring(hole));
        all.push_back(std::move(polygon));
      }
      const bool is_one = all.size() == 1;
      return {{"type", is_one ? "Polygon" : "MultiPolygon"}, {"coordinates", is_one ? all.front() : all}};
    }

    void add(std::string id, Ordered geometry, Ordered properties) {
      features.push_back(
          {{"type", "Feature"}, {"id", std::move(id)}, {"geometry", std::move(geometry)}, {"properties", std::move(properties)}});
    }

    void add_land(const Land& land) {
      Ordered figures = {
          {"kind", land.is_boundary ? "boundary" : "plot"}, {"name", land.name}, {"area_m2", to_millionths(land.area)}};
      if (!land.is_boundary) {
        figures["fsi"] = to_millionths(land.fsi);
        figures["gsi"] = to_millionths(land.gsi);
        for (const auto& [name, rule] :
             {std::pair("fsi_max", land.fsi_max), std::pair("gsi_max", land.gsi_max), std::pair("height_max_m", land.height_max)})
          figures[name] = rule ? Ordered(*rule) : Ordered();
      }
      add((land.is_boundary ? "boundary/" : "plot/") + land.id, polygons(land.faces), std::move(figures));
    }

    void add_open_space(const OpenSpace& open) {
      if (open.faces.empty()) return;
      add("open_space/" + open.use, polygons(open.faces),
          {{"kind", "open_space"},
           {"use", open.use},
           {"area_m2", to_millionths(open.area)},
           {"asked_area_m2", to_millionths(open.asked_area)},
           {"colour", drawing::hex(open.colour)}});
    }

    // Ground on which nothing is built. Strips of streets lie over each other where these cross: no area is told.
    void add_kept(const KeptGround& kept) {
      add("kept_clear/" + kept.kind, polygons(kept.faces), {{"kind", "kept_clear"}, {"name", kept.kind}});
    }

    void add_building(const Building& b) {
      if (b.outline.empty()) return;
      add("building/" + b.id, polygons(b.outline),
          {{"kind", "building"},
           {"name", b.label},
           {"use", b.use},
           {"form", b.is_standing ? "standing" : "rounded"},
           {"storeys", b.storeys.size()},
           {"floor_area_m2", to_millionths(b.floor_area)},
           {"asked_floor_area_m2", to_millionths(b.asked_area)},
           {"volume_m3", to_millionths(b.volume)},
           {"asked_volume_m3", to_millionths(b.asked_volume)},
           {"footprint_m2", to_millionths(b.footprint)},
           {"drawn_area_m2", to_millionths(area_of(b.outline))},
           {"bottom_m", to_millimetres(b.bottom)},
           {"top_m", to_millimetres(b.top)},
           {"colour", drawing::hex(b.colour)}});
    }

    void add_surroundings() {
      for (const Neighbour& n : proposal.neighbours)
        add("existing/" + n.id, polygons({n.face}),
            {{"kind", "existing_building"},
             {"name", n.name},
             {"use", n.use},
             {"bottom_m", to_millimetres(n.bottom)},
             {"top_m", to_millimetres(n.top)}});
      std::size_t number = 0;
      for (const Street& street : proposal.streets) {
        Ordered line = Ordered::array();
        for (const Point3& p : street.line) line.push_back(place(p));
        if (line.size() > 1)
          add("street/" + std::to_string(++number), {{"type", "LineString"}, {"coordinates", line}},
              {{"kind", "street"}, {"name", street.name}});
      }
    }

    Result<ExportFiles> write() {
      ExportFiles made;
      if (options.coordinates == GeoFrame::wgs84) {
        auto found = WayToEarth::make(proposal);
        if (!found)
          return Error{found.error().code, "",
                       found.error().message + "; or choose `scene` for the option `coordinates`, which writes its own metres"};
        way.emplace(std::move(*found));
      } else {
        made.notes.push_back(
            "the coordinates are metres of the scene, which programs that follow RFC 7946 take for degrees: tell them");
      }
      for (const Land& land : proposal.lands) add_land(land);
      for (const OpenSpace& open : proposal.open_spaces) add_open_space(open);
      for (const KeptGround& kept : proposal.kept) add_kept(kept);
      for (const Building& building : proposal.buildings) add_building(building);
      if (options.surroundings) add_surroundings();
      if (!is_all_finite)
        return Error{ErrorCode::out_of_range, "",
                     "a point of the scene has no place on Earth in `" + proposal.reference.crs + "`"};
      Ordered document = {{"type", "FeatureCollection"}, {"generator", "BehaviourLinks"}, {"name", proposal.name()}};
      if (!way && is_placed(proposal) && proposal.reference.crs.starts_with("EPSG:"))
        document["crs"] = {{"type", "name"},
                           {"properties", {{"name", "urn:ogc:def:crs:EPSG::" + proposal.reference.crs.substr(5)}}}};
      for (const auto& [name, value] : identity_of(proposal)) document["scene"][name] = value;
      document["scene"]["coordinates"] = way ? "longitude and latitude, WGS84" : "metres";
      if (west <= east) document["bbox"] = {digits(west), digits(south), digits(east), digits(north)};
      document["features"] = std::move(features);
      made.files.push_back({"proposal.geojson", document.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n"});
      return made;
    }
  };
};

}  // namespace

BL_FORMAT(geojson, GeoJsonFormat)

}  // namespace bl::exporting
