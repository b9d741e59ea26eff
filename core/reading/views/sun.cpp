// The sun over a place, who casts shadows, and where sun falls.
#include "core/reading/views/sun.h"

namespace bl::reading {

void SunFigures::declare(ViewBuilder<SunFigures>& v) {
  v.of("sun_and_sky");
  v.reads(&SunFigures::latitude, "sun_and_sky.latitude", Unit::degree);
  v.reads(&SunFigures::longitude, "sun_and_sky.longitude", Unit::degree);
  v.reads(&SunFigures::elevation, "sun_and_sky.elevation", Unit::metre);
  v.reads(&SunFigures::true_north, "sun_and_sky.true_north", Unit::degree);
  v.reads(&SunFigures::utc_offset, "sun_and_sky.utc_offset", Unit::second);
  v.reads(&SunFigures::daylight_saving, "sun_and_sky.daylight_saving");
  v.reads(&SunFigures::date, "sun_and_sky.date");
  v.reads(&SunFigures::days, "sun_and_sky.days");
  v.reads(&SunFigures::time, "sun_and_sky.time", Unit::second);
  v.reads(&SunFigures::refraction, "sun_and_sky.refraction");
  v.reads(&SunFigures::pressure, "sun_and_sky.pressure");
  v.reads(&SunFigures::temperature, "sun_and_sky.temperature");
  v.reads(&SunFigures::delta_t, "sun_and_sky.delta_t", Unit::second);
  v.reads(&SunFigures::direction, "sun_and_sky.direction");
}
BL_VIEW(SunFigures)

void SunStudyFigures::declare(ViewBuilder<SunStudyFigures>& v) {
  v.of("sun_study");
  v.reads(&SunStudyFigures::ground, "sun_study.ground", Unit::metre);
}
BL_VIEW(SunStudyFigures)

void CasterFigures::declare(ViewBuilder<CasterFigures>& v) {
  v.of("shadow_caster");
  v.reads(&CasterFigures::casts, "shadow_caster.casts");
  v.reads(&CasterFigures::outline, "shadow_caster.outline", Unit::metre);
}
BL_VIEW(CasterFigures)

void ReceiverFigures::declare(ViewBuilder<ReceiverFigures>& v) {
  v.of("shadow_receiver");
  v.reads(&ReceiverFigures::upright, "shadow_receiver.upright");
  v.reads(&ReceiverFigures::half_across, "shadow_receiver.half_across", Unit::metre);
  v.reads(&ReceiverFigures::half_up, "shadow_receiver.half_up", Unit::metre);
  v.reads(&ReceiverFigures::sun_mean, "shadow_receiver.sun_mean", Unit::second);
  v.reads(&ReceiverFigures::sun_possible, "shadow_receiver.sun_possible", Unit::second);
  v.reads(&ReceiverFigures::required_sun, "shadow_receiver.required_sun", Unit::second);
  v.reads(&ReceiverFigures::required_share, "shadow_receiver.required_share", Unit::ratio);
  v.reads(&ReceiverFigures::share_met, "shadow_receiver.share_met", Unit::ratio);
  v.reads(&ReceiverFigures::columns, "shadow_receiver.columns", Unit::count);
  v.reads(&ReceiverFigures::map, "shadow_receiver.map");
}
BL_VIEW(ReceiverFigures)

BL_VIEWS(sun, SunFigures, SunStudyFigures, CasterFigures, ReceiverFigures)

}  // namespace bl::reading
