// SPDX-License-Identifier: Apache-2.0
#include "skein/data/event/event_kind.h"

#include <algorithm>
#include <unordered_map>

#include "skein/base/check.h"
#include "skein/data/event/event_tables.h"

namespace skein {
namespace {

// What kinds were called in databases of earlier versions.
constexpr std::pair<std::string_view, EventKind> kFormerNames[] = {
    {"arming-denied", EventKind::kTakeOffDenied}};

const EventGroup& group_of(EventKind kind) {
  // Groups follow one another, as their kinds do.
  const auto groups = event_groups();
  const auto after = std::ranges::upper_bound(
      groups, kind, {}, [](const EventGroup& group) { return group.rows.front().kind; });
  return *std::prev(after);
}

std::unordered_map<std::string_view, EventKind> kinds_by_name() {
  std::unordered_map<std::string_view, EventKind> kinds(std::begin(kFormerNames),
                                                        std::end(kFormerNames));
  for (const EventGroup& group : event_groups())
    for (const EventKindRow& row : group.rows) kinds.emplace(row.name, row.kind);
  return kinds;
}

}  // namespace

std::span<const EventGroup> event_groups() {
  using namespace event_tables;  // NOLINT: the tables are ours
  static const EventGroup kGroups[] = {kFlight,  kGuidance, kTask,     kMission, kZone,
                                       kFire,    kTeam,     kProtocol, kTraffic, kRadio,
                                       kVehicle, kProgram,  kMemory,   kPlugin};
  return kGroups;
}

const EventKindRow& row_of(EventKind kind) {
  const auto rows = group_of(kind).rows;
  const auto at =
      static_cast<std::size_t>(kind) - static_cast<std::size_t>(rows.front().kind);
  SKEIN_CHECK(at < rows.size(), at);
  return rows[at];
}

EventSubject subject_of(EventKind kind) {
  return group_of(kind).subject;
}

EventLabel EventLabel::named(std::string_view name) {
  static const std::unordered_map<std::string_view, EventKind> kKinds = kinds_by_name();
  const auto found = kKinds.find(name);
  if (found != kKinds.end()) return found->second;
  EventLabel own(EventKind::kPlugin);
  own.own_ = name;
  return own;
}

}  // namespace skein
