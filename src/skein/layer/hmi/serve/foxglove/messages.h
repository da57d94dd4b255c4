// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "skein/data/event/live.h"
#include "skein/geo/local_frame.h"

namespace skein::hmi::foxglove {

/// What does not change during a run.
struct Facts {
  std::string name;                      ///< of the run
  std::string session;                   ///< another one for each start of the server
  std::int64_t start_s = 0;              ///< of the run, since 1970 [s]
  std::optional<geo::LocalFrame> frame;  ///< none: nothing is said in degrees
};

/// Puts what a run says into messages that Foxglove's viewers know, JSON text each. The
/// frame "world" has x east, y north and z up, 0 at mean sea level of the run's origin.
class Messages {
 public:
  explicit Messages(Facts facts) : facts_(std::move(facts)) {}

  const Facts& facts() const { return facts_; }
  std::uint64_t since_1970_ns(Time time) const;

  using Names = std::map<EntityId, std::string>;
  using Paths = std::map<EntityId, FlightPathRecord>;
  using Boundaries = std::map<std::string, PerimeterRecord>;  // by mission
  using Zones = std::map<std::string, Zone>;                  // by name

  /// foxglove.FrameTransforms: a frame for each aircraft, x forward, y left, z up.
  std::string transforms(const FleetFrame& fleet, const Names& names) const;
  /// foxglove.SceneUpdate: an arrow and a name for each aircraft.
  std::string aircraft(const FleetFrame& fleet, const Names& names) const;
  /// foxglove.LocationFix
  std::string location(const VehicleView& view, Time time) const;
  /// skein.Aircraft
  std::string state(const VehicleView& view, Time time) const;
  /// foxglove.GeoJSON: believed boundaries, their points with their deviation, and true
  /// ones where they are known.
  std::string boundaries_on_map(const Boundaries& all) const;
  /// foxglove.SceneUpdate of the same.
  std::string boundaries(const Boundaries& all, Time time) const;
  std::string zones_on_map(const Zones& all) const;
  std::string zones(const Zones& all, Time time) const;
  /// foxglove.SceneUpdate: how aircraft expect to fly.
  std::string paths(const Paths& all, Time time) const;
  /// skein.Metrics
  std::string metrics(const MetricSample& sample) const;
  /// skein.RunClock
  std::string clock(const RunClock& clock) const;
  /// foxglove.Log
  std::string log(const Event& event, const std::string& whose) const;

 private:
  Facts facts_;
};

}  // namespace skein::hmi::foxglove
