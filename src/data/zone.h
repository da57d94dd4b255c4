#pragma once

#include "geo/polygon.h"

namespace skein {

/// A no-flight zone, from ground to sky.
struct Zone {
  geo::Ring ring;  ///< positive [m]
};

}  // namespace skein
