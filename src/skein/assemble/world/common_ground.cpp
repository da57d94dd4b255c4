// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/world/common_ground.h"

#include "skein/assemble/world/aircraft_builder.h"
#include "skein/base/hash.h"

namespace skein::assemble {

std::string common_ground(const scenario::Scenario& scenario) {
  Hasher hasher;
  hasher.add(scenario.origin.latitude_deg);
  hasher.add(scenario.origin.longitude_deg);
  for (const scenario::Station& station : scenario.stations) {
    hasher.add(std::string_view("station"));
    hasher.add(std::string_view(station.name));
  }
  for (const auto& group : aircraft_names(scenario))
    for (const std::string& name : group) {
      hasher.add(std::string_view("aircraft"));
      hasher.add(std::string_view(name));
    }
  return hasher.hex();
}

}  // namespace skein::assemble
