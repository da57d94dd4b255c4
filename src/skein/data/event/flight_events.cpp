// SPDX-License-Identifier: Apache-2.0
#include "skein/data/event/event_tables.h"

namespace skein::event_tables {
namespace {

using enum EventSeverity;
using enum EventAudience;
using K = EventKind;

constexpr auto kFlightRows = std::to_array<EventKindRow>({
    {K::kJoined, "joined", kInformation, kOperator,
     "It takes part in the run from now on."},
    {K::kLeft, "left", kNotice, kOperator, "It no longer takes part."},
    {K::kTookOff, "took-off", kInformation, kOperator, "It has left the ground."},
    {K::kLanded, "landed", kInformation, kOperator, "It stands on the ground."},
    {K::kAccident, "accident", kAlarm, kOperator,
     "It has hit the ground, or its motion stopped being finite; it is lost."},
    {K::kMode, "mode", kInformation, kPilot,
     "Its autopilot has changed its mode by itself or by an order."},
    {K::kFailsafe, "failsafe", kWarning, kOperator,
     "A failsafe has another trigger or reaction now, or is over.",
     "value: 1 while something else than its agent flies it, else 0"},
    {K::kRefused, "refused", kWarning, kPilot, "Its autopilot has refused a command."},
    {K::kFailure, "failure", kWarning, kOperator,
     "A part has failed, as the scenario or an instructor has it."},
    {K::kRepaired, "repaired", kNotice, kOperator, "A part that had failed works again."},
    {K::kSensorLost, "sensor-lost", kWarning, kPilot,
     "Its autopilot misses a flight sensor."},
    {K::kSensorBack, "sensor-back", kNotice, kPilot,
     "A flight sensor that was missed is there again."},
    {K::kSensorSwitched, "sensor-switched", kNotice, kPilot,
     "Its autopilot flies by another unit of a flight sensor.",
     "value: number of the unit, from 1"},
});

constexpr auto kGuidanceRows = std::to_array<EventKindRow>({
    {K::kPlanned, "planned", kInformation, kResearcher,
     "A path, or a whole survey, has been planned."},
    {K::kNoPlan, "no-plan", kWarning, kOperator,
     "Nothing can be planned for what was requested."},
    {K::kNoPath, "no-path", kWarning, kOperator, "No path leads to where it is to fly."},
    {K::kPointLeftOut, "point-left-out", kNotice, kOperator,
     "A point of its route lies in a no-fly zone and is left out."},
    {K::kOffPlan, "off-plan", kNotice, kResearcher,
     "It is far behind, ahead of or beside its plan.", "value: beside the path [m]"},
    {K::kOnPlan, "on-plan", kInformation, kResearcher, "It is close to its plan again.",
     "value: beside the path [m]"},
    {K::kFlightChanged, "flight-changed", kInformation, kOperator,
     "It flies at the height or speed that the operator has given."},
    {K::kFlightRefused, "flight-refused", kWarning, kOperator,
     "It refuses a height or speed that the operator has given."},
    {K::kLandingWait, "landing-wait", kInformation, kOperator,
     "It circles until it is its turn to land."},
    {K::kLandingTurn, "landing-turn", kInformation, kOperator, "It is its turn to land."},
    {K::kReturnMoved, "return-moved", kNotice, kOperator,
     "Returns lead to another place, because of a no-fly zone, or home again."},
    {K::kSetpointsEnded, "setpoints-ended", kNotice, kIntegrator,
     "Setpoints from a ground station have ended; it holds its place."},
});

}  // namespace

static_assert(in_order(kFlightRows));
constinit const EventGroup kFlight = {
    EventSubject::kFlight, "An aircraft, its autopilot and its sensors", kFlightRows};
static_assert(in_order(kGuidanceRows));
constinit const EventGroup kGuidance = {
    EventSubject::kGuidance, "What is flown: plans, paths and landings", kGuidanceRows};

}  // namespace skein::event_tables
