// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/layer/sensory/periodic_sensor.h"

namespace skein::sensory {

struct IdealNavigationOptions {
  double rate_hz = 100;  ///< samples per second; at most one per step of the vehicle
};

/// Everything about the own motion and the wind, without errors and at once: for control
/// without an estimator.
class IdealNavigation final : public PeriodicSensor<IdealNavigation, TruthSample> {
 public:
  explicit IdealNavigation(const IdealNavigationOptions& options)
      : PeriodicSensor(options.rate_hz, 0) {}

  bool measure(const SensorView& view, TruthSample& sample) {
    sample.p_N = view.vehicle.p_N;
    sample.v_N = view.vehicle.v_N;
    sample.q_NB = view.vehicle.q_NB;
    sample.w_NB_B = view.vehicle.w_NB_B;
    sample.wind_N = view.air.wind_N;
    return true;
  }
};

}  // namespace skein::sensory
