#include "layer/environment/turbulence/discrete_gusts.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"

namespace skein::environment {
namespace {

constexpr double kSlowest = 1;  // [m/s]

}  // namespace

double gust_share(const DiscreteGust& gust, double way) {
  const double end = 2 * gust.length + gust.hold;
  const double x = std::min(way, end - way);  // it falls as it rises
  if (x <= 0) return 0;
  return x >= gust.length ? 1 : (1 - std::cos(geo::kPi * x / gust.length)) / 2;
}

DiscreteGusts::DiscreteGusts(const DiscreteGustsOptions& options) {
  for (const DiscreteGust& gust : options.gusts) {
    SKEIN_CHECK(gust.length > 0 && gust.hold >= 0, gust.length, gust.hold);
    gusts_.push_back({gust, Time::from_seconds(gust.start)});
  }
}

Gust DiscreteGusts::advance(const TurbulenceView& view, double dt) {
  Gust felt;
  const double speed = std::max(view.vehicle.airspeed, kSlowest);
  for (Met& met : gusts_) {
    if (view.now < met.start) continue;
    if (met.way < 0) met.way = speed * (view.now - met.start).seconds();
    const double share = gust_share(met.gust, met.way);
    met.way += speed * dt;
    if (share == 0) continue;
    const Vec3 velocity = share * met.gust.amplitude;
    felt.velocity_N +=
        met.gust.frame == GustFrame::kBody ? view.vehicle.q_NB * velocity : velocity;
  }
  return felt;
}

}  // namespace skein::environment
