// What stands around the volumes: buildings, terrain, data, pictures.
#pragma once

#include "core/reading/view.h"

namespace bl::reading {

/// A building that stands already.
struct BuildingFigures {
  std::string use;
  std::vector<Point3> outline;  ///< [m]
  Shared<Table> holes;          ///< corners of its courts
  double base = 0;              ///< height of its underside above the origin [m]
  double top = 0;               ///< and of its highest point [m]
  bool is_assumed = false;      ///< nobody has measured its height
  MeshPointer mesh;

  static void declare(ViewBuilder<BuildingFigures>& v);
  static const ViewDefinition& view();
};

/// The ground as a mesh.
struct TerrainFigures {
  MeshPointer mesh;

  static void declare(ViewBuilder<TerrainFigures>& v);
  static const ViewDefinition& view();
};

/// Values on points of the ground.
struct DataLayerFigures {
  Shared<Table> values;
  std::string quantity;
  std::string unit;  ///< as people have written it
  double minimum = 0;
  double maximum = 0;

  static void declare(ViewBuilder<DataLayerFigures>& v);
  static const ViewDefinition& view();
};

/// A picture, or a sequence of pictures.
struct MediaFigures {
  Point3 position;   ///< [m]
  std::string file;  ///< as the scene names it
  std::string kind;
  double rate = 0;  ///< frames of a sequence in each second
  std::int64_t frames = 0;
  std::string placement;
  double azimuth = 0;   ///< [degrees]
  double tilt = 0;      ///< [degrees]
  double distance = 0;  ///< [m]
  double opacity = 0;
  std::string author;
  std::string licence;
  std::int64_t orientation = 0;  ///< as cameras write it
  std::string taken;             ///< when
  double width = 0;              ///< [m]
  double height = 0;             ///< [m]
  bool is_free = false;          ///< it may be shown and handed on
  std::string message;           ///< why it is veiled or cannot be placed

  static void declare(ViewBuilder<MediaFigures>& v);
  static const ViewDefinition& view();
};

}  // namespace bl::reading
