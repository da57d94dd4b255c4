// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "skein/base/result.h"
#include "skein/data/traffic/alert.h"
#include "skein/model/well_clear/volume.h"

namespace skein::model {

using skein::AlertRegion;
using skein::name_of;  // NONE, FAR, MID, NEAR, RECOVERY

/// None where no region has that name.
std::optional<AlertRegion> alert_region_named(std::string_view name);

/// One level of alerts.
struct AlertLevel {
  AlertRegion region = AlertRegion::kNone;  ///< of bands; kNone: it makes none
  double alerting_time = 0;                 ///< [s] before the volume is entered
  double early_alerting_time = 0;           ///< [s]; counts while the level is held
  WellClearVolume volume;
};

/// The levels that count for one class of intruders, weakest first.
struct Alerter {
  std::string name;  ///< as tables of encounters have it
  std::vector<AlertLevel> levels;
};

/// The most answers that hysteresis remembers.
inline constexpr int kMaxHysteresisAnswers = 16;

/// How bands are made and alerts given; SI.
struct WellClearConfiguration {
  struct Track {
    double step;       ///< [rad]
    double turn_rate;  ///< [rad/s]
  };
  struct Speed {
    double step;   ///< [m/s]
    double accel;  ///< [m/s^2]
    double min, max;
  };
  struct Altitude {
    double step;      ///< [m]
    double rate;      ///< of climb and descent [m/s]
    double accel;     ///< [m/s^2]
    double min, max;  ///< above mean sea level [m]
  };
  struct Recovery {
    double horizontal, vertical;            ///< kept while getting out [m]
    double stability;                       ///< added to the time of it [s]
    double ca_factor;                       ///< share that the distances shrink by
    double nmac_horizontal, nmac_vertical;  ///< they do not shrink below [m]
  };
  struct Hysteresis {
    double time;         ///< without an answer, after which all is forgotten [s]
    double persistence;  ///< a level does not fall before [s]
    int m, n;            ///< a level is taken when m of the last n answers had it
  };

  std::string name;
  double lookahead;  ///< [s]
  Track track;
  Speed speed;           ///< over ground
  Speed vertical_speed;  ///< up
  Altitude altitude;
  Recovery recovery;
  AlertRegion corrective;  ///< what resolutions get out of
  double min_airspeed;     ///< [m/s]
  Hysteresis hysteresis;
  std::vector<Alerter> alerters;
};

/// Checks that a configuration can be worked with.
/// Fails: kBadInput naming the key (as in files), what it is and what is allowed.
Result<void> check(const WellClearConfiguration& configuration);

/// The index of the alerter with that name; none where there is not one.
std::optional<std::size_t> alerter_named(const WellClearConfiguration& configuration,
                                         std::string_view name);

/// `DO_365B_no_SUM`: for manned and large unmanned aircraft, as in [DO365], without the
/// uncertainty of sensors; `skein_suas`: for small aircraft of 12 to 35 m/s.
/// None for other names.
std::optional<WellClearConfiguration> well_clear_configuration(std::string_view name);

/// The names of those that are built in, for messages.
std::string well_clear_configuration_names();

}  // namespace skein::model
