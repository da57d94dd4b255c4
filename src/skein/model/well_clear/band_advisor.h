// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "skein/model/well_clear/bands.h"

namespace skein::model {

/// Another aircraft as it is tracked.
struct TrackedIntruder {
  std::uint32_t number = 0;  ///< its own, the same at each step
  AircraftMotion motion;
  double horizontal_sigma = 0, vertical_sigma = 0;  ///< of its position now [m]
  std::size_t alerter = 0;                          ///< of the configuration
};

/// What the own aircraft would do if it were alone.
struct FlightGoal {
  double track = 0;           ///< clockwise from north [rad]
  double speed = 0;           ///< over ground [m/s]
  double vertical_speed = 0;  ///< up [m/s]
  /// Above mean sea level [m]; none: bands of altitudes are not asked for.
  std::optional<double> altitude = {};
};

/// A value to be flown.
struct AdvisedValue {
  double value = 0;  ///< [rad, m/s]
  /// kRecovery: none is without conflict, this regains well clear soonest.
  AlertRegion region = AlertRegion::kNone;
  bool up = false;  ///< it is right of, above or faster than the goal
};

/// The value nearest to `goal` that need not be left: `goal` itself, or the end of a
/// piece beyond. None when there is none.
///
/// @param goal  of the bands' kind [rad, m/s or m]; tracks are the nearest, and within
///              half a turn to one side.
/// @param side  true: only those above (right of) the goal; none: the nearer one.
std::optional<AdvisedValue> nearest_free(const ManoeuvreBands& bands,
                                         AlertRegion corrective, double goal,
                                         std::optional<bool> side = std::nullopt);

/// Alerts of intruders and where to fly, each second on board.
///
/// Remembers alerts (AlertHysteresis) and on which side of the goal it passes: that side
/// is kept while it has a free value. Volumes grow by `sigmas` times the sigma of a
/// track. No allocation once it has met as many intruders.
class BandAdvisor {
 public:
  static constexpr double kSigmas = 2;

  explicit BandAdvisor(WellClearConfiguration configuration, double sigmas = kSigmas)
      : maker_(std::move(configuration)), sigmas_(sigmas) {}

  struct Advice {
    std::span<const int> alerts;  ///< of each intruder, in their order
    int alert = 0;                ///< the highest
    /// None: all values of that kind lead into conflict, and none out of it.
    std::optional<AdvisedValue> track, speed, vertical_speed, altitude;
  };

  /// What is advised at `time` [s]; valid until asked again. Times ascend.
  const Advice& advise(double time, const AircraftMotion& own,
                       std::span<const TrackedIntruder> intruders,
                       const FlightGoal& goal);

  /// The first half of advise(): alerts alone, which cost far less than bands. Nothing is
  /// advised yet.
  const Advice& watch(double time, const AircraftMotion& own,
                      std::span<const TrackedIntruder> intruders);
  /// The second half: values and bands, about the intruders of the last watch().
  const Advice& guide(const AircraftMotion& own, const FlightGoal& goal);

  /// The region that a level of alerts about an intruder stands for; kNone: level 0.
  AlertRegion region_of(int level, std::size_t alerter) const;

  /// The bands that the last advice was made from; of altitudes only where the goal had
  /// one.
  const ManoeuvreBands& bands(ManoeuvreKind kind) const {
    return *bands_[static_cast<std::size_t>(kind)];
  }

 private:
  struct Memory {
    std::uint32_t number;
    double last;  // asked for [s]
    AlertHysteresis hysteresis;
  };

  AlertHysteresis& hysteresis_of(std::uint32_t number, double time);
  std::optional<AdvisedValue> value_for(ManoeuvreKind kind, const AircraftMotion& own,
                                        double goal);

  BandMaker maker_;
  double sigmas_;
  std::vector<Intruder> intruders_;
  std::vector<int> alerts_;
  std::vector<Memory> memories_;
  std::array<std::optional<bool>, kManoeuvreKinds> side_;
  std::array<const ManoeuvreBands*, kManoeuvreKinds> bands_{};
  Advice advice_;
};

}  // namespace skein::model
