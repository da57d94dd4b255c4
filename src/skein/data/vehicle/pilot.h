// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "skein/base/time.h"
#include "skein/data/describe/describe.h"

namespace skein {

/// Who flies, and how.
enum class FlightMode : std::uint8_t {
  kManual,      ///< sticks move the actuators (multirotor: turn rates and thrust)
  kStabilized,  ///< sticks say the attitude
  kAuto,        ///< the stored mission
  kGuided,      ///< what the agent says from moment to moment
};
constexpr auto names_of(const FlightMode*) {
  return std::to_array<std::string_view>({"manual", "stabilized", "auto", "guided"});
}

/// The safety pilot's transmitter, as its receiver on board gives it out.
struct PilotInput {
  Time time;
  /// The pilot flies, in `mode` (manual or stabilized); false hands back.
  bool takes_over = false;
  FlightMode mode = FlightMode::kStabilized;
  double roll = 0;      ///< sticks: right positive, -1 to 1
  double pitch = 0;     ///< nose up positive, -1 to 1
  double yaw = 0;       ///< right positive, -1 to 1
  double throttle = 0;  ///< 0 to 1
};

constexpr auto describe(const PilotInput*) {
  using T = PilotInput;
  return described<T>({"pilot_input"}, "What a safety pilot's transmitter says.",
                      field("time", &T::time, "when"),
                      field("takes_over", &T::takes_over, "the pilot flies"),
                      field("mode", &T::mode, "manual or stabilized"),
                      field("roll", &T::roll, "stick, right positive, -1 to 1"),
                      field("pitch", &T::pitch, "stick, nose up positive, -1 to 1"),
                      field("yaw", &T::yaw, "stick, right positive, -1 to 1"),
                      field("throttle", &T::throttle, "0 to 1"));
}

}  // namespace skein
