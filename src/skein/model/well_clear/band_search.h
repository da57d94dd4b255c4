// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "skein/model/well_clear/alerting.h"
#include "skein/model/well_clear/manoeuvre_bands.h"
#include "skein/model/well_clear/options.h"
#include "skein/model/well_clear/recovery.h"

namespace skein::model {

/// Makes the bands of one kind of manoeuvre; see BandMaker.
class BandSearch {
 public:
  /// `configuration` is used as long as this is.
  BandSearch(const WellClearConfiguration& configuration, ManoeuvreKind kind);

  const ManoeuvreBands& run(const AircraftMotion& own,
                            std::span<const Intruder> intruders);

  /// See BandMaker::last_time().
  double last_time(const AircraftMotion& own, const Intruder& intruder);

 private:
  static constexpr std::size_t kRegions = 3;  // kFar, kMid, kNear

  void mark(const AircraftMotion& own, const Intruder& intruder);
  bool can_avoid(const AircraftMotion& own, const Intruder& intruder,
                 const WellClearVolume& volume);
  bool has_free_range(const std::vector<char>& red) const;
  AlertRegion region_between(std::size_t option) const;
  void list_pieces();
  void add_piece(double lo, double hi, AlertRegion region);
  void list_track_pieces();
  void add_track_piece(const BandPiece& piece);

  const WellClearConfiguration* configuration_;
  ManoeuvreOptions options_;
  RecoverySearch recovery_;
  std::array<std::vector<char>, kRegions> red_;  // of each option
  std::vector<OptionSpan> spans_;
  std::vector<BandPiece> turned_;  // tracks, from where the range begins
  ManoeuvreBands bands_;
};

}  // namespace skein::model
