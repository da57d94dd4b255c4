// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "skein/layer/reasoning/trajectory/flight_context.h"
#include "skein/layer/reasoning/trajectory/flight_intent.h"
#include "skein/layer/reasoning/trajectory/trajectory_step.h"

namespace skein::reasoning {

/// Flies points lap after lap, then stays at the last of them; around no-fly zones.
///
/// While no zone that counts lies on it, the route is one command to the autopilot. What
/// remains of it is looked at when zones begin or cease to count:
///
/// - a leg that is free is flown as it is;
/// - a leg that a zone blocks is planned anew from where the aircraft is, and flown as a
///   plan; planned again when the flight of it is off plan;
/// - without planner, when it finds no path, or when the autopilot refuses the plan, the
///   aircraft flies the short detour around the zones by the zone avoidance, and asks
///   again ten seconds later;
/// - a point within a zone is left out, with the event "point-left-out"; instead of the
///   last one it flies to the nearest place where it can circle;
/// - an aircraft within a zone leaves it first;
/// - the place to stay at in the end, if a zone comes to lie there, becomes the nearest
///   one where it can circle.
class RouteFlight {
 public:
  RouteFlight(const Legs& legs, const FlightContext& context);

  /// To be called at each step in which the route may be flown. May command.
  void step(const TrajectoryStep& step, AgentOutput& out);

  /// The last point has been passed, or left out.
  bool done() const { return stage_ == Stage::kDone; }

  void report(FlightProgress& progress) const;

  /// What it does with its route, for the records; empty: it flies it as it was given.
  std::string_view change() const;

 private:
  enum class Stage { kNew, kRoute, kPlanned, kGuarded, kDone };

  const Vec2& point(std::int64_t index) const;
  void keep_count(const AgentInput& in, ZoneMonitor& zones);
  bool passed(const Vec2& position) const;
  bool must_choose(const AgentInput& in, const ZoneMonitor& zones, bool off_plan) const;
  void choose(const AgentInput& in, ZoneMonitor& zones, AgentOutput& out);
  void leave_out(const AgentInput& in, const ZoneMonitor& zones, AgentOutput& out);
  void report_left_out(Time now, AgentOutput& out) const;
  void fly_route(const Vec2& here, std::int64_t free, AgentOutput& out);
  bool fly_planned(const AgentInput& in, const ZoneMonitor& zones, AgentOutput& out);
  void fly_guarded(const AgentInput& in, ZoneMonitor& zones, AgentOutput& out);
  void stay(const AgentInput& in, ZoneMonitor& zones, AgentOutput& out);
  std::string ending() const;
  void give(decltype(AutopilotCommand::guidance) guidance, AgentOutput& out);

  Legs legs_;
  FlightContext context_;
  FlyWaypoints route_;
  std::int64_t total_;      // points of all laps
  std::int64_t next_ = 0;   // that is flown to
  std::int64_t until_ = 0;  // of the command in force: the first that it does not hold
  // Of the command in force, if it is waypoints: these, and the index of the first.
  std::vector<FlyWaypoints::Waypoint> given_;
  std::int64_t begins_ = 0;
  Stage stage_ = Stage::kNew;
  Vec2 from_ = Vec2::Zero();  // where the leg to the next point begins
  Time plan_again_, aim_again_;
  Vec2 aim_ = Vec2::Zero();  // of a flight by the zone avoidance
  bool by_sight_ = false;    // the command in force is of one: it does not end
  std::int64_t reported_ =
      -1;                      // the point whose trouble has been reported since a change
  double missed_by_ = 0;       // the last point, where it was left out [m]
  std::optional<Vec2> stays_;  // none: where the route's command leads
};

}  // namespace skein::reasoning
