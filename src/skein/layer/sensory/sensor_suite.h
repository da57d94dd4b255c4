// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "skein/role/sensor.h"

namespace skein::sensory {

/// Several sensors under one name.
class SensorSuite final : public Sensor {
 public:
  struct Part {
    std::string kind;  ///< as scenarios name it
    std::unique_ptr<Sensor> sensor;
  };

  explicit SensorSuite(std::vector<Part> parts) : parts_(std::move(parts)) {}

  void sample(const SensorView& view, std::vector<SensorSample>& out) override {
    for (const Part& part : parts_) part.sensor->sample(view, out);
  }

  /// The parts, for who mounts them one by one; afterwards this one is empty.
  std::vector<Part> take() { return std::exchange(parts_, {}); }

 private:
  std::vector<Part> parts_;
};

}  // namespace skein::sensory
