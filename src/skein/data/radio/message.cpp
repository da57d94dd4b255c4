// SPDX-License-Identifier: Apache-2.0
#include "skein/data/radio/message.h"

#include <algorithm>

#include "skein/data/describe/wire.h"

namespace skein {

std::string_view kind_of(const MessageContent& content) {
  return std::visit([]<class T>(const T&) { return kind_of<T>(); }, content);
}

double silence_allowed(const AircraftReport& report, double least) {
  // Two of three may be lost.
  return std::max(least, 3 * report.next_in.value_or(0) + 1);
}

Urgency urgency_of(const MessageContent& content) {
  struct Judge {
    Urgency operator()(const FireReading&) { return Urgency::kReport; }
    Urgency operator()(const FireReport&) { return Urgency::kReport; }
    Urgency operator()(const AircraftReport&) { return Urgency::kReport; }
    Urgency operator()(const TeamPosition&) { return Urgency::kReport; }
    Urgency operator()(const ObjectSighting&) { return Urgency::kReport; }
    Urgency operator()(const PluginPayload&) { return Urgency::kReport; }
    Urgency operator()(const Heartbeat&) { return Urgency::kCommand; }
    Urgency operator()(const Task&) { return Urgency::kCommand; }
    Urgency operator()(const TaskChange&) { return Urgency::kCommand; }
    Urgency operator()(const FlightChange&) { return Urgency::kCommand; }
    Urgency operator()(const TaskReport&) { return Urgency::kCommand; }
    Urgency operator()(const ZoneChange&) { return Urgency::kCommand; }
    Urgency operator()(const TeamMessage&) { return Urgency::kCommand; }
    Urgency operator()(const PlanReport&) { return Urgency::kSafety; }
    Urgency operator()(const PlaceReport&) { return Urgency::kSafety; }
    Urgency operator()(const ConflictNotice&) { return Urgency::kSafety; }
    Urgency operator()(const Offers&) { return Urgency::kSafety; }
    Urgency operator()(const Acceptance&) { return Urgency::kSafety; }
    Urgency operator()(const Busy&) { return Urgency::kSafety; }
    Urgency operator()(const GroupInvitation&) { return Urgency::kSafety; }
    Urgency operator()(const GroupJoining&) { return Urgency::kSafety; }
    Urgency operator()(const GroupPlan&) { return Urgency::kSafety; }
    Urgency operator()(const GroupAcceptance&) { return Urgency::kSafety; }
    Urgency operator()(const YieldRequest&) { return Urgency::kSafety; }
    Urgency operator()(const YieldAnswer&) { return Urgency::kSafety; }
    Urgency operator()(const LandingReport&) { return Urgency::kSafety; }
  };
  return std::visit(Judge(), content);
}

std::size_t coded_size(const Message& message) {
  return wire::coded_size(message);
}

}  // namespace skein
