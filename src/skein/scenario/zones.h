// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "skein/data/airspace/zone.h"
#include "skein/scenario/scenario.h"

namespace skein::scenario {

/// The zone that keys describe; a ring is made positive. Without a shape its ring is
/// empty.
Zone to_zone(const NoFlightZone& described);

/// The zone of `zones_m[index]`.
Zone ring_zone(const geo::Ring& ring, std::size_t index);

/// What is wrong with a zone of the list `zones`; see error_in(const Zone&).
std::vector<RuleViolation> zone_errors(const NoFlightZone& zone);

/// What is wrong with `zones_m`, and names in `zones` that are there twice.
std::vector<RuleViolation> zone_list_errors(const Environment& environment,
                                            const ValidValues& valid);

/// Rings that run counter-clockwise on the map. They mean the same area; one sentence for
/// each, so that whoever meant a hole learns of it.
std::vector<std::string> zone_warnings(const Environment& environment);

}  // namespace skein::scenario
