// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "skein/mixed/recorded_port.h"
#include "skein/role/flight_model.h"

namespace skein::mixed {

/// A flight model that says again what was recorded, for a run that is done again; what
/// it is sent goes nowhere.
class RecordedFlightModel final : public FlightModel {
 public:
  /// @param reports  by rising time.
  explicit RecordedFlightModel(std::vector<TimedReport> reports)
      : reports_(std::move(reports)) {}

  void receive(Time now, std::vector<VehicleReport>& out) override {
    for (; next_ < reports_.size() && reports_[next_].time <= now; ++next_)
      out.push_back(reports_[next_].report);
  }
  void send(const Actuators&, const Vec3&) override {}

 private:
  std::vector<TimedReport> reports_;
  std::size_t next_ = 0;
};

}  // namespace skein::mixed
