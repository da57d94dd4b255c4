// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "skein/role/turbulence.h"

namespace skein::environment {

/// What the components of a gust's amplitude are along.
enum class GustFrame : std::uint8_t {
  kLocal,  ///< north, east, down
  kBody,   ///< forward, right, down
};

/// One discrete gust.
struct DiscreteGust {
  double start = 0;               ///< when the vehicle enters it [s]
  Vec3 amplitude = Vec3::Zero();  ///< velocity of the air where it is strongest [m/s]
  GustFrame frame = GustFrame::kLocal;
  double length = 50;  ///< distance through the air from nothing to full strength [m]
  double hold = 0;     ///< distance at full strength, before it falls as it rose [m]
};

/// Share of its amplitude that a gust has `way` [m] behind where it begins:
///
///   (1 - cos(pi way/length))/2 up to length, 1 for hold, then back likewise.
///
/// The standard's gust, which stays, is the one with a hold without end.
/// Reference: [MIL-F-8785C] 3.7.1.3.
double gust_share(const DiscreteGust& gust, double distance);

/// How gust_share() grows along the path [1/m].
double gust_slope(const DiscreteGust& gust, double distance);

struct DiscreteGustsOptions {
  std::vector<DiscreteGust> gusts = {};
};

/// Discrete gusts of the form 1 - cosine along the vehicle's path through the air; those
/// that overlap add up. Where a gust changes along the path x the air turns: q = -dw/dx,
/// r = dv/dx, about the body's axes. Airspeed counts as at least 1 m/s.
class DiscreteGusts final : public Turbulence {
 public:
  explicit DiscreteGusts(const DiscreteGustsOptions& options);

  Gust advance(const TurbulenceView& view, double dt) override;

 private:
  struct Met {
    DiscreteGust gust;
    Time start;
    double distance = -1;  // behind its beginning [m]; not yet there
  };
  std::vector<Met> gusts_;
};

}  // namespace skein::environment
