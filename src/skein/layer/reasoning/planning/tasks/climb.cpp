#include "skein/layer/reasoning/planning/tasks/climb.h"

#include <cmath>

#include "skein/model/path/flight_plan.h"

namespace skein::planning {

bool climb_along(FlightPlan& plan, double from_down, double to_down,
                 const FlightLimits& limits) {
  FlightPlan out;
  double down = from_down;
  for (FlightElement e : plan) {
    e.p_N.z() = down;
    e.climb_rate = 0;
    const double missing = down - to_down;  // upwards
    if (std::abs(missing) < 1e-9) {
      out.push_back(e);
      continue;
    }
    const double rate = missing > 0 ? limits.climb_rate : -limits.sink_rate;
    if (rate == 0) return false;
    const double needed = missing / rate;
    e.climb_rate = rate;
    if (needed >= e.duration) {
      out.push_back(e);
      down -= rate * e.duration;
      continue;
    }
    FlightElement rest = e;
    const model::FlightMoment there = model::moment(e, needed);
    e.duration = needed;
    rest.start += needed;
    rest.duration -= needed;
    rest.p_N = there.p_N;
    rest.p_N.z() = to_down;
    rest.heading = there.heading;
    rest.climb_rate = 0;
    out.push_back(e);
    out.push_back(rest);
    down = to_down;
  }
  plan = std::move(out);
  return std::abs(down - to_down) < 1e-6;
}

}  // namespace skein::planning
