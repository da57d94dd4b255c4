// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/layer/sensory/delay.h"
#include "skein/layer/sensory/sample_clock.h"
#include "skein/role/sensor.h"

namespace skein::sensory {

/// A sensor that measures at an even rate and reports what it measured after a latency.
/// `Derived` has
///
///   bool measure(const SensorView& view, Sample& sample);
///
/// which fills in all but the time, or returns false when there is nothing to say.
template <class Derived, class Sample>
class PeriodicSensor : public Sensor {
 public:
  void sample(const SensorView& view, std::vector<SensorSample>& out) final {
    if (clock_.due(view.now)) {
      Sample sample;
      sample.time = view.now;
      if (static_cast<Derived*>(this)->measure(view, sample)) delay_.put(sample, out);
    }
    delay_.release(view.now, out);
  }

 protected:
  /// @param rate_hz  samples per second, above 0.
  /// @param latency  [s], not negative.
  PeriodicSensor(double rate_hz, double latency)
      : clock_(rate_hz), delay_(latency, clock_.period()) {}

  double period() const { return clock_.period(); }  ///< [s]

 private:
  SampleClock clock_;
  Delay<Sample> delay_;
};

}  // namespace skein::sensory
