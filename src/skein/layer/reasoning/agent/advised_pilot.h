// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "skein/base/random.h"
#include "skein/data/vehicle/agent_step.h"
#include "skein/layer/reasoning/trajectory/flight_intent.h"

namespace skein::reasoning {

/// How a pilot on board follows what is recommended.
struct AdvisedPilotOptions {
  double reaction_min = 2, reaction_max = 20;  ///< until what is shown is flown [s]
  double obeys = 1;        ///< chance that a recommendation is flown at all
  std::uint64_t seed = 0;  ///< of the run
};

/// A pilot on board who flies, and is shown another path where the own one leads into a
/// conflict: a simulated one.
///
/// The pilot flies what the task asks for. A flight that keeps apart from others is
/// shown as a recommendation with its reason; after a reaction time, drawn evenly from
/// its range, the pilot flies it, or flies on as before, drawn too. Until then the flight
/// of before goes on. Another recommendation, one that comes after more than 30 s, is
/// decided upon anew; sooner it is the same one with another path. What is not followed
/// makes the aircraft one that does not keep to its plan, for all others.
class AdvisedPilot {
 public:
  AdvisedPilot(EntityId self, const AdvisedPilotOptions& options)
      : self_(self),
        options_(options),
        random_(options.seed, self.value, Purpose::kPilot) {}

  /// What is flown now.
  ///
  /// @param task     what the task asks for.
  /// @param advised  what keeps apart from others; with an empty reason the task's
  ///                 flight, which is flown without a word.
  /// @param reason   why it is another; lives as long as the program.
  /// @returns  `task`, `advised` or what was flown before, good until the next call.
  const FlightIntent* fly(const FlightIntent* task, const FlightIntent* advised,
                          std::string_view reason, const AgentInput& in,
                          AgentOutput& out);

 private:
  void show(const FlightIntent& advised, std::string_view reason, const AgentInput& in,
            AgentOutput& out);
  const FlightIntent* flown(const FlightIntent* intent);  // remembers it
  void note(RecommendationState state, AgentOutput& out) const;
  bool is_same(Time now) const;
  bool is_shown(const FlightIntent& advised, std::string_view reason) const {
    return shown_ && advised.number == shown_number_ && reason == reason_;
  }

  EntityId self_;
  AdvisedPilotOptions options_;
  RandomStream random_;
  bool shown_ = false, obeys_ = false, follows_ = false;
  std::uint32_t shown_number_ = 0, count_ = 0;
  std::string_view reason_;
  Time acts_, shown_at_;
  std::optional<FlightIntent> flown_;  // of before the recommendation
};

}  // namespace skein::reasoning
