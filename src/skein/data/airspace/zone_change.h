// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "skein/data/airspace/zone.h"
#include "skein/data/describe/describe.h"

namespace skein {

/// A no-fly zone that is put into force or taken back in flight.
struct ZoneChange {
  /// Counts the ground station's changes from 1; 0 = a command that no station has taken
  /// up yet.
  std::uint32_t number = 0;
  bool on = true;
  /// Its name says which zone it is: a new one replaces that of the same name. Of a zone
  /// that goes, only the name counts; an operator may also name a known one to have it
  /// back, and leave the ring empty.
  Zone zone;
};

constexpr auto describe(const ZoneChange*) {
  using T = ZoneChange;
  return described<T>(
      {"zone"}, "A no-fly zone that is put into force or taken back.",
      field("number", &T::number,
            "of the ground station's changes; 0: in force from the start"),
      field("in_force", &T::on, "else it is taken back, and only its name counts"),
      field("", &T::zone, "which"));
}

}  // namespace skein
