// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/target/orbit_entry.h"

#include <cmath>

#include "skein/model/connection/arrival.h"
#include "skein/model/path/flight_plan.h"

namespace skein::solve {
namespace {

FlightPlan connection(const model::Pose& from, const model::Pose& to,
                      const model::AirMotion& air, double start, double down) {
  return model::to_flight_plan(model::connect(from, to, air), from, air, start, down);
}

}  // namespace

FlightPlan meeting(const MovingPose& pose, const model::Pose& from,
                   const model::AirMotion& air, double start, double earliest,
                   double latest, double down) {
  for (double time = earliest; time <= latest; time += 1) {
    model::Arrival arrival = model::connect_at(from, pose(time), air, time - start);
    if (arrival.status != model::ArrivalStatus::kFound) continue;
    FlightPlan plan = model::starting_at(std::move(arrival.plan), start);
    for (FlightElement& e : plan) e.p_N.z() = down;
    return plan;
  }
  return {};
}

FlightPlan connection_to(const MovingPose& pose, const MovingTarget& target,
                         const model::Pose& from, const model::AirMotion& air,
                         double start, double down) {
  const Vec2 velocity = velocity_at(target, start);
  model::AirMotion felt = air;
  felt.wind -= velocity;
  // In the target's frame, with the places of the start.
  const model::Connection exact = model::connect(from, pose(start), felt);
  if (exact.status == model::ConnectionStatus::kFound &&
      start + exact.time <= next_change(target, start)) {
    FlightPlan plan = model::to_flight_plan(exact, from, felt, start, down);
    for (FlightElement& e : plan) {
      const Vec2 moved = (e.start - start) * velocity;
      e.p_N += Vec3(moved.x(), moved.y(), 0);
      e.wind = air.wind;
    }
    return plan;
  }
  double time = start;
  for (int i = 0; i < 60; ++i) {
    const model::Connection c = model::connect(from, pose(time), air);
    if (c.status != model::ConnectionStatus::kFound) return {};
    const bool settled = std::abs(start + c.time - time) < 1e-10;
    time = start + c.time;
    if (settled) return connection(from, pose(time), air, start, down);
  }
  return {};
}

}  // namespace skein::solve
