// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/station/zone_server.h"

#include <fmt/format.h>

#include <algorithm>

namespace skein::reasoning {
namespace {

constexpr double kHeardWithin = 5;      // a report this old says that its link is up [s]
constexpr std::size_t kMaxAtOnce = 20;  // changes sent again to one aircraft in a step

bool has_shape(const Zone& zone) {
  const auto* ring = std::get_if<geo::Ring>(&zone.area);
  return !ring || !ring->empty();
}

}  // namespace

ZoneServer::ZoneServer(const ZoneServerOptions& options)
    : options_(options), known_(options.known) {
  for (const Zone& zone : options_.drawn) drawn_[zone.name] = zone;
  for (const EntityId id : options_.team) team_.push_back({.id = id});
  std::ranges::sort(team_, {}, &Listener::id);
}

void ZoneServer::step(const AgentInput& in, std::vector<Message>& changes,
                      AgentOutput& out) {
  const std::size_t before = changes_.size();
  for (const Message& message : in.inbox) take_report(message, in.now);
  for (const Command& command : in.commands)
    if (const auto* change = std::get_if<ZoneChange>(&command))
      issue(*change, in.now, out);
  for (std::size_t k = before; k < changes_.size(); ++k) {
    changes.emplace_back().content = changes_[k];
    changes.back().sent = in.now;
  }
  send_missing(in.now, out);
  report_when_known(in.now, out);
}

void ZoneServer::take_report(const Message& message, Time now) {
  const auto* report = std::get_if<AircraftReport>(&message.content);
  if (!report) return;
  const auto who = std::ranges::lower_bound(team_, message.from, {}, &Listener::id);
  if (who == team_.end() || who->id != message.from) return;
  who->knows = std::max(who->knows, report->zone_changes);
  who->heard = now;
  who->was_heard = true;
}

void ZoneServer::issue(ZoneChange change, Time now, AgentOutput& out) {
  Zone& zone = change.zone;
  const auto refuse = [&](const std::string& why) {
    out.events.push_back({now, EntityId{}, EventKind::kZoneRefused,
                          fmt::format("{}: {}", zone.name, why)});
  };
  if (zone.name.empty()) return refuse("a zone needs a name.");
  const auto known = drawn_.find(zone.name);
  const auto zones = known_.zones();
  const bool in_force = std::any_of(zones.begin(), zones.end(),
                                    [&](const Zone& z) { return z.name == zone.name; });
  if (change.on && !has_shape(zone)) {
    if (known == drawn_.end()) return refuse("no zone of this name has been drawn.");
    zone = known->second;
  }
  if (!change.on && !in_force) return refuse("no zone of this name is in force.");
  if (change.on) {
    if (auto* ring = std::get_if<geo::Ring>(&zone.area)) *ring = made_positive(*ring);
    if (const auto fault = error_in(zone)) return refuse(*fault);
    drawn_[zone.name] = zone;
  } else {
    zone = {.name = zone.name};
  }
  change.number = static_cast<std::uint32_t>(changes_.size()) + 1;
  known_.take(change);
  out.events.push_back({now, EntityId{},
                        change.on ? EventKind::kZoneOn : EventKind::kZoneOff,
                        fmt::format("change {}: {} is {}", change.number, zone.name,
                                    change.on ? "in force" : "taken back")});
  out.records.emplace_back(change);
  changes_.push_back(std::move(change));
  all_know_ = false;
  for (Listener& listener : team_) {
    out.outbox.push_back({EntityId{}, listener.id, 0, Time(), changes_.back()});
    listener.sent = now;
  }
}

void ZoneServer::send_missing(Time now, AgentOutput& out) {
  for (Listener& listener : team_) {
    if (listener.knows >= changes_.size()) continue;
    // A report since the last sending says that it has not been received.
    const bool heard = listener.was_heard && listener.heard > listener.sent;
    const double wait = heard ? options_.resend_after : options_.resend_slow;
    if ((now - listener.sent).seconds() < wait) continue;
    const std::size_t end = std::min(changes_.size(), listener.knows + kMaxAtOnce);
    for (std::size_t k = listener.knows; k < end; ++k)
      out.outbox.push_back({EntityId{}, listener.id, 0, Time(), changes_[k]});
    listener.sent = now;
  }
}

void ZoneServer::report_when_known(Time now, AgentOutput& out) {
  if (all_know_) return;
  std::size_t heard = 0;
  for (const Listener& listener : team_) {
    if (!listener.was_heard || (now - listener.heard).seconds() > kHeardWithin) continue;
    ++heard;
    if (listener.knows < changes_.size()) return;
  }
  if (heard == 0) return;
  all_know_ = true;
  out.events.push_back({now,
                        EntityId{},
                        EventKind::kZonesKnown,
                        fmt::format("change {}: acknowledged by all of the {} in contact",
                                    changes_.size(), heard),
                        {.value = static_cast<double>(changes_.size())}});
}

}  // namespace skein::reasoning
