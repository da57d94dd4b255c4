// SPDX-License-Identifier: Apache-2.0
#include "skein/data/event/event_tables.h"

namespace skein::event_tables {
namespace {

using enum EventSeverity;
using enum EventAudience;
using K = EventKind;

constexpr auto kVehicleRows = std::to_array<EventKindRow>({
    {K::kLinkUp, "link-up", kInformation, kOperator,
     "The link to a vehicle or an agent in another program is up."},
    {K::kLinkLost, "link-lost", kWarning, kOperator,
     "The link to a vehicle or an agent in another program is down."},
    {K::kVehicleIdentified, "vehicle-identified", kInformation, kIntegrator,
     "A vehicle has said what it is."},
    {K::kVehicleSays, "vehicle-says", kWarning, kOperator,
     "A vehicle has reported an error in words of its own."},
    {K::kVehicleRebooted, "vehicle-rebooted", kWarning, kOperator,
     "A vehicle has started anew."},
    {K::kWrongVehicle, "wrong-vehicle", kAlarm, kOperator,
     "A vehicle is not what the scenario says.", "", kAnnounced},
    {K::kWrongPlace, "wrong-place", kAlarm, kOperator,
     "A vehicle is not where it is to start; it is not commanded.", "", kAnnounced},
    {K::kNotHeard, "not-heard", kWarning, kOperator, "Nothing is received of a vehicle.",
     "", kAnnounced},
    {K::kDuplicateVehicle, "duplicate-vehicle", kAlarm, kOperator,
     "Two vehicles answer by one system id."},
    {K::kClockSet, "clock-set", kInformation, kIntegrator,
     "The clock of a vehicle was set ahead."},
    {K::kOtherClock, "other-clock", kNotice, kIntegrator,
     "A vehicle answers by another clock than its telemetry's."},
    {K::kTakeOffDenied, "take-off-denied", kWarning, kOperator,
     "A vehicle does not take off, or is not brought back.", "", kAnnounced},
    {K::kRequestDenied, "request-denied", kWarning, kOperator,
     "A vehicle denies a request."},
    {K::kNotCommandable, "not-commandable", kAlarm, kOperator,
     "A vehicle flies and cannot be commanded; it is sent back.", "", kAnnounced},
    {K::kNotBroughtBack, "not-brought-back", kAlarm, kOperator,
     "A vehicle that cannot be commanded takes no order to return.", "", kAnnounced},
    {K::kPilotTookOver, "pilot-took-over", kNotice, kOperator,
     "A safety pilot flies a vehicle."},
    {K::kModeChanged, "mode-changed", kNotice, kOperator,
     "A vehicle is in a mode in which it is left alone."},
    {K::kHandedBack, "handed-back", kNotice, kOperator,
     "A vehicle may be commanded again."},
    {K::kPositionOld, "position-old", kWarning, kOperator,
     "The last position of a vehicle is too old to command it by."},
    {K::kPositionLost, "position-lost", kWarning, kOperator,
     "A vehicle has no position by satellites any more."},
    {K::kPositionJumped, "position-jumped", kWarning, kOperator,
     "The position of a vehicle has jumped."},
    {K::kPositionBack, "position-back", kNotice, kOperator,
     "The position of a vehicle is good again."},
    {K::kFenceUploaded, "fence-uploaded", kInformation, kOperator,
     "A vehicle has taken the no-fly zones as its fence."},
    {K::kFenceRefused, "fence-refused", kWarning, kOperator,
     "A vehicle has not taken the no-fly zones as its fence."},
});

constexpr auto kProgramRows = std::to_array<EventKindRow>({
    {K::kAutopilotHeard, "autopilot-heard", kInformation, kIntegrator,
     "An outside autopilot answers."},
    {K::kAutopilotSilent, "autopilot-silent", kWarning, kOperator,
     "An outside autopilot answers no more."},
    {K::kAutopilotBack, "autopilot-back", kNotice, kOperator,
     "An outside autopilot answers again."},
    {K::kAutopilotEnded, "autopilot-ended", kWarning, kOperator,
     "The program of an outside autopilot has ended."},
    {K::kAutopilotRestarted, "autopilot-restarted", kNotice, kOperator,
     "The program of an outside autopilot was started again."},
    {K::kFlightModelHeard, "flight-model-heard", kInformation, kIntegrator,
     "An outside flight model sends motion."},
    {K::kFlightModelSilent, "flight-model-silent", kWarning, kOperator,
     "An outside flight model sends no motion."},
    {K::kFlightModelBack, "flight-model-back", kNotice, kOperator,
     "An outside flight model sends motion again."},
    {K::kFlightModelReset, "flight-model-reset", kNotice, kOperator,
     "An outside flight model begins anew."},
    {K::kFlightModelEnded, "flight-model-ended", kWarning, kOperator,
     "The program of an outside flight model has ended."},
    {K::kFlightModelRestarted, "flight-model-restarted", kNotice, kOperator,
     "The program of an outside flight model was started again."},
    {K::kAgentRestarted, "agent-restarted", kWarning, kOperator,
     "The agent of an entity in another program has started anew."},
    {K::kWrongAgent, "wrong-agent", kWarning, kOperator,
     "An agent in another program is of another run or entity."},
    {K::kDuplicateAgent, "duplicate-agent", kWarning, kOperator,
     "Two agents say that they are one entity."},
    {K::kWorldJoined, "world-joined", kInformation, kIntegrator,
     "An agent in a program of its own has joined the world."},
    {K::kWorldLost, "world-lost", kWarning, kOperator,
     "An agent in a program of its own does not receive the world."},
    {K::kWorldBack, "world-back", kNotice, kOperator,
     "An agent in a program of its own receives the world again."},
    {K::kWorldRestarted, "world-restarted", kWarning, kOperator,
     "The world of an agent has started anew."},
    {K::kWorldRefused, "world-refused", kWarning, kOperator,
     "The world refuses an agent."},
});

constexpr auto kMemoryRows = std::to_array<EventKindRow>({
    {K::kUpdateRefused, "update-refused", kNotice, kResearcher,
     "A virtual sensor saw a remembered object, which does not refresh the memory."},
    {K::kUnknownObjectInteraction, "unknown-object-interaction", kWarning, kResearcher,
     "A virtual aircraft was in or near an object of which nobody knew.",
     "value: distance [m]"},
    {K::kForgotten, "forgotten", kNotice, kResearcher,
     "An object is forgotten: too old, or not where it was remembered."},
    {K::kNonActualObservation, "non-actual-observation", kWarning, kResearcher,
     "Somebody relied on an object that was no longer where it was remembered."},
});

constexpr auto kPluginRows = std::to_array<EventKindRow>({
    {K::kPlugin, "plugin", kInformation, kIntegrator,
     "An event of a plugin's own, or of another version of Skein, with its own name."},
});

}  // namespace

static_assert(in_order(kVehicleRows));
constinit const EventGroup kVehicle = {EventSubject::kVehicle,
                                       "Real vehicles and their links", kVehicleRows};
static_assert(in_order(kProgramRows));
constinit const EventGroup kProgram = {
    EventSubject::kProgram,
    "Programs outside: autopilots, flight models, agents, the world", kProgramRows};
static_assert(in_order(kMemoryRows));
constinit const EventGroup kMemory = {EventSubject::kMemory, "Memory of physical objects",
                                      kMemoryRows};
static_assert(in_order(kPluginRows));
constinit const EventGroup kPlugin = {EventSubject::kPlugin, "Plugins", kPluginRows};

}  // namespace skein::event_tables
