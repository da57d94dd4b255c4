// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "skein/base/id.h"

namespace skein::record {

/// Whose belief something is: a mission of a ground station.
struct Believer {
  EntityId station;
  std::string mission;

  bool operator==(const Believer&) const = default;
  auto operator<=>(const Believer&) const = default;
};

}  // namespace skein::record
