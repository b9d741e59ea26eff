// What stands around the volumes: buildings, terrain, data, pictures.
#include "core/reading/views/surroundings.h"

namespace bl::reading {

void BuildingFigures::declare(ViewBuilder<BuildingFigures>& v) {
  v.of("existing_building");
  v.reads(&BuildingFigures::use, "existing_building.use");
  v.reads(&BuildingFigures::outline, "existing_building.outline", Unit::metre);
  v.reads(&BuildingFigures::holes, "existing_building.holes");
  v.reads(&BuildingFigures::base, "existing_building.base", Unit::metre);
  v.reads(&BuildingFigures::top, "existing_building.top", Unit::metre);
  v.reads(&BuildingFigures::is_assumed, "existing_building.is_assumed");
  v.reads(&BuildingFigures::mesh, "existing_building.mesh");
}
BL_VIEW(BuildingFigures)

void TerrainFigures::declare(ViewBuilder<TerrainFigures>& v) {
  v.of("terrain");
  v.reads(&TerrainFigures::mesh, "terrain.mesh");
}
BL_VIEW(TerrainFigures)

void DataLayerFigures::declare(ViewBuilder<DataLayerFigures>& v) {
  v.of("data_layer");
  v.reads(&DataLayerFigures::values, "data_layer.values");
  v.reads(&DataLayerFigures::quantity, "data_layer.quantity");
  v.reads(&DataLayerFigures::unit, "data_layer.unit");
  v.reads(&DataLayerFigures::minimum, "data_layer.minimum");
  v.reads(&DataLayerFigures::maximum, "data_layer.maximum");
}
BL_VIEW(DataLayerFigures)

void MediaFigures::declare(ViewBuilder<MediaFigures>& v) {
  v.of("media");
  v.reads(&MediaFigures::position, "node.position", Unit::metre);
  v.reads(&MediaFigures::file, "media.file");
  v.reads(&MediaFigures::kind, "media.kind");
  v.reads(&MediaFigures::rate, "media.rate");
  v.reads(&MediaFigures::frames, "media.frames");
  v.reads(&MediaFigures::placement, "media.placement");
  v.reads(&MediaFigures::azimuth, "media.azimuth", Unit::degree);
  v.reads(&MediaFigures::tilt, "media.tilt", Unit::degree);
  v.reads(&MediaFigures::distance, "media.distance", Unit::metre);
  v.reads(&MediaFigures::opacity, "media.opacity", Unit::ratio);
  v.reads(&MediaFigures::author, "media.author");
  v.reads(&MediaFigures::licence, "media.licence");
  v.reads(&MediaFigures::orientation, "media.orientation");
  v.reads(&MediaFigures::taken, "media.taken");
  v.reads(&MediaFigures::width, "media.width", Unit::metre);
  v.reads(&MediaFigures::height, "media.height", Unit::metre);
  v.reads(&MediaFigures::is_free, "media.is_free");
  v.reads(&MediaFigures::message, "media.message");
}
BL_VIEW(MediaFigures)

BL_VIEWS(surroundings, BuildingFigures, TerrainFigures, DataLayerFigures, MediaFigures)

}  // namespace bl::reading
