// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "skein/layer/reasoning/team/onboard/onboard_team.h"
#include "skein/layer/reasoning/team/onboard/team_server.h"
#include "skein/scenario/scenario.h"

namespace skein::assemble {

struct AircraftContext;
struct RadioParts;

/// How an aircraft takes part in the team of its station; null: that does not lead
/// itself.
/// @param context  with its sensors and limits.
/// @param parts    of radios
std::shared_ptr<const reasoning::OnboardTeamOptions> onboard_team(
    const scenario::Scenario& scenario, std::size_t station,
    const AircraftContext& context, const RadioParts& parts);

/// Gives the desk of a station to each of its missions; none: its team does not lead
/// itself.
/// @param place  of the station, N [m].
/// @param zones  in force from the start.
std::function<std::shared_ptr<reasoning::TeamServer>()> team_server(
    const scenario::Scenario& scenario, std::size_t station, const Vec3& place,
    std::vector<Zone> zones, const RadioParts& parts);

/// Beyond which a radio's messages are lost [m]; 0: no limit, or not known of its kind.
double radio_range(const scenario::Choice& radio, const RadioParts& parts);

}  // namespace skein::assemble
