// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/turbulence/discrete_gusts.h"

#include <algorithm>

#include "skein/base/check.h"
#include "skein/base/math.h"

namespace skein::environment {
namespace {

constexpr double kSlowest = 1;  // [m/s]

}  // namespace

double gust_share(const DiscreteGust& gust, double distance) {
  const double end = 2 * gust.length + gust.hold;
  const double x = std::min(distance, end - distance);  // it falls as it rises
  if (x <= 0) return 0;
  return x >= gust.length ? 1 : (1 - math::cos(geo::kPi * x / gust.length)) / 2;
}

double gust_slope(const DiscreteGust& gust, double distance) {
  const double end = 2 * gust.length + gust.hold;
  const bool falls = distance > end / 2;
  const double x = falls ? end - distance : distance;
  if (x <= 0 || x >= gust.length) return 0;
  const double slope =
      geo::kPi / (2 * gust.length) * math::sin(geo::kPi * x / gust.length);
  return falls ? -slope : slope;
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
    if (met.distance < 0) met.distance = speed * (view.now - met.start).seconds();
    const double share = gust_share(met.gust, met.distance);
    const double slope = gust_slope(met.gust, met.distance);
    met.distance += speed * dt;
    if (share == 0) continue;
    const bool in_body = met.gust.frame == GustFrame::kBody;
    const Quat& q_NB = view.vehicle.q_NB;
    felt.velocity_N += share * (in_body ? q_NB * met.gust.amplitude : met.gust.amplitude);
    // The gust grows along the path, which is forward: the air there turns.
    const Vec3 gradient_B =
        slope * (in_body ? met.gust.amplitude : q_NB.conjugate() * met.gust.amplitude);
    felt.rates_B += Vec3(0, -gradient_B.z(), gradient_B.y());
  }
  return felt;
}

}  // namespace skein::environment
