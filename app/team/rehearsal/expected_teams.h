// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "app/team/rehearsal/script.h"

namespace skein::rehearsal {

/// The teams that must result from a script, written down from the rules and not from the
/// protocol: the lowest id leads at the start; a master that is lost is followed by the
/// lowest id of its group; newcomers go to the smallest team, never lead at once; two
/// masters of one mission that meet become one team under the lower id, and at the second
/// meeting of the same two split it.
///
/// @returns  what is expected at the start and from each event on, when all has settled;
///           `time` is the event's.
std::vector<TeamExpectation> expected_teams(const TeamScript& script);

/// A script by chance: 2 to `max_aircraft` aircraft, up to 5 events 40 s to 90 s apart.
TeamScript random_team_script(std::uint64_t seed, std::uint32_t index,
                              std::uint32_t max_aircraft);

}  // namespace skein::rehearsal
