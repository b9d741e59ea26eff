// What receivers of sun ask for, and what links leave them.
#include "core/reading/views/sun_need.h"

namespace bl::reading {

void SunNeed::declare(ViewBuilder<SunNeed>& v) {
  v.of("shadow_receiver");
  v.reads(&SunNeed::required_sun, "shadow_receiver.required_sun", Unit::second);
  v.reads(&SunNeed::required_share, "shadow_receiver.required_share", Unit::ratio);
  v.reads(&SunNeed::share_met, "shadow_receiver.share_met", Unit::ratio);
  v.reads(&SunNeed::sun_of_share, "shadow_receiver.sun_of_share", Unit::second);
  v.reads(&SunNeed::sun_possible, "shadow_receiver.sun_possible", Unit::second);
  v.reads(&SunNeed::deficit, "shadow_receiver.deficit", Unit::second);
  v.reads(&SunNeed::columns, "shadow_receiver.columns", Unit::count);
}
BL_VIEW(SunNeed)

void SunRightParameters::declare(ViewBuilder<SunRightParameters>& v) {
  v.of_links("solar_right");
  v.reads(&SunRightParameters::tolerance, "solar_right.tolerance", Unit::ratio);
  v.reads(&SunRightParameters::play, "solar_right.play", Unit::ratio);
}
BL_VIEW(SunRightParameters)

BL_VIEWS(sun_need, SunNeed, SunRightParameters)

}  // namespace bl::reading
