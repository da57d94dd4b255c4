#include "layer/reasoning/monitoring/strategy/time_to_go.h"

#include "model/path/point_path.h"

namespace skein::monitoring {

double time_to_go(const AircraftStatus& aircraft, const Vec2& place) {
  const NavEstimate& nav = aircraft.nav;
  return model::time_to_point({geo::horizontal(nav.p_N), nav.heading}, place,
                              aircraft.limits.airspeed, aircraft.limits.turn_radius,
                              nav.wind_N);
}

}  // namespace skein::monitoring
