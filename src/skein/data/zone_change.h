#pragma once

#include <cstdint>

#include "skein/data/zone.h"

namespace skein {

/// A no-flight zone that is put into force or taken back in flight.
struct ZoneChange {
  /// Counts the ground station's changes from 1; 0 = an operator's wish that the station
  /// has not taken up yet.
  std::uint32_t number = 0;
  bool on = true;
  /// Its name says which zone it is: a new one replaces that of the same name. Of a zone
  /// that goes, only the name counts; an operator may also name a known one to have it
  /// back, and leave the ring empty.
  Zone zone;
};

}  // namespace skein
