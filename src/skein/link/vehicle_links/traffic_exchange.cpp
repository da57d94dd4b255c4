// SPDX-License-Identifier: Apache-2.0
#include "skein/link/vehicle_links/traffic_exchange.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace skein::vehicle_links {
namespace {

const Time kSilence = Time::from_seconds(10);  // then nobody counts on it any more

double apart(const TrafficState& a, const TrafficState& b) {
  return (geo::horizontal(a.p_N) - geo::horizontal(b.p_N)).norm();
}

}  // namespace

TrafficExchange::Id TrafficExchange::add(const std::string& name, bool is_simulated,
                                         const std::optional<TrafficOptions>& receives) {
  std::uint32_t address = icao_address(name);
  while (!addresses_.insert(address).second)
    address = address < 0xfffffe ? address + 1 : 0xf80000;
  Aircraft aircraft;
  aircraft.identity = {address, callsign(name), is_simulated};
  aircraft.receives = receives;
  aircraft_.push_back(std::move(aircraft));
  return static_cast<Id>(aircraft_.size() - 1);
}

void TrafficExchange::lost(Id who) {
  grid_.remove(who);
  aircraft_[who].state.reset();
}

void TrafficExchange::moved(Id who, const TrafficState& state, Time now) {
  if (!state.p_N.allFinite() || !state.v_N.allFinite()) return;
  Aircraft& aircraft = aircraft_[who];
  aircraft.state = state;
  aircraft.heard = now;
  const Vec2 place = geo::horizontal(state.p_N);
  if (aircraft.receives) grid_.put(who, place);
  std::optional<mavlink::AdsbVehicle> message;  // made once, if anybody is to have it
  grid_.visit_near(place, [&](Id other) {
    Aircraft& receiver = aircraft_[other];
    if (other == who || !takes(receiver, state, now)) return;
    if (!choose(receiver, who, now)) {
      ++receiver.counts.limited;
      return;
    }
    Time& due = receiver.pairs[who].due;
    if (now < due) {
      ++receiver.counts.limited;
      return;
    }
    // Late ones do not make the next ones late.
    const Time period = Time::from_seconds(1 / receiver.receives->rate);
    due = due == Time() ? now + period
                        : std::max(due + period, now + Time::from_ns(period.ns() / 2));
    ++receiver.counts.sent;
    if (!message) message = coded(aircraft.identity, state, now, frame_);
    sink_(other, *message);
  });
}

bool TrafficExchange::takes(const Aircraft& receiver, const TrafficState& state,
                            Time now) const {
  if (now - receiver.heard > kSilence) return false;
  if (state.line && receiver.state->line == state.line) return false;
  return apart(*receiver.state, state) <= receiver.receives->range;
}

// How far away one of the chosen is; infinite where it is out of range or silent.
double TrafficExchange::distance(const Aircraft& receiver, Id who, Time now) const {
  const Aircraft& other = aircraft_[who];
  if (!other.state || now - other.heard > kSilence)
    return std::numeric_limits<double>::infinity();
  const double d = apart(*receiver.state, *other.state);
  return d <= receiver.receives->range ? d : std::numeric_limits<double>::infinity();
}

// Whether it is among the nearest, which it may become in place of the farthest.
bool TrafficExchange::choose(Aircraft& receiver, Id who, Time now) {
  if (receiver.pairs.size() < aircraft_.size()) receiver.pairs.resize(aircraft_.size());
  if (receiver.pairs[who].chosen) return true;
  std::vector<Id>& chosen = receiver.chosen;
  if (chosen.size() < receiver.receives->max) {
    chosen.push_back(who);
  } else {
    double farthest = distance(receiver, who, now);
    auto least = chosen.end();
    for (auto each = chosen.begin(); each != chosen.end(); ++each) {
      const double d = distance(receiver, *each, now);
      if (d <= farthest) continue;
      farthest = d;
      least = each;
    }
    if (least == chosen.end()) return false;
    receiver.pairs[*least].chosen = false;
    *least = who;
  }
  receiver.pairs[who].chosen = true;
  return true;
}

}  // namespace skein::vehicle_links
