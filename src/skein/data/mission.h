#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "skein/data/describe.h"
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
};

constexpr auto describe(const SurveyGoal*) {
  using T = SurveyGoal;
  return described<T>(
      {"survey"}, "All of an area is seen.",
      field("area", &T::area, axes::kPlace, "its corners"),
      field("holes", &T::holes, axes::kPlace, "that need not be seen"),
      field("swath", &T::swath, unit::kMetre, "width that is seen along a path"));
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

using MissionGoal =
    std::variant<OpenGoal, PerimeterGoal, SurveyGoal, TrackGoal, PatrolGoal>;

enum class MissionState : std::uint8_t { kBegun, kPaused, kResumed, kOver };

constexpr auto names_of(const MissionState*) {
  return std::to_array<std::string_view>({"begun", "paused", "resumed", "over"});
}

/// A mission begins, is paused, goes on or is over.
struct MissionChange {
  std::string mission;  ///< its name
  MissionState state = MissionState::kBegun;
  MissionGoal goal;
};

constexpr auto describe(const MissionChange*) {
  using T = MissionChange;
  return described<T>({"mission_change"},
                      "A mission begins, is paused, goes on or is over.",
                      field("mission", &T::mission, "its name"),
                      field("state", &T::state, "what it does"),
                      field("goal", &T::goal, Storage::kJson, "what it is to reach"));
}

}  // namespace skein
