// SPDX-License-Identifier: Apache-2.0
#include "skein/data/event/event_tables.h"

namespace skein::event_tables {
namespace {

using enum EventSeverity;
using enum EventAudience;
using K = EventKind;

constexpr auto kTeamRows = std::to_array<EventKindRow>({
    {K::kTeamSelected, "team-selected", kNotice, kOperator,
     "It leads the team from now on."},
    {K::kTeamFollowing, "team-following", kInformation, kOperator,
     "It follows another member.", "other: who leads"},
    {K::kTeamMasterLost, "team-master-lost", kWarning, kOperator,
     "Who leads has been silent for too long.", "other: who led"},
    {K::kTeamJoined, "team-joined", kInformation, kOperator, "A member follows it.",
     "other: who joins"},
    {K::kTeamFollowerLost, "team-follower-lost", kWarning, kOperator,
     "A member follows it no longer.", "other: which member"},
    {K::kTeamMerged, "team-merged", kNotice, kOperator, "Two teams have become one.",
     "other: who led the other team"},
    {K::kTeamSplit, "team-split", kNotice, kOperator,
     "A team splits its mission with another.", "other: who leads the other team"},
    {K::kTeamTookBack, "team-took-back", kNotice, kOperator,
     "It takes over tasks of a branch that is lost.", "other: who led the branch"},
    {K::kTeamGaveBack, "team-gave-back", kNotice, kOperator,
     "It gives back the tasks of a branch that is there again.",
     "other: who leads the branch"},
    {K::kTeamHandover, "team-handover", kInformation, kOperator,
     "Another member shall lead.", "other: who shall lead"},
    {K::kTeamRejected, "team-rejected", kNotice, kOperator, "No team has use for it."},
    {K::kTeamOrderUnanswered, "team-order-unanswered", kWarning, kIntegrator,
     "A member has not acknowledged its order.", "other: which member"},
    {K::kTeamOrderExpired, "team-order-expired", kNotice, kIntegrator,
     "Who leads now has given no order; the old one is dropped."},
    {K::kTeamOrderSuperseded, "team-order-superseded", kNotice, kIntegrator,
     "A newer order gives its task to another member.", "other: who executes it"},
    {K::kTeamTaskTwice, "team-task-twice", kWarning, kOperator,
     "Another member executes the same task.", "other: who; team_task: its number"},
    {K::kTeamTaskYielded, "team-task-yielded", kNotice, kOperator,
     "It drops a task that another member executes.", "other: who executes it"},
    {K::kTeamProposed, "team-proposed", kInformation, kOperator,
     "It proposes an allocation to the station of the operator."},
    {K::kAllocationProposed, "allocation-proposed", kNotice, kOperator,
     "An allocation of a team waits for approval.",
     "other: who proposes it; value: its number", kAnnounced},
    {K::kAllocationOver, "allocation-over", kNotice, kOperator,
     "An allocation that waited is approved, rejected or withdrawn.",
     "other: who proposed it; value: its number", kAnnounced},
    {K::kTeamTask, "team-task", kInformation, kOperator, "It flies a task of its team.",
     "team_task: its number, of a task for one aircraft"},
    {K::kTeamTaskOver, "team-task-over", kInformation, kOperator,
     "It flies the task of its team no longer.",
     "team_task: its number, of a task for one aircraft"},
    {K::kTeamTaskAdded, "team-task-added", kInformation, kOperator,
     "A task is added to those of a team.", "team_task: its number"},
    {K::kTeamTaskWithdrawn, "team-task-withdrawn", kNotice, kOperator,
     "A task of a team is withdrawn.", "team_task: its number"},
});

constexpr auto kProtocolRows = std::to_array<EventKindRow>({
    {K::kTeamOwnId, "team-own-id", kWarning, kIntegrator,
     "Somebody sends in its own name.", "other: the sender"},
    {K::kTeamDuplicateId, "team-duplicate-id", kWarning, kIntegrator,
     "Two members have one id; the first counts.", "other: the sender"},
    {K::kTeamOtherVersion, "team-other-version", kWarning, kIntegrator,
     "A member speaks another version of the protocol.", "other: the sender"},
    {K::kTeamUnknownSender, "team-unknown-sender", kWarning, kIntegrator,
     "Somebody unknown sends.", "other: the sender"},
    {K::kTeamImplausible, "team-implausible", kWarning, kIntegrator,
     "A message makes no sense.", "other: the sender"},
    {K::kTeamOrderRefused, "team-order-refused", kWarning, kIntegrator,
     "An order comes from somebody who does not lead.", "other: the sender"},
    {K::kTeamAnswerRefused, "team-answer-refused", kWarning, kIntegrator,
     "An answer comes to nothing that was asked.", "other: the sender"},
});

}  // namespace

static_assert(in_order(kTeamRows));
constinit const EventGroup kTeam = {EventSubject::kTeam, "Teams that lead themselves",
                                    kTeamRows};
static_assert(in_order(kProtocolRows));
constinit const EventGroup kProtocol = {
    EventSubject::kProtocol, "Messages of teams that are refused", kProtocolRows};

}  // namespace skein::event_tables
