// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>

#include "skein/assemble/kinds/code_consent.h"
#include "skein/assemble/kinds/kinds_of.h"
#include "skein/assemble/kinds/planner_kinds.h"
#include "skein/assemble/kinds/task_kinds.h"
#include "skein/assemble/radio/radio_parts.h"
#include "skein/base/result.h"
#include "skein/scenario/kind_table.h"

namespace skein::assemble {

/// Implementations by role, one row each. A plugin adds its own to an empty one:
///
///   kinds.sensor.add("smoke", "Help.", fields_of_its_options,
///                    [](const SmokeOptions& o, const AircraftContext& c) {
///                      return std::make_unique<SmokeSensor>(o, c.seed, c.self);
///                    });
///
/// Those of RadioParts are named by radio files. Kinds of tasks are rows of values, which
/// commands and missions write: `kinds.task.add<Spiral>(maker)` (task_row.h).
struct KindsByRole : RadioParts {
  Kinds<Terrain, EnvironmentContext> terrain{"terrain"};
  Kinds<WindField, EnvironmentContext> wind{"wind"};
  Kinds<Turbulence, AircraftContext> turbulence{"turbulence"};
  Kinds<Phenomenon, EnvironmentContext> phenomenon{"phenomenon"};
  Kinds<MovingObject, ObjectContext> movement{"movement"};
  Kinds<TrafficAircraft, TrafficContext> traffic{"traffic"};
  Kinds<Vehicle, VehicleContext> vehicle{"vehicle"};
  Kinds<Plant, AircraftContext> plant{"plant"};
  Kinds<Autopilot, AircraftContext> autopilot{"autopilot"};
  Kinds<Sensor, AircraftContext> sensor{"sensor"};
  Kinds<Agent, AircraftContext> agent{"agent"};
  TaskKinds task;
  Kinds<reasoning::PlannedMission, MissionContext> mission{"mission"};
  Kinds<Routing, RoutingContext> routing{"routing"};
  Kinds<Radio, RadioContext> radio{"radio"};
  Kinds<PerimeterEstimator, EstimatorContext> estimator{"estimator"};
  Kinds<MonitoringStrategy, StrategyContext> strategy{"strategy"};
  Kinds<PathPlanner, PlannerContext> planner{"planner"};

  /// What scenarios are read with: every kind's name, help and keys.
  /// Fails: Bug when two kinds of a role have one name, or a default breaks its own
  ///        range.
  scenario::KindTable described() const;
};

/// The table of kinds: every implementation that a scenario can name, Skein's own and
/// those of plugins. Filled once, before a scenario is read; read only from then on, by
/// any thread.
class KindRegistry {
 public:
  /// Skein's own kinds.
  KindRegistry();

  /// Adds the kinds of a plugin.
  /// @param plugin  its name, for messages and listings.
  /// Fails: kBadInput for a name that is taken or is not lower case letters, digits and
  ///        hyphens, and for a default that its own key does not allow. Nothing is added
  ///        then.
  Result<void> add(const KindsByRole& more, const std::string& plugin);

  const KindsByRole& kinds() const { return kinds_; }

  /// What scenarios are read with. The same object for the life of the registry.
  const scenario::KindTable& table() const { return table_; }

  /// Who is asked before code that a scenario names may run. Null, as it is at first: no
  /// such code runs.
  void ask(std::shared_ptr<CodeConsent> consent) { consent_ = std::move(consent); }
  const std::shared_ptr<CodeConsent>& consent() const { return consent_; }

  /// Whether a plugin of this name was added.
  bool has_plugin(std::string_view plugin) const;

  /// The plugin that a kind came with; empty for Skein's own.
  std::string_view plugin_of(std::string_view role, std::string_view kind) const;

 private:
  KindsByRole kinds_;
  scenario::KindTable table_;
  std::set<std::string, std::less<>> plugins_;
  std::map<std::string, std::string, std::less<>> plugin_of_;  // by "role kind"
  std::shared_ptr<CodeConsent> consent_;
};

}  // namespace skein::assemble
