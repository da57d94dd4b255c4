// SPDX-License-Identifier: Apache-2.0
#include "skein/data/event/event_tables.h"

namespace skein::event_tables {
namespace {

using enum EventSeverity;
using enum EventAudience;
using K = EventKind;

constexpr auto kTaskRows = std::to_array<EventKindRow>({
    {K::kOrdered, "ordered", kInformation, kOperator,
     "A station orders a task, a change of one, a height or a speed.",
     "task: number of the order, where it is of a task"},
    {K::kTask, "task", kInformation, kOperator, "It begins a task.",
     "task or team_task: its number"},
    {K::kTaskRefused, "task-refused", kWarning, kOperator,
     "It refuses a task that it was given.", "task or team_task: its number"},
    {K::kTaskPaused, "task-paused", kInformation, kOperator,
     "Its task waits for the operator.", "task or team_task: its number"},
    {K::kTaskResumed, "task-resumed", kInformation, kOperator, "Its task goes on.",
     "task or team_task: its number"},
    {K::kTaskCancelled, "task-cancelled", kNotice, kOperator, "Its task is cancelled.",
     "task or team_task: its number"},
    {K::kTaskImpossible, "task-impossible", kWarning, kOperator,
     "Its task cannot be flown any more.", "task or team_task: its number"},
    {K::kTaskDone, "task-done", kInformation, kOperator, "Its task is done.",
     "task or team_task: its number"},
    {K::kTaskMoved, "task-moved", kNotice, kOperator,
     "The place of its task is moved out of a no-fly zone, or back."},
    {K::kTaskOver, "task-over", kInformation, kOperator,
     "A task of the mission's list is over."},
    {K::kTaskGivenUp, "task-given-up", kWarning, kOperator,
     "A task of the mission's list is given up: nobody can fly it."},
    {K::kRouteDone, "route-done", kInformation, kOperator,
     "The last point of a route or tour has been passed."},
    {K::kLate, "late", kWarning, kOperator, "It cannot be at its rendezvous in time.",
     "value: how much later [s]"},
    {K::kArrived, "arrived", kInformation, kOperator, "It is at its rendezvous.",
     "value: after the requested time [s]"},
    {K::kMeasured, "measured", kInformation, kResearcher,
     "A measurement at a place is complete."},
    {K::kEdgeLost, "edge-lost", kNotice, kResearcher,
     "It has lost the edge of the fire that it follows."},
    {K::kEdgeFound, "edge-found", kInformation, kResearcher,
     "It has found the edge of the fire again."},
    {K::kSurveyIncomplete, "survey-incomplete", kWarning, kOperator,
     "Parts of a survey could not be flown.",
     "value: share that is missing, from 0 to 1"},
});

constexpr auto kMissionRows = std::to_array<EventKindRow>({
    {K::kMission, "mission", kInformation, kOperator,
     "A mission begins, is paused, goes on or is over."},
    {K::kCommandRefused, "command-refused", kWarning, kOperator,
     "A command cannot be obeyed."},
    {K::kAllocated, "allocated", kInformation, kOperator,
     "An aircraft is given to a mission, or to none."},
    {K::kSurveyed, "surveyed", kInformation, kOperator,
     "Nothing is left of a survey that its aircraft can fly."},
    {K::kShared, "shared", kInformation, kResearcher,
     "The lines of a survey are divided among its aircraft."},
    {K::kObjectFound, "object-found", kInformation, kOperator,
     "A mission has found an object to be tracked.", "value: number of the object"},
    {K::kObjectLost, "object-lost", kWarning, kOperator,
     "An object that was tracked has not been seen for long.",
     "value: number of the object"},
    {K::kLeader, "leader", kNotice, kOperator, "It leads the formation from now on."},
    {K::kLeaderLost, "leader-lost", kWarning, kOperator,
     "The leader of a formation is silent, or under another command."},
});

constexpr auto kZoneRows = std::to_array<EventKindRow>({
    {K::kZone, "zone", kNotice, kOperator,
     "It is inside a no-fly zone, has left it, or turns away from one."},
    {K::kZoneOn, "zone-on", kInformation, kOperator,
     "A no-fly zone is in force: of a station, or as an aircraft has received it."},
    {K::kZoneOff, "zone-off", kInformation, kOperator, "A no-fly zone is taken back."},
    {K::kZoneRefused, "zone-refused", kWarning, kOperator,
     "A zone that was drawn cannot be put into force."},
    {K::kZonesKnown, "zones-known", kInformation, kOperator,
     "All aircraft in contact have acknowledged the zones.",
     "value: number of the last change"},
});

constexpr auto kFireRows = std::to_array<EventKindRow>({
    {K::kCrossing, "crossing", kInformation, kResearcher,
     "An aircraft has crossed the boundary."},
    {K::kNoCrossing, "no-crossing", kNotice, kResearcher,
     "The deployment of an aircraft met no boundary."},
    {K::kForcedCrossing, "forced-crossing", kNotice, kResearcher,
     "An aircraft is sent across the boundary, which it has not crossed for long."},
    {K::kEntry, "entry", kInformation, kResearcher,
     "The place from which an aircraft enters is chosen."},
    {K::kAllocation, "allocation", kInformation, kResearcher,
     "The deployment is over: the strategy allocates."},
    {K::kSilent, "silent", kWarning, kOperator,
     "No report of an aircraft has come for a while."},
    {K::kOutlier, "outlier", kNotice, kResearcher,
     "Observations were all but impossible under the belief.", "value: how many so far"},
    {K::kTooLate, "too-late", kNotice, kResearcher, "Readings came too late to count.",
     "value: how many so far"},
    {K::kOverConfident, "over-confident", kWarning, kOperator,
     "Crossings lie outside the believed band far too often.",
     "value: share outside, from 0 to 1"},
    {K::kTrusted, "trusted", kInformation, kOperator,
     "Crossings lie inside the believed band again.",
     "value: share outside, from 0 to 1"},
    {K::kHandOver, "hand-over", kNotice, kResearcher,
     "Another method makes the belief from now on."},
});

}  // namespace

static_assert(in_order(kTaskRows));
constinit const EventGroup kTask = {EventSubject::kTask, "Tasks of single aircraft",
                                    kTaskRows};
static_assert(in_order(kMissionRows));
constinit const EventGroup kMission = {
    EventSubject::kMission, "Missions, and what stations do for them", kMissionRows};
static_assert(in_order(kZoneRows));
constinit const EventGroup kZone = {EventSubject::kZone, "No-fly zones", kZoneRows};
static_assert(in_order(kFireRows));
constinit const EventGroup kFire = {EventSubject::kFire,
                                    "What is believed of a perimeter", kFireRows};

}  // namespace skein::event_tables
