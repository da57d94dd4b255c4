#pragma once

#include <memory>

#include "base/id.h"
#include "base/random.h"
#include "layer/sensory/outages.h"
#include "role/sensor.h"

namespace skein::sensory {

/// A sensor that says nothing at times, known beforehand or random. It measures on
/// unheard, so that its errors are the same as without failures.
class FailingSensor final : public Sensor {
 public:
  /// @param instance  number of the sensor among all of this entity, from 0.
  FailingSensor(std::unique_ptr<Sensor> sensor, const OutageOptions& options,
                std::uint64_t seed, EntityId entity, std::uint32_t instance = 0)
      : sensor_(std::move(sensor)),
        outages_(options,
                 RandomStream(seed, entity.value, Purpose::kSensorOutage, instance)) {}

  void sample(const SensorView& view, std::vector<SensorSample>& out) override {
    const std::size_t before = out.size();
    sensor_->sample(view, out);
    if (outages_.until(view.now)) out.resize(before);
  }
  bool payload() const override { return sensor_->payload(); }

 private:
  std::unique_ptr<Sensor> sensor_;
  Outages outages_;
};

}  // namespace skein::sensory
