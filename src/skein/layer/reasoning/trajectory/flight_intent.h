// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "skein/data/vehicle/autopilot.h"
#include "skein/data/vehicle/flight_plan.h"

// What the links of the planner chain hand on: what shall be flown, before anybody has
// looked at zones, ground and limits.

namespace skein::reasoning {

/// Guidance for now, said anew at each step.
struct Steering {
  decltype(AutopilotCommand::guidance) guidance = HoldCourse{};
  double course = 0;  ///< over ground just ahead [rad]
  std::optional<double>
      altitude_msl{};                ///< [m]; none: the aircraft's height above ground
  std::optional<double> airspeed{};  ///< [m/s]; none: cruise
};

/// Circles around a point as small as they can be flown in the wind, or hovering there;
/// around the nearest place where that is possible while a no-fly zone forbids it.
struct Circling {
  Vec2 centre = Vec2::Zero();  ///< [m]
  std::optional<double>
      altitude_msl{};    ///< [m]; none: the aircraft's height above ground
  bool near_by = false;  ///< whatever circle is flown already near that point will do
};

/// Straight legs between points, lap after lap, then to stay at the last of them.
struct Legs {
  std::vector<Vec2> points;          ///< at least one [m]
  int laps = 1;                      ///< times around
  double altitude_msl = 0;           ///< [m]
  std::optional<double> airspeed{};  ///< [m/s]; none: cruise
  double ground_clearance = 0;  ///< kept above the ground on detours around zones [m]
};

/// A flight planned in the wind, and where it may be led around something.
struct Itinerary {
  FlightPlan plan;
  /// Times of the plan, growing, at which the aircraft must be where the plan has it, its
  /// end last: a detour may lead from one to another, not past one.
  std::vector<double> milestones;
  bool in_time = true;       ///< flown in time; else at cruise airspeed
  bool rejoins = true;       ///< when it is off the plan, it joins it again by itself
  bool over_ground = false;  ///< altitudes are not the plan's, but so high above ground
  /// It circles where that ends until something else is flown; else what follows is not
  /// known yet, or the aircraft leaves.
  bool stays = false;
};

/// Down to the ground at a place.
struct Landing {
  Vec2 place = Vec2::Zero();       ///< [m]
  double altitude_msl = 0;         ///< until the approach [m]
  std::optional<double> course{};  ///< of the approach [rad]; none: against the wind
  double approach = 0;  ///< about how long that is, over ground [m]; 0: not known
};

/// Home, by the route that has been planned for returns, and to stay above.
struct Returning {
  double altitude_msl = 0;  ///< [m]
};

/// What shall be flown.
struct FlightIntent {
  /// Another number, another flight: those with the same are gone on with. Steering and
  /// circling need none.
  std::uint32_t number = 0;
  std::variant<Steering, Circling, Legs, Itinerary, Landing, Returning> what = Steering{};
};

/// How the flight of an intent goes.
struct FlightProgress {
  std::uint32_t number = 0;  ///< of the intent
  bool done = false;         ///< its end has been reached: it stays there, or stands
  bool refused = false;      ///< the autopilot does not fly it
  bool by_sight = false;     ///< it is led around zones without a plan
  bool mended = false;       ///< an itinerary is flown by other times than its own
  std::size_t passed = 0;    ///< milestones of an itinerary, points of legs
  double time_to_go = 0;     ///< to the end of an itinerary [s]
  std::string ending = {};   ///< how legs ended, for people
};

}  // namespace skein::reasoning
