// SPDX-License-Identifier: Apache-2.0
// Autopilots: one row each.

#include <fmt/format.h>

#include "skein/assemble/kinds/kinds_of.h"
#include "skein/assemble/kinds/skein_autopilot_kind.h"
#include "skein/layer/autopilot/simple_autopilot.h"

namespace skein::assemble {
namespace {

using scenario::Fields;

Fields<autopilot::SimpleAutopilotOptions> autopilot_fields() {
  using T = autopilot::SimpleAutopilotOptions;
  return Fields<T>()
      .number("heading_gain_hz", [](T & t) -> auto& { return t.guidance.heading_gain; },
              "Turn rate per heading error.", {.above = 0, .at_most = 20})
      .duration_s("look_ahead_s", [](T & t) -> auto& { return t.guidance.look_ahead; },
                  "Flight time in which a cross-track error is taken out.", {.above = 0})
      .duration_s(
          "anticipation_s", [](T & t) -> auto& { return t.guidance.anticipation; },
          "Turns of a path are begun this much early.")
      .number("altitude_gain_hz", &T::altitude_gain, "Climb rate per altitude error.",
              {.above = 0, .at_most = 20})
      .duration_s("wind_lag_s", &T::wind_lag, "Time constant of the reported wind.",
                  {.above = 0});
}

}  // namespace

Kinds<Autopilot, AircraftContext> autopilot_kinds() {
  Kinds<Autopilot, AircraftContext> kinds("autopilot");
  kinds.add("path", "Follows paths, courses and circles over ground in wind.",
            autopilot_fields(),
            [](const autopilot::SimpleAutopilotOptions& o,
               const AircraftContext& c) -> Result<std::unique_ptr<Autopilot>> {
              if (!std::holds_alternative<SelfStabilised>(c.airframe))
                return Error{
                    ErrorCode::kBadInput, "",
                    "the autopilot path says roll angle, airspeed and climb rate; "
                    "this plant takes actuators.",
                    "Choose the autopilot skein."};
              return std::unique_ptr<Autopilot>(
                  std::make_unique<autopilot::SimpleAutopilot>(o, c.limits, c.initial));
            });
  kinds.add("skein",
            "Estimator, modes, failsafes, guidance and control for every airframe; flies "
            "by its sensors only.",
            skein_fields(), [](const SkeinChoice& o, const AircraftContext& c) {
              return make_skein(o, c);
            });
  return kinds;
}

}  // namespace skein::assemble
