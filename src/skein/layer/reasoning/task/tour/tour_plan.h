// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "skein/data/vehicle/flight_plan.h"
#include "skein/model/connection/connection.h"

namespace skein::reasoning {

/// The kind of curve that a tour is planned with.
enum class TourCurves {
  kTrochoids,  ///< connections in the wind: circles and straights of the air mass
  kDubins,     ///< circles and straights over ground, as if there were no wind
};

/// Courses over ground [rad] at which the points of a round trip are passed: across the
/// bisector of the corner, from the point before to the point behind. Of two points, or
/// where a corner turns back, the course of the path to it.
///
/// @param points  at least two, neighbours (last and first too) at different places.
std::vector<double> corner_courses(std::span<const Vec2> points);

/// A flight through points, and when it passes each.
struct TourPlan {
  FlightPlan plan;             ///< empty when the wind is too strong
  std::vector<double> passes;  ///< times, one for each point [s]
};

/// From a state through points, in order, each at its course.
///
/// @param from     where it begins, at `start`; heading of the air-relative velocity,
///                 which Dubins curves take as the course.
/// @param courses  of the points over ground [rad].
/// @param air      airspeed, turn radius, and the wind as it is known. Dubins curves do
///                 not use the wind: their elements have none.
/// @returns        level elements.
TourPlan plan_tour(const FlightState& from, double start, std::span<const Vec2> points,
                   std::span<const double> courses, const model::AirMotion& air,
                   TourCurves curves);

}  // namespace skein::reasoning
