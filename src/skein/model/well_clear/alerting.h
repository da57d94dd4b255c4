// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "skein/geo/vec.h"
#include "skein/model/well_clear/configuration.h"
#include "skein/model/well_clear/manoeuvre.h"

namespace skein::model {

/// Position and velocity of an aircraft.
struct AircraftMotion {
  Vec3 p_N = Vec3::Zero();  ///< [m]
  Vec3 v_N = Vec3::Zero();  ///< [m/s]
};

/// Another aircraft, as it is believed to move.
struct Intruder {
  AircraftMotion motion;
  std::size_t alerter = 0;  ///< of the configuration
  /// What volumes around it grow by [m], k sigma of its position for one.
  double horizontal_margin = 0, vertical_margin = 0;
};

/// The volume around `intruder`: that of a level or of recovery, with its margins.
WellClearVolume grown(const WellClearVolume& volume, const Intruder& intruder);

OwnMotion own_motion(const AircraftMotion& own);
/// The intruder as seen from `own`.
IntruderMotion intruder_motion(const AircraftMotion& own, const Intruder& intruder);

/// When straight flight of both is within the volume of `level`, up to the lookahead.
ConflictSpan level_conflict(const WellClearConfiguration& configuration,
                            const AlertLevel& level, const AircraftMotion& own,
                            const Intruder& intruder);

/// The alert for one intruder: the highest level whose volume is entered within its
/// alerting time; 1 is the first of its alerter, 0 none.
/// Cost: below 0.1 us; no allocation.
int alert_level(const WellClearConfiguration& configuration, const AircraftMotion& own,
                const Intruder& intruder);

/// Alerts for one intruder over time, without flicker.
///
/// A level is taken when at least m of the last n answers had it or a higher one; the
/// first answer counts m times. It does not fall for the persistence time after it
/// was raised; while it is kept its early alerting time counts. All is forgotten when no
/// answer was asked for the hysteresis time.
class AlertHysteresis {
 public:
  /// The level at `time` [s], of which those asked before are not later.
  int level(const WellClearConfiguration& configuration, const AircraftMotion& own,
            const Intruder& intruder, double time);

 private:
  std::array<int, kMaxHysteresisAnswers> answers_{};  // latest first
  std::size_t count_ = 0;
  int held_ = 0;
  double raised_ = 0, last_ = 0;
  bool asked_ = false;
};

}  // namespace skein::model
