// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "skein/model/well_clear/band_search.h"

namespace skein::model {

/// Which tracks, speeds, vertical speeds and altitudes lead into conflict.
///
/// Values go in steps (ManoeuvreOptions). For each region of the configuration a value is
/// in conflict if the way there or straight flight afterwards enters the volume of that
/// region about any intruder: within the lookahead if the intruder is in conflict within
/// the alerting time already, else within the alerting time after the value is reached.
/// A range has no conflict where the values at both its ends have none. When no range is
/// without conflict of the corrective region or a worse one, values that regain well
/// clear soonest are kRecovery.
///
/// Works in memory of its own: no allocation once it has met as many options and pieces.
/// Not for several threads at a time.
///
/// Reference: [Munoz15]; docs/well-clear.md has the rules in full.
class BandMaker {
 public:
  /// @param configuration  checked.
  explicit BandMaker(WellClearConfiguration configuration);

  const WellClearConfiguration& configuration() const { return *configuration_; }

  /// The bands of one kind; valid until asked for that kind again.
  const ManoeuvreBands& bands(ManoeuvreKind kind, const AircraftMotion& own,
                              std::span<const Intruder> intruders);

  /// The last time at which a manoeuvre of this kind may begin and still keep out of the
  /// corrective volume about one intruder, to 0.5 s.
  ///
  /// @returns  [s] from now, of straight flight; infinity: there is no conflict within
  ///           the lookahead; -infinity: it is too late.
  double last_time(ManoeuvreKind kind, const AircraftMotion& own,
                   const Intruder& intruder);

 private:
  std::unique_ptr<const WellClearConfiguration> configuration_;  // stays where it is
  std::vector<BandSearch> searches_;                             // by kind
};

}  // namespace skein::model
