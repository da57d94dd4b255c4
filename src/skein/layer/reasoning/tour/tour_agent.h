#pragma once

#include <optional>
#include <vector>

#include "skein/layer/reasoning/agent/execution_monitor.h"
#include "skein/layer/reasoning/agent/launch.h"
#include "skein/layer/reasoning/agent/position_report.h"
#include "skein/layer/reasoning/tour/tour_plan.h"
#include "skein/role/agent.h"
#include "skein/role/terrain.h"

namespace skein::reasoning {

struct TourAgentOptions {
  std::vector<Vec2> points = {{0, 0}, {400, 0}, {200, 350}};  ///< [m]
  int laps = 3;                                               ///< times around
  TourCurves curves = TourCurves::kTrochoids;
  double radius_factor = 1.2;  ///< planned turns, over the minimum radius of the aircraft
  double settling = 30;        ///< circling before planning, to learn of the wind [s]
  bool keeps_times = true;     ///< flies the plan in time; else at cruise airspeed
  bool replans = true;         ///< when the execution leaves the safety zone
  double altitude_agl = 120;   ///< above the highest ground of the points [m]
  double report_period = 1;    ///< between reports to the station [s]
  SafetyZone safety_zone;
};

/// Flies through points on turns and straights that it plans for the wind, each lap anew
/// with the wind as its autopilot then believes it to be; then stays at the end. It takes
/// no orders, and reports to the station where it is. On the ground it takes off first.
///
/// When the wind is as strong as its airspeed there is no plan: it goes on circling,
/// reports so, and tries again; so it does when its autopilot refuses a plan.
class TourAgent final : public Agent {
 public:
  /// @param map  what it believes the ground to be; used now only.
  TourAgent(const TourAgentOptions& options, EntityId self, EntityId station,
            const FlightLimits& limits, const Terrain& map);

  void step(const AgentInput& in, AgentOutput& out) override;

 private:
  void fly(const AgentInput& in, AgentOutput& out);
  void plan_on(const AgentInput& in, const FlightState& from, double start,
               AgentOutput& out);
  void forget_plan(double now);
  std::size_t visits() const;

  TourAgentOptions options_;
  EntityId self_;
  FlightLimits limits_;
  double altitude_msl_;
  std::vector<double> courses_;
  ExecutionMonitor execution_;
  Launch launch_;
  std::optional<Time> begin_;   // of planning
  FlightPlan plan_;             // what is being flown
  std::vector<double> passes_;  // of all points so far, as planned [s]
  bool done_ = false, stuck_ = false;
  PositionReport report_;
};

}  // namespace skein::reasoning
