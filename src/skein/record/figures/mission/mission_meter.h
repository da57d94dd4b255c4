// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "skein/data/perimeter/object.h"
#include "skein/data/team/mission.h"
#include "skein/data/vehicle/payload.h"

namespace skein::record {

/// One figure of a mission, with its unit in the name: "seen", "revisit_max_s".
struct MissionFigure {
  std::string_view name;
  double value = 0;
};

/// Measures how far one mission reaches its goal, by the truth that records hold. Fed
/// while the mission runs, in order of time.
class MissionMeter {
 public:
  virtual ~MissionMeter() = default;

  /// An aircraft flies from one place to another, straight and in no more than a second
  /// or so [m].
  virtual void moved(Time /*time*/, EntityId /*aircraft*/, const Vec2& /*from*/,
                     const Vec2& /*to*/) {}
  /// An aircraft takes no further part.
  virtual void left(EntityId /*aircraft*/) {}
  virtual void detected(const Detection& /*detection*/) {}
  virtual void pictured(const Footprint& /*picture*/) {}
  virtual void object_moves(const ObjectMotion& /*motion*/) {}
  virtual void believed(Time /*time*/, const ObjectBelief& /*belief*/) {}

  /// The mission is to reach something else from now on.
  virtual void goal_changed(const MissionGoal& /*goal*/) {}

  /// A second has passed.
  virtual void tick(Time /*now*/) {}

  /// The figures so far; those that cannot be said yet are left out.
  virtual std::vector<MissionFigure> figures(Time now) const = 0;
};

}  // namespace skein::record
