// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <utility>
#include <variant>
#include <vector>

#include "skein/role/vehicle_port.h"

namespace skein::mixed {

/// A report and the step of the run at which it was taken in.
struct TimedReport {
  Time time;
  VehicleReport report;
};

/// A port that says again what was recorded, for a run that is done again; what is sent
/// goes nowhere.
class RecordedPort final : public VehiclePort {
 public:
  /// @param reports  by rising time.
  /// @param driven   its plant is here: a DrivenPlant says what is of its drive.
  RecordedPort(std::vector<TimedReport> reports, bool driven)
      : reports_(std::move(reports)), driven_(driven) {}

  void receive(Time now, std::vector<VehicleReport>& out) override {
    for (; next_ < reports_.size() && reports_[next_].time <= now; ++next_)
      if (of_vehicle(reports_[next_].report)) out.push_back(reports_[next_].report);
  }
  void send(std::uint32_t, const VehicleRequest&) override {}

 private:
  bool of_vehicle(const VehicleReport& report) const {
    return !driven_ || (!std::holds_alternative<ActuatorOutputs>(report) &&
                        !std::holds_alternative<OutsideEvent>(report));
  }

  std::vector<TimedReport> reports_;
  bool driven_;
  std::size_t next_ = 0;
};

}  // namespace skein::mixed
