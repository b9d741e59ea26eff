// What a SmartVolumes solver divides, and how far it has come.
#include "core/reading/views/solver.h"

namespace bl::reading {

void SolverFigures::declare(ViewBuilder<SolverFigures>& v) {
  v.of("smart_volumes_solver");
  v.reads(&SolverFigures::tessellation_depth, "smart_volumes_solver.tessellation_depth");
  v.reads(&SolverFigures::total_demand, "smart_volumes_solver.total_demand", Unit::cubic_metre);
  v.reads(&SolverFigures::total_volume, "smart_volumes_solver.total_volume", Unit::cubic_metre);
  v.reads(&SolverFigures::boundary_volume, "smart_volumes_solver.boundary_volume", Unit::cubic_metre);
  v.reads(&SolverFigures::fill, "smart_volumes_solver.fill", Unit::ratio);
  v.reads(&SolverFigures::message, "smart_volumes_solver.message");
}
BL_VIEW(SolverFigures)

void StandingFigures::declare(ViewBuilder<StandingFigures>& v) {
  v.of("standing_solver");
  v.reads(&StandingFigures::plot_area, "standing_solver.plot_area", Unit::square_metre);
  v.reads(&StandingFigures::open_area, "standing_solver.open_area", Unit::square_metre);
  v.reads(&StandingFigures::fsi, "standing_solver.fsi", Unit::ratio);
  v.reads(&StandingFigures::gsi, "standing_solver.gsi", Unit::ratio);
  v.reads(&StandingFigures::osr, "standing_solver.osr", Unit::ratio);
  v.reads(&StandingFigures::mean_storeys, "standing_solver.mean_storeys");
  v.reads(&StandingFigures::message, "standing_solver.message");
}
BL_VIEW(StandingFigures)

void BoundarySettings::declare(ViewBuilder<BoundarySettings>& v) {
  v.of("boundary");
  v.reads(&BoundarySettings::form, "boundary.form");
  v.reads(&BoundarySettings::plan, "boundary.plan");
  v.reads(&BoundarySettings::bottom, "boundary.bottom", Unit::metre);
  v.reads(&BoundarySettings::height, "boundary.height", Unit::metre);
  v.reads(&BoundarySettings::points, "boundary.points");
  v.reads(&BoundarySettings::vertices, "boundary.vertices");
}
BL_VIEW(BoundarySettings)

void BoundaryFigures::declare(ViewBuilder<BoundaryFigures>& v) {
  v.of("boundary");
  v.reads(&BoundaryFigures::volume, "boundary.volume", Unit::cubic_metre);
  v.reads(&BoundaryFigures::ground_area, "boundary.ground_area", Unit::square_metre);
  v.reads(&BoundaryFigures::open_area, "boundary.open_area", Unit::square_metre);
  v.reads(&BoundaryFigures::shape, "boundary.shape");
  v.reads(&BoundaryFigures::planes, "boundary.planes");
}
BL_VIEW(BoundaryFigures)

void OpenGround::declare(ViewBuilder<OpenGround>& v) {
  v.of("boundary");
  v.reads(&OpenGround::areas, "boundary.open_areas");
  v.reads(&OpenGround::exclusions, "boundary.exclusions");
  v.reads(&OpenGround::form, "boundary.form");
  v.reads(&OpenGround::bottom, "boundary.bottom", Unit::metre);
  v.reads(&OpenGround::height, "boundary.height", Unit::metre);
}
BL_VIEW(OpenGround)

BL_VIEWS(solver, SolverFigures, StandingFigures, BoundarySettings, BoundaryFigures, OpenGround)

}  // namespace bl::reading
