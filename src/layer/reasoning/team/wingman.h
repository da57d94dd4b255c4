#pragma once

#include <optional>

#include "layer/reasoning/agent/execution_monitor.h"
#include "role/agent.h"
#include "role/terrain.h"

namespace skein::reasoning {

struct WingmanOptions {
  double altitude_agl = 120;  ///< flown above the highest ground of the route [m]
  double report_period = 1;   ///< between reports to the station [s]
  double horizon = 8;         ///< the leader's motion is foretold for this long [s]
  SafetyZone safety_zone;
};

/// The place of a follower `at` seconds after its leader was at `leader`: the leader goes
/// on at its speed and turns on evenly, the offset turns with its course.
///
///   course' = turn_rate,   p' = v,   slot = p + R(course) offset
///
/// @param turn_rate  of the leader's course [rad/s].
/// @param offset     ahead of the leader and to its right [m].
/// @returns          position and velocity of the slot; altitude and climb the leader's.
PlanPoint slot_at(const NavEstimate& leader, double turn_rate, const Vec2& offset,
                  double at);

/// The part of the leader's turn rate with which a follower's slot can be flown.
///
/// A slot at distance d outside of a turn moves faster by turn_rate d, inside slower, and
/// what remains after the follower's speeds and its bank limit, in the wind from its
/// worst side, bounds the rate. A follower that cannot keep up so cuts or widens the
/// turn, and comes back to its slot after it.
double bearable_turn_rate(const NavEstimate& leader, double turn_rate, const Vec2& offset,
                          const FlightLimits& limits, double wind_speed);

/// The agent of an aircraft that flies in formation: it leads along a route, or keeps its
/// slot beside another aircraft, whichever task it heard of last. So roles can be swapped
/// in flight. It reports to the station once a second, and as leader to whom it is told.
class Wingman final : public Agent {
 public:
  /// @param map  what it believes the ground to be; outlives the agent.
  Wingman(const WingmanOptions& options, EntityId self, EntityId station,
          const FlightLimits& limits, const Terrain& map);

  void step(const AgentInput& in, AgentOutput& out) override;

 private:
  void listen(const AgentInput& in, AgentOutput& out);
  void lead(const FlyRoute& route, AgentOutput& out) const;
  void follow(const FollowLeader& order, const AgentInput& in, AgentOutput& out);
  void report(const AgentInput& in, AgentOutput& out);

  WingmanOptions options_;
  EntityId self_, station_;
  FlightLimits limits_;
  const Terrain& map_;
  ExecutionMonitor execution_;

  Task task_;
  bool has_task_ = false, task_is_new_ = false, done_ = false;
  std::optional<NavEstimate> leader_;  // last heard of the leader
  double leader_turn_rate_ = 0;        // [rad/s]
  bool leader_is_new_ = false;
  Time next_report_;
};

}  // namespace skein::reasoning
