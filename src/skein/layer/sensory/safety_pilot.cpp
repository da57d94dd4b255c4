// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/sensory/safety_pilot.h"

#include <algorithm>

namespace skein::sensory {

SafetyPilot::SafetyPilot(const SafetyPilotOptions& options)
    : clock_(options.rate_hz), takeovers_(options.takeovers) {
  for (const Takeover& t : takeovers_)
    SKEIN_CHECK(t.mode == FlightMode::kManual || t.mode == FlightMode::kStabilized,
                static_cast<int>(t.mode));
}

void SafetyPilot::sample(const SensorView& view, std::vector<SensorSample>& out) {
  if (!clock_.due(view.now)) return;
  const double now = view.now.seconds();
  const auto held =
      std::find_if(takeovers_.begin(), takeovers_.end(),
                   [now](const Takeover& t) { return t.from <= now && now < t.until; });
  PilotInput input;
  input.time = view.now;
  if (held != takeovers_.end()) {
    input.takes_over = true;
    input.mode = held->mode;
    input.roll = held->roll;
    input.pitch = held->pitch;
    input.yaw = held->yaw;
    input.throttle = held->throttle;
  }
  out.emplace_back(input);
}

}  // namespace skein::sensory
