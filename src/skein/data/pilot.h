#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "skein/base/time.h"
#include "skein/data/describe.h"

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

}  // namespace skein
