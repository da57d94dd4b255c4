// SPDX-License-Identifier: Apache-2.0
#include "skein/data/event/event_tables.h"

namespace skein::event_tables {
namespace {

using enum EventSeverity;
using enum EventAudience;
using K = EventKind;

constexpr auto kTrafficRows = std::to_array<EventKindRow>({
    {K::kTrafficAlert, "traffic-alert", kWarning, kPilot,
     "An alert about another aircraft rises.", "value: its level", kAnnounced},
    {K::kClearOfTraffic, "clear-of-traffic", kInformation, kPilot,
     "The last alert about another aircraft is over.", "", kAnnounced},
    {K::kRecommended, "recommended", kNotice, kPilot,
     "A path is recommended to the pilot.", "", kAnnounced},
    {K::kSeparationLost, "separation-lost", kWarning, kOperator,
     "Two aircraft are nearer to each other than is required; announced where one of "
     "both keeps apart.",
     "other: the second; value: horizontal distance [m]; threshold: that is required [m]",
     kAnnounced},
    {K::kSeparationRestored, "separation-restored", kNotice, kOperator,
     "Two aircraft are as far from each other again as is required.",
     "other: the second; value: least distance [m]"},
    {K::kSeparationNotRestored, "separation-not-restored", kWarning, kOperator,
     "A loss of separation lasts until the end of the run, or of one of both.",
     "other: the second; value: least distance [m]"},
});

constexpr auto kRadioRows = std::to_array<EventKindRow>({
    {K::kNeighbourFound, "neighbour-found", kInformation, kIntegrator,
     "It receives another node.", "other: which, inside a run"},
    {K::kNeighbourLost, "neighbour-lost", kNotice, kIntegrator,
     "It has not received another node for long.", "other: which, inside a run"},
    {K::kMessageRefused, "message-refused", kWarning, kOperator,
     "It refuses a message that is not authentic.", "other: in whose name"},
    {K::kMessageDoubted, "message-doubted", kWarning, kOperator,
     "It accepts a message that is not authentic.", "other: in whose name"},
    {K::kAttackBegins, "attack-begins", kWarning, kOperator,
     "An attacker of the radio begins."},
    {K::kAttackEnds, "attack-ends", kNotice, kOperator, "An attacker of the radio ends."},
    {K::kModemClash, "modem-clash", kWarning, kIntegrator,
     "Another modem has the same address."},
    {K::kModemRefused, "modem-refused", kWarning, kIntegrator,
     "A modem refuses a datagram without a valid seal."},
    {K::kModemDoubted, "modem-doubted", kWarning, kIntegrator,
     "A modem accepts a datagram without a valid seal."},
    {K::kModemClosed, "modem-closed", kWarning, kIntegrator,
     "The line to a modem cannot be opened, or is lost."},
    {K::kModemOpen, "modem-open", kInformation, kIntegrator,
     "The line to a modem is open again."},
});

}  // namespace

static_assert(in_order(kTrafficRows));
constinit const EventGroup kTraffic = {EventSubject::kTraffic, "Other aircraft",
                                       kTrafficRows};
static_assert(in_order(kRadioRows));
constinit const EventGroup kRadio = {EventSubject::kRadio, "Radio, attackers and modems",
                                     kRadioRows};

}  // namespace skein::event_tables
