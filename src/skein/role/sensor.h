// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "skein/base/time.h"
#include "skein/data/perimeter/object.h"
#include "skein/data/traffic/traffic.h"
#include "skein/data/vehicle/air.h"
#include "skein/data/vehicle/sensing.h"
#include "skein/data/vehicle/vehicle.h"
#include "skein/role/phenomenon.h"
#include "skein/role/terrain.h"

namespace skein {

/// What a sensor may look at.
struct SensorView {
  Time now;
  const VehicleState& vehicle;
  const Air& air;  ///< that the vehicle is in
  const Terrain& terrain;
  Phenomena phenomena = {};
  std::span<const VisibleObject> objects = {};
  /// Where gimbals are to look, from the vehicle, as its autopilot believes [m]; none:
  /// straight down.
  std::optional<Vec3> gaze_N = {};
  /// Aircraft in the air around, the vehicle itself among them.
  std::span<const VisibleAircraft> aircraft = {};
};

/// One sensor of one vehicle, with its errors, rate and random stream.
class Sensor {
 public:
  virtual ~Sensor() = default;

  /// Whether it looks at the world for the agent. Others serve the autopilot, which is
  /// the only one to get their samples; they see phenomena and objects never.
  virtual bool payload() const { return false; }

  /// Whether it finds objects on the ground.
  virtual bool finds_objects() const { return false; }

  /// Whether it finds other aircraft.
  virtual bool finds_aircraft() const { return false; }

  /// Whether it says where a fire is.
  virtual bool senses_fire() const { return false; }

  /// Appends what the sensor has to say at `view.now`; nothing between its samples.
  virtual void sample(const SensorView& view, std::vector<SensorSample>& out) = 0;
};

}  // namespace skein
