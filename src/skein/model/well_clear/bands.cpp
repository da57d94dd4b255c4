// SPDX-License-Identifier: Apache-2.0
#include "skein/model/well_clear/bands.h"

namespace skein::model {

BandMaker::BandMaker(WellClearConfiguration configuration)
    : configuration_(
          std::make_unique<const WellClearConfiguration>(std::move(configuration))) {
  for (std::size_t k = 0; k < kManoeuvreKinds; ++k)
    searches_.emplace_back(*configuration_, static_cast<ManoeuvreKind>(k));
}

const ManoeuvreBands& BandMaker::bands(ManoeuvreKind kind, const AircraftMotion& own,
                                       std::span<const Intruder> intruders) {
  return searches_[static_cast<std::size_t>(kind)].run(own, intruders);
}

double BandMaker::last_time(ManoeuvreKind kind, const AircraftMotion& own,
                            const Intruder& intruder) {
  return searches_[static_cast<std::size_t>(kind)].last_time(own, intruder);
}

}  // namespace skein::model
