// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/station/flight_changes.h"

#include <utility>

namespace skein::reasoning {
namespace {

constexpr double kFlightResendAfter = 3;  // what is not confirmed [s]

}  // namespace

void FlightChanges::order(EntityId aircraft, const FlightChange& change, Time now,
                          AgentOutput& out) {
  Order& order = orders_[aircraft];
  ++order.change.number;
  if (change.altitude_agl) order.change.altitude_agl = change.altitude_agl;
  if (change.airspeed) order.change.airspeed = change.airspeed;
  order.confirmed = false;
  send(aircraft, order, now, out);
}

void FlightChanges::confirm(EntityId aircraft, const FlightChange& flown) {
  const auto order = orders_.find(aircraft);
  if (order == orders_.end() || order->second.change.number != flown.number) return;
  // With the next only that is said.
  order->second.change = {flown.number};
  order->second.confirmed = true;
}

void FlightChanges::resend(Time now, AgentOutput& out) {
  for (auto& [aircraft, order] : orders_)
    if (!order.confirmed && (now - order.sent).seconds() >= kFlightResendAfter)
      send(aircraft, order, now, out);
}

void FlightChanges::send(EntityId aircraft, Order& order, Time now, AgentOutput& out) {
  order.sent = now;
  Message message;
  message.to = aircraft;
  message.content = order.change;
  out.outbox.push_back(std::move(message));
}

}  // namespace skein::reasoning
