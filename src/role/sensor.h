#pragma once

#include <vector>

#include "base/time.h"
#include "data/sensing.h"
#include "data/vehicle.h"
#include "role/phenomenon.h"
#include "role/terrain.h"

namespace skein {

/// What a sensor may look at.
struct SensorView {
  Time now;
  const VehicleState& vehicle;
  const Terrain& terrain;
  const Phenomenon& fire;
};

/// One sensor of one vehicle, with its errors, rate and random stream.
class Sensor {
 public:
  virtual ~Sensor() = default;

  /// Appends what the sensor has to say at `view.now`; nothing between its samples.
  virtual void sample(const SensorView& view, std::vector<SensorSample>& out) = 0;
};

}  // namespace skein
