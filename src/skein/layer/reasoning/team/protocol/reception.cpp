// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/protocol/reception.h"

#include <fmt/format.h>

#include <string>

namespace skein::reasoning {
namespace {

constexpr double kReportPeriods = 10;  // query periods between reports of one kind

}  // namespace

bool TeamReception::accept(MemberState& member, const TeamReceived& received) {
  // Of a team that is not known yet all senders count.
  const double query_period = member.times().query_period;
  const double period = follower_period(member.times(), member.contacts.all().size() + 1);
  const double silence = member.lost + period - query_period;
  const double absence = member.lost * period / query_period;
  const TeamVerdict verdict = member.contacts.take(
      received.from, received.to_all, received.message, member.now, {silence, absence});
  if (verdict == TeamVerdict::kRepeated || verdict == TeamVerdict::kLate) return false;
  if (verdict != TeamVerdict::kNew) refuse(member, received, verdict);
  return verdict == TeamVerdict::kNew;
}

// Whoever floods with bad messages does not flood the records.
void TeamReception::refuse(MemberState& member, const TeamReceived& received,
                           TeamVerdict verdict) {
  double& last = refused_.try_emplace({received.from, verdict}, -1e300).first->second;
  if (member.now - last < kReportPeriods * member.times().query_period) return;
  last = member.now;
  member.outbox.report(
      event_of(verdict),
      fmt::format("a {} of {} changes nothing.", kind_of(received.message.content),
                  received.from.value),
      {.other = received.from});
}

}  // namespace skein::reasoning
