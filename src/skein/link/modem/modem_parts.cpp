// SPDX-License-Identifier: Apache-2.0
#include "skein/link/modem/modem_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace skein::modem {
namespace {

bool is_message_report(const VehicleReport& report) {
  const auto* said = std::get_if<EntityReport>(&report);
  return said && std::holds_alternative<Message>(said->said);
}

EventKind event_of(const NeighbourChange& change) {
  return change.found ? EventKind::kNeighbourFound : EventKind::kNeighbourLost;
}

EventKind event_of(AlertKind kind) {
  switch (kind) {
    case AlertKind::kSameAddress:
      return EventKind::kModemClash;
    case AlertKind::kRefused:
      return EventKind::kModemRefused;
    case AlertKind::kDoubted:
      return EventKind::kModemDoubted;
    case AlertKind::kNoLine:
      return EventKind::kModemClosed;
    case AlertKind::kLineOpen:
      break;
  }
  return EventKind::kModemOpen;
}

// Of an alert; `whose` modem it is.
std::string text_of(const ModemAlert& alert, const char* whose) {
  if (alert.kind == AlertKind::kSameAddress)
    return fmt::format("another modem has the address of {}, hw {}", whose, alert.hw);
  if (alert.kind == AlertKind::kNoLine)
    return fmt::format("no line to {} is open, hw {}", whose, alert.hw);
  if (alert.kind == AlertKind::kLineOpen)
    return fmt::format("a line to {} is open, hw {}", whose, alert.hw);
  return fmt::format("without a valid seal of the team's key, at {}; {} since the last",
                     whose, alert.count);
}

}  // namespace

void ModemPort::receive(Time now, std::vector<VehicleReport>& out) {
  const auto begin = static_cast<std::ptrdiff_t>(out.size());
  port_->receive(now, out);
  out.erase(std::remove_if(out.begin() + begin, out.end(), is_message_report), out.end());
  for (Heard& heard : link_.take(now, self_)) {
    if (auto* message = std::get_if<Message>(&heard)) {
      out.emplace_back(EntityReport{std::move(*message)});
      continue;
    }
    if (const auto* alert = std::get_if<ModemAlert>(&heard)) {
      out.emplace_back(
          OutsideEvent{event_of(alert->kind), text_of(*alert, "the ground station's")});
      continue;
    }
    const auto& change = std::get<NeighbourChange>(heard);
    out.emplace_back(
        OutsideEvent{event_of(change), fmt::format("by the modem, hw {}", change.hw)});
  }
}

void ModemPort::send(Time now, EntityInput input) {
  if (const auto* message = std::get_if<Message>(&input))
    link_.send(now, *message);
  else
    port_->send(now, std::move(input));
}

void ModemRadio::send(const Message& message) {
  const bool from_beyond = link_.is_beyond(message.from);
  if (parts_.inject && !from_beyond) {
    if (!message.copy || candidates_.empty()) candidates_.push_back({message});
    candidates_.back().goes_out |= link_.is_beyond(message.to);
  }
  if (parts_.by_range && from_beyond)
    parts_.by_range->send(message);
  else
    parts_.medium->send(message);
}

void ModemRadio::inject(Time now) {
  for (const Candidate& each : candidates_)
    if (!each.goes_out) link_.inject(now, each.message);
  candidates_.clear();
}

void ModemRadio::deliver(Time now, RadioNews& news) {
  if (parts_.inject) inject(now);
  link_.flush();
  parts_.medium->deliver(now, news);
  if (parts_.by_range) parts_.by_range->deliver(now, news);
}

void ModemRadio::end(RadioNews& news) {
  parts_.medium->end(news);
  if (parts_.by_range) parts_.by_range->end(news);
}

void AgentModemRadio::deliver(Time now, RadioNews& news) {
  link_.flush();
  for (Heard& heard : link_.take(now)) {
    if (auto* message = std::get_if<Message>(&heard)) {
      news.ended.push_back({std::move(*message)});
      continue;
    }
    if (const auto* alert = std::get_if<ModemAlert>(&heard)) {
      news.events.push_back(
          {now, self_, event_of(alert->kind), text_of(*alert, "its own")});
      continue;
    }
    const auto& change = std::get<NeighbourChange>(heard);
    news.events.push_back({now,
                           self_,
                           event_of(change),
                           names_.at(change.who.value),
                           {.other = change.who}});
  }
}

RadioStatus AgentModemRadio::status(EntityId) const {
  const ModemStatistics modem = link_.statistics();
  return {modem.load, static_cast<std::uint32_t>(modem.waiting), link_.rate() > 0};
}

}  // namespace skein::modem
