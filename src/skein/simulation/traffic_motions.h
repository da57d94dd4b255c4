// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "skein/data/traffic/traffic.h"
#include "skein/role/recorder.h"
#include "skein/role/traffic_aircraft.h"
#include "skein/simulation/world.h"

namespace skein::simulation {

/// Other air traffic of a run: flies it on, shows it to sensors together with the
/// aircraft that take part, and records how it flies.
class TrafficMotions {
 public:
  /// @param traffic  of the world; kept as a reference.
  explicit TrafficMotions(std::vector<WorldTraffic>& traffic);

  /// Flies on to `now`.
  /// @param visible   the aircraft that take part, as sensors may find them.
  void advance(Time now, std::span<const VisibleAircraft> visible);

  /// Records those that do not fly on as was recorded of them last.
  void record(Time now, Recorder& recorder);

  /// What sensors may find, as of the last advance().
  std::span<const VisibleAircraft> visible() const { return visible_; }

 private:
  TrafficState state_at(Time now, std::size_t k) const;

  std::vector<WorldTraffic>& traffic_;
  std::vector<TrafficState> states_;
  std::vector<NoticedAircraft> noticed_;
  std::vector<VisibleAircraft> visible_;
  std::vector<std::optional<TrafficMotion>> recorded_;
};

}  // namespace skein::simulation
