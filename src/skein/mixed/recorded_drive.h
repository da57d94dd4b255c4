// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "skein/mixed/recorded_port.h"
#include "skein/role/autopilot_drive.h"

namespace skein::mixed {

/// Does again what an outside autopilot did, from what was recorded of it. Beyond that it
/// is silent.
class RecordedDrive final : public AutopilotDrive {
 public:
  /// @param reports  by rising time, of any kind.
  explicit RecordedDrive(std::vector<TimedReport> reports)
      : reports_(std::move(reports)) {}

  bool exchange(const SensedMotion& motion, std::span<float> channels) override;
  void take_events(Time now, std::vector<OutsideEvent>& out) override;

 private:
  // The outputs from `next_` on; null behind the last.
  const ActuatorOutputs* outputs();

  std::vector<TimedReport> reports_;
  std::size_t next_ = 0;        // report with outputs
  std::size_t row_ = 0;         // of these
  std::uint32_t held_ = 0;      // steps of that row that have been
  std::size_t next_event_ = 0;  // report to look at
};

}  // namespace skein::mixed
