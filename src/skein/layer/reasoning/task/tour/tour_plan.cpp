// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/task/tour/tour_plan.h"

#include "skein/model/path/flight_plan.h"

namespace skein::reasoning {

std::vector<double> corner_courses(std::span<const Vec2> points) {
  std::vector<double> courses;
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 in = (points[i] - points[(i + n - 1) % n]).normalized();
    const Vec2 out = (points[(i + 1) % n] - points[i]).normalized();
    const Vec2 both = in + out;
    courses.push_back(geo::bearing(both.norm() > 1e-6 ? both : in));
  }
  return courses;
}

TourPlan plan_tour(const FlightState& from, double start, std::span<const Vec2> points,
                   std::span<const double> courses, const model::AirMotion& air,
                   TourCurves curves) {
  model::AirMotion planned = air;
  if (curves == TourCurves::kDubins) planned.wind = Vec2::Zero();
  TourPlan tour;
  model::Pose at{geo::horizontal(from.p_N), from.heading};
  double time = start;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto to = model::heading_pose({points[i], courses[i]}, planned);
    if (!to) return {};
    const model::Connection leg = model::connect(at, *to, planned);
    if (leg.status != model::ConnectionStatus::kFound) return {};
    const FlightPlan elements =
        model::to_flight_plan(leg, at, planned, time, from.p_N.z());
    tour.plan.insert(tour.plan.end(), elements.begin(), elements.end());
    time += leg.time;
    tour.passes.push_back(time);
    at = *to;
  }
  return tour;
}

}  // namespace skein::reasoning
