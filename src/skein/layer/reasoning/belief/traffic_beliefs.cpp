// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/belief/traffic_beliefs.h"

#include <algorithm>
#include <cmath>

#include "skein/base/math.h"

namespace skein::reasoning {
namespace {

constexpr double kRecordEvery = 1;                // [s]
const Time kOwnMemory = Time::from_seconds(10);   // of where it was itself
const Time kTeamMemory = Time::from_seconds(10);  // older reports explain nothing
const Time kOfLate = Time::from_seconds(10);      // a source has said something
constexpr double kHeadingSd = geo::radians(2);    // of the own one [rad]
constexpr double kAltitudeSd = 5;                 // of the own one [m]
constexpr double kTeamSd =
    5;  // of a member that says that it knows its place exactly [m]

template <class... Handlers>
struct Either : Handlers... {
  using Handlers::operator()...;
};
template <class... Handlers>
Either(Handlers...) -> Either<Handlers...>;

double with_heading(double sd) {
  return math::hypot(sd, kHeadingSd);
}

// A range and a bearing with their deviations; the tracker looks at the rest.
template <class Sample>
bool says_something(const Sample& sample) {
  return sample.range > 0 && sample.range_sd > 0 && sample.bearing_sd > 0;
}

// Where it was itself is not known exactly either.
void add_own(TrafficMeasurement& m, const NavEstimate& own) {
  const double horizontal = own.position_sd * own.position_sd;
  m.p_covariance += Vec3(horizontal, horizontal, kAltitudeSd * kAltitudeSd).asDiagonal();
}

}  // namespace

NavEstimate TrafficBeliefs::own_at(Time time) const {
  const auto after = std::ranges::lower_bound(own_, time, {}, &NavEstimate::time);
  NavEstimate own = after == own_.end() ? own_.back() : *after;
  const double ago = (own.time - time).seconds();
  own.p_N -= ago * own.v_N;
  if (after != own_.end() && after != own_.begin()) {
    const NavEstimate& before = *std::prev(after);
    const double step = (own.time - before.time).seconds();
    const double turn = geo::wrap_pi(own.heading - before.heading);
    own.heading -= turn * ago / step;
  }
  own.time = time;
  return own;
}

TrafficMeasurement TrafficBeliefs::measured(const TrafficBroadcast& heard) const {
  TrafficMeasurement m;
  m.time = heard.time;
  m.source = TrafficSource::kBroadcast;
  m.address = heard.address;
  m.p_N = heard.p_N;
  const double horizontal = heard.position_sd * heard.position_sd;
  m.p_covariance =
      Vec3(horizontal, horizontal, heard.altitude_sd * heard.altitude_sd).asDiagonal();
  m.v_N = heard.v_N;
  m.v_sd = heard.velocity_sd;
  return m;
}

TrafficMeasurement TrafficBeliefs::measured(const RadarPlot& plot) const {
  const NavEstimate own = own_at(plot.time);
  TrafficMeasurement m =
      from_polar(plot.time, TrafficSource::kRadar, own.p_N,
                 {plot.range, plot.range_sd, own.heading + plot.bearing,
                  with_heading(plot.bearing_sd), plot.elevation, plot.elevation_sd});
  add_own(m, own);
  return m;
}

TrafficMeasurement TrafficBeliefs::measured(const TransponderContact& contact) const {
  const NavEstimate own = own_at(contact.time);
  TrafficMeasurement m =
      from_coarse(contact.time, own.p_N, contact.range, contact.range_sd,
                  own.heading + contact.bearing, with_heading(contact.bearing_sd),
                  contact.height, contact.height_sd);
  add_own(m, own);
  return m;
}

void TrafficBeliefs::step(const AgentInput& in, const TeamMemory& team,
                          AgentOutput& out) {
  if (!listens_) own_.clear();
  if (own_.empty() || own_.back().time < in.nav->time) own_.push_back(*in.nav);
  while (own_.front().time < in.nav->time - kOwnMemory) own_.pop_front();
  measurements_.clear();
  const Either take{
      [&](const TrafficBroadcast& s) { measurements_.push_back(measured(s)); },
      [&](const RadarPlot& s) {
        if (says_something(s)) measurements_.push_back(measured(s));
      },
      [&](const TransponderContact& s) {
        if (says_something(s)) measurements_.push_back(measured(s));
      },
      [](const auto&) {}};
  for (const SensorSample& sample : in.samples) std::visit(take, sample);
  listens_ |= !measurements_.empty();
  if (measurements_.empty() && tracker_.tracks().empty()) return;
  team_.clear();
  for (const auto& [id, nav] : team.members())
    if (nav.time > in.now - kTeamMemory)
      team_.push_back({nav.p_N, std::max(nav.position_sd, kTeamSd), nav.v_N, nav.time,
                       team_address(id)});
  tracker_.step(in.now, measurements_, team_);
  record(in.now, out);
}

void TrafficBeliefs::record(Time now, AgentOutput& out) {
  if (now < next_record_) return;
  next_record_ = std::max(next_record_ + Time::from_seconds(kRecordEvery), now);
  for (const TrafficTrack& track : tracker_.tracks())
    out.records.emplace_back(belief_at(now, track));
}

TrafficBelief belief_at(Time now, const TrafficTrack& track) {
  const TrafficState state = track.filter.at(now);
  const auto heard = [&](TrafficSource source) {
    const auto& last = track.heard[static_cast<std::size_t>(source)];
    return last && *last > now - kOfLate;
  };
  TrafficBelief belief;
  belief.track = track.number;
  belief.address = track.address;
  belief.position = state.p_N;
  belief.velocity = state.v_N;
  belief.horizontal_sd = state.horizontal_sd();
  belief.vertical_sd = state.vertical_sd();
  belief.velocity_sd = std::sqrt(std::max(0.0, state.vv.diagonal().maxCoeff()));
  belief.updates = static_cast<std::uint32_t>(track.updates);
  belief.firm = is_firm(track);
  belief.by_broadcast = heard(TrafficSource::kBroadcast);
  belief.by_radar = heard(TrafficSource::kRadar);
  belief.by_passive = heard(TrafficSource::kPassive);
  belief.measured = track.filter.time();
  return belief;
}

}  // namespace skein::reasoning
