// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "skein/data/vehicle/agent_step.h"
#include "skein/layer/reasoning/belief/traffic/traffic_tracker.h"
#include "skein/model/well_clear/band_advisor.h"

namespace skein::reasoning {

/// Alerts about the intruders that an aircraft tracks, and what it may fly while one
/// stands: once a second, whether or not it keeps out of their way by itself.
///
/// A level that changes is recorded (TrafficAlert). One that rises is an event too,
/// "traffic-alert", in words for whoever looks on, and the end of the last alert
/// "clear-of-traffic". Bands (FlightBands) are recorded as long as an alert stands.
/// Only firm tracks count. Without tracks it does nothing.
class TrafficAlerting {
 public:
  /// @param configuration  null: skein_suas.
  explicit TrafficAlerting(
      std::shared_ptr<const model::WellClearConfiguration> configuration)
      : configuration_(std::move(configuration)) {}

  /// What is flown when nobody is in the way; asked for while an alert stands.
  using Goal = std::function<model::FlightGoal()>;

  /// At each step; needs in.nav.
  /// @param flies   false: it stands on the ground or takes off, and all alerts are over.
  void step(EntityId self, const AgentInput& in, std::span<const TrafficTrack> tracks,
            bool flies, const Goal& goal, AgentOutput& out);

 private:
  struct Alerted {
    std::uint32_t track = 0;
    int level = 0;
  };

  void list(Time now, std::span<const TrafficTrack> tracks);
  void report(EntityId self, const AgentInput& in, const TrafficAlert& alert, int before,
              AgentOutput& out) const;
  void report_changes(EntityId self, const AgentInput& in,
                      const model::BandAdvisor::Advice& advice, AgentOutput& out);
  void end_lost(EntityId self, const AgentInput& in, AgentOutput& out);
  void report_bands(const AgentInput& in, const model::BandAdvisor::Advice& advice,
                    AgentOutput& out);

  std::shared_ptr<const model::WellClearConfiguration> configuration_;
  std::optional<model::BandAdvisor> advisor_;  // made with the first track
  std::vector<model::TrackedIntruder> intruders_;
  std::vector<Alerted> alerted_;  // whose level is above 0
  Time next_;
  bool banded_ = false;  // the last row of bands was of a level above 0
};

}  // namespace skein::reasoning
