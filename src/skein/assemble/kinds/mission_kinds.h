// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/assemble/kinds/kinds_of.h"

namespace skein::assemble {

/// Missions that give each aircraft one task after the other: survey, track, patrol,
/// tour, tasks.
void add_team_missions(Kinds<reasoning::PlannedMission, MissionContext>& kinds);

}  // namespace skein::assemble
