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
  explicit RecordedPort(std::vector<TimedReport> reports)
      : reports_(std::move(reports)) {}

  void receive(Time now, std::vector<VehicleReport>& out) override {
    for (; next_ < reports_.size() && reports_[next_].time <= now; ++next_)
      if (of_vehicle(reports_[next_].report)) out.push_back(reports_[next_].report);
  }
  void send(std::uint32_t, const VehicleRequest&) override {}

 private:
  // The others are said by a DrivenPlant.
  static bool of_vehicle(const VehicleReport& report) {
    return !std::holds_alternative<ActuatorOutputs>(report) &&
           !std::holds_alternative<OutsideEvent>(report);
  }

  std::vector<TimedReport> reports_;
  std::size_t next_ = 0;
};

}  // namespace skein::mixed
