// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "skein/base/id.h"
#include "skein/data/describe/describe.h"
#include "skein/geo/polygon.h"

namespace skein {

// What missions are to reach, as far as it can be measured from outside: records carry
// it, so that a mission is judged by the truth and not by what it says of itself.

/// Nothing that is measured.
struct OpenGoal {};

constexpr auto describe(const OpenGoal*) {
  return described<OpenGoal>({"open"}, "Nothing that is measured.");
}

/// A boundary is known.
struct PerimeterGoal {
  std::uint32_t phenomenon = 0;  ///< its place in the environment's list
};

constexpr auto describe(const PerimeterGoal*) {
  using T = PerimeterGoal;
  return described<T>({"perimeter"}, "A boundary is known.",
                      field("phenomenon", &T::phenomenon, "whose boundary"));
}

/// All of an area is seen.
struct SurveyGoal {
  geo::Ring area;                ///< [m]
  std::vector<geo::Ring> holes;  ///< that need not be seen [m]
  double swath = 0;              ///< that is seen, half on either side of a path [m]
  double planned_at = 0;         ///< when its first plan was made [s]
  double planned_for = 0;        ///< how long that takes [s]; 0: there is none yet
};

constexpr auto describe(const SurveyGoal*) {
  using T = SurveyGoal;
  return described<T>(
      {"survey"}, "All of an area is seen.",
      field("area", &T::area, axes::kPlace, "its corners"),
      field("holes", &T::holes, axes::kPlace, "that need not be seen"),
      field("swath", &T::swath, unit::kMetre, "width that is seen along a path"),
      field("planned_at", &T::planned_at, unit::kSecond, "when its first plan was made"),
      field("planned_for", &T::planned_for, unit::kSecond,
            "how long that takes; 0: there is none yet"));
}

/// Objects are kept in view.
struct TrackGoal {
  std::vector<std::uint32_t> objects;  ///< which; empty: every one that anybody finds
};

constexpr auto describe(const TrackGoal*) {
  using T = TrackGoal;
  return described<T>({"track"}, "Objects are kept in view.",
                      field("objects", &T::objects, "which; none: all that are found"));
}

/// A line is visited again and again.
struct PatrolGoal {
  std::vector<Vec2> line;  ///< [m]
  bool closed = false;     ///< the last point is joined to the first
  double reach = 0;        ///< a point is visited from so near [m]
};

constexpr auto describe(const PatrolGoal*) {
  using T = PatrolGoal;
  return described<T>({"patrol"}, "A line is visited again and again.",
                      field("line", &T::line, axes::kPlace, "its points"),
                      field("closed", &T::closed, "the last is joined to the first"),
                      field("reach", &T::reach, unit::kMetre, "visited from so near"));
}

/// Followers keep their places beside a leader.
struct FormationGoal {
  EntityId leader;
  std::vector<EntityId> followers;
  std::vector<Vec2> slots;  ///< of the followers: ahead of the leader, to its right [m]
};

constexpr auto describe(const FormationGoal*) {
  using T = FormationGoal;
  return described<T>({"formation"}, "Followers keep their places beside a leader.",
                      field("leader", &T::leader, "who leads"),
                      field("followers", &T::followers, "who follow"),
                      field("slots", &T::slots, axes::kFormation,
                            "their places: ahead of the leader, to its right"));
}

using MissionGoal = std::variant<OpenGoal, PerimeterGoal, SurveyGoal, TrackGoal,
                                 PatrolGoal, FormationGoal>;

enum class MissionState : std::uint8_t { kBegun, kPaused, kResumed, kOver, kChanged };

constexpr auto names_of(const MissionState*) {
  return std::to_array<std::string_view>(
      {"begun", "paused", "resumed", "over", "changed"});
}

/// A mission begins, is paused, goes on, is over, or has another goal from now on.
struct MissionChange {
  std::string mission;  ///< its name
  MissionState state = MissionState::kBegun;
  MissionGoal goal;
};

constexpr auto describe(const MissionChange*) {
  using T = MissionChange;
  return described<T>(
      {"mission_change"},
      "A mission begins, is paused, goes on, is over, or has another goal.",
      field("mission", &T::mission, "its name"),
      field("state", &T::state, "what it does"),
      field("goal", &T::goal, Storage::kJson, "what it is to reach"));
}

}  // namespace skein
