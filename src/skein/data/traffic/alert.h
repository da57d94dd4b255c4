// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "skein/data/describe/describe.h"
#include "skein/geo/vec.h"

// Alerts about other aircraft and what pilots are shown of them: as [DO365] and [Munoz15]
// define them.

namespace skein {

/// What a band says of the values in it, and what a level of alerts stands for.
enum class AlertRegion : std::uint8_t {
  kNone,      ///< without conflict
  kFar,       ///< preventive
  kMid,       ///< corrective
  kNear,      ///< warning
  kRecovery,  ///< all else is in conflict; this gets out of it soonest
};
constexpr auto names_of(const AlertRegion*) {
  return std::to_array<std::string_view>({"NONE", "FAR", "MID", "NEAR", "RECOVERY"});
}

/// The alert about another aircraft has another level from now on.
struct TrafficAlert {
  std::uint32_t track = 0;                  ///< number on board
  std::uint32_t level = 0;                  ///< 1 is the first; 0: it is over
  AlertRegion region = AlertRegion::kNone;  ///< that the level stands for
  double bearing = 0;   ///< of the other from the nose, to the right, -pi to pi [rad]
  double distance = 0;  ///< horizontal [m]
  double height = 0;    ///< of the other above the own aircraft [m]
  /// To be flown out of the conflict toward the goal; none: what is flown need not be
  /// left, or nothing leads out.
  std::optional<double> track_advised = {};           ///< over ground [rad]
  std::optional<double> speed_advised = {};           ///< over ground [m/s]
  std::optional<double> vertical_speed_advised = {};  ///< up [m/s]
};

constexpr auto describe(const TrafficAlert*) {
  using T = TrafficAlert;
  return described<T>(
      {"traffic_alert"}, "The alert about another aircraft has another level.",
      field("track", &T::track, "number of the other on board"),
      field("level", &T::level, "from 1 on; 0: the alert is over"),
      field("region", &T::region, "that the level stands for"),
      field("bearing", &T::bearing, unit::kDegree, "from the nose, to the right"),
      field("distance", &T::distance, unit::kMetre, "horizontal"),
      field("height", &T::height, unit::kMetre, "of the other above the own aircraft"),
      field("track_advised", &T::track_advised, unit::kDegree,
            "out of the conflict, toward the goal; null: not needed, or none is found"),
      field("speed_advised", &T::speed_advised, unit::kMetrePerSecond, "the same"),
      field("vertical_speed_advised", &T::vertical_speed_advised, unit::kMetrePerSecond,
            "the same, up"));
}

/// Tracks that lead into a conflict, or out of one.
struct TrackBand {
  double from = 0, to = 0;  ///< clockwise from north [rad]
  AlertRegion region = AlertRegion::kNone;
};

constexpr auto describe(const TrackBand*) {
  using T = TrackBand;
  return described<T>({"track_band"}, "Tracks and what they lead to.",
                      field("from", &T::from, unit::kDegree, "clockwise from north"),
                      field("to", &T::to, unit::kDegree, "the same"),
                      field("region", &T::region, "what they lead to"));
}

/// The same of speeds over ground, or of vertical speeds, up.
struct SpeedBand {
  double from = 0, to = 0;  ///< [m/s]
  AlertRegion region = AlertRegion::kNone;
};

constexpr auto describe(const SpeedBand*) {
  using T = SpeedBand;
  return described<T>({"speed_band"}, "Speeds and what they lead to.",
                      field("from", &T::from, unit::kMetrePerSecond, "of the range"),
                      field("to", &T::to, unit::kMetrePerSecond, "of the range"),
                      field("region", &T::region, "what they lead to"));
}

/// The same of altitudes above mean sea level.
struct AltitudeBand {
  double from = 0, to = 0;  ///< [m]
  AlertRegion region = AlertRegion::kNone;
};

constexpr auto describe(const AltitudeBand*) {
  using T = AltitudeBand;
  return described<T>({"altitude_band"}, "Altitudes and what they lead to.",
                      field("from", &T::from, unit::kMetre, "above mean sea level"),
                      field("to", &T::to, unit::kMetre, "above mean sea level"),
                      field("region", &T::region, "what they lead to"));
}

/// What an aircraft may fly while an alert stands. Values in no band are without
/// conflict.
struct FlightBands {
  std::uint32_t level = 0;    ///< the highest of all alerts; 0: none stands any more
  double track = 0;           ///< the own one, over ground [rad]
  double speed = 0;           ///< the same [m/s]
  double vertical_speed = 0;  ///< the same, up [m/s]
  std::optional<double> track_advised = {};           ///< as of TrafficAlert
  std::optional<double> speed_advised = {};           ///< the same
  std::optional<double> vertical_speed_advised = {};  ///< the same
  /// Until well clear is regained on the soonest of the tracks that are RECOVERY [s].
  std::optional<double> recovery = {};
  std::vector<TrackBand> tracks;
  std::vector<SpeedBand> speeds, vertical_speeds;
  std::vector<AltitudeBand> altitudes;
};

constexpr auto describe(const FlightBands*) {
  using T = FlightBands;
  return described<T>(
      {"flight_bands"}, "What an aircraft may fly while an alert stands.",
      field("level", &T::level, "the highest of all alerts; 0: none any more"),
      field("track", &T::track, unit::kDegree, "the own one, over ground"),
      field("speed", &T::speed, unit::kMetrePerSecond, "the own one, over ground"),
      field("vertical_speed", &T::vertical_speed, unit::kMetrePerSecond,
            "the own one, up"),
      field("track_advised", &T::track_advised, unit::kDegree,
            "out of the conflict, toward the goal; null: not needed, or none is found"),
      field("speed_advised", &T::speed_advised, unit::kMetrePerSecond, "the same"),
      field("vertical_speed_advised", &T::vertical_speed_advised, unit::kMetrePerSecond,
            "the same, up"),
      field("recovery", &T::recovery, unit::kSecond,
            "until well clear again, by a track that is RECOVERY; null: there is none"),
      field("tracks", &T::tracks, Storage::kJson, "bands of tracks; others are free"),
      field("speeds", &T::speeds, Storage::kJson, "the same of speeds"),
      field("vertical_speeds", &T::vertical_speeds, Storage::kJson, "the same, up"),
      field("altitudes", &T::altitudes, Storage::kJson, "the same of altitudes"));
}

/// What becomes of a path that is recommended to the pilot on board.
enum class RecommendationState : std::uint8_t {
  kShown,     ///< the pilot sees it
  kFollowed,  ///< the pilot flies it from now on
  kIgnored,   ///< the pilot does not fly it: simulated ones decide so when they see it
  kOver,      ///< it is shown no longer: what the task asks for is flown
};
constexpr auto names_of(const RecommendationState*) {
  return std::to_array<std::string_view>({"shown", "followed", "ignored", "over"});
}

/// A point of a recommended path.
struct RecommendedPoint {
  double time = 0;          ///< [s]
  Vec3 p_N = Vec3::Zero();  ///< [m]
};

constexpr auto describe(const RecommendedPoint*) {
  using T = RecommendedPoint;
  return described<T>({"recommended_point"}, "A point of a recommended path.",
                      field("time", &T::time, unit::kSecond, "when"),
                      field("", &T::p_N, axes::kPlace, "where"));
}

/// A path that is recommended to the pilot on board, or what becomes of it.
struct Recommendation {
  std::uint32_t number = 0;  ///< of those of the aircraft, from 1
  RecommendationState state = RecommendationState::kShown;
  std::string reason;                  ///< why another path than the task's
  std::vector<RecommendedPoint> path;  ///< when it is shown: the next minutes of it
};

constexpr auto describe(const Recommendation*) {
  using T = Recommendation;
  return described<T>({"recommendation"},
                      "A path that is recommended to the pilot on board.",
                      field("number", &T::number, "of those of the aircraft"),
                      field("state", &T::state, "what becomes of it"),
                      field("reason", &T::reason, "why another path than the task's"),
                      field("path", &T::path, Storage::kJson,
                            "the next minutes of it, when it is shown"));
}

}  // namespace skein
