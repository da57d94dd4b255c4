// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/belief/traffic/traffic_tracker.h"

#include <Eigen/LU>

#include <algorithm>

#include "skein/base/math.h"

namespace skein::reasoning {
namespace {

// Of three dimensions, as seldom passed as 3 standard deviations of one, squared.
constexpr double kGate2 = 14.16;
// An address is believed further off: its aircraft turns and climbs, its source lags.
constexpr double kAddressGate2 = 100;
constexpr double kAddressReach = 100;  // or so far [m]
const Time kMemory = Time::from_seconds(10);

// By how many standard deviations, squared, a place of the team is off.
double distance2(const TrafficMeasurement& m, const TeamPlace& place) {
  const double sd = place.sd_at(m.time);
  const Mat3 covariance = m.p_covariance + sd * sd * Mat3::Identity();
  const Vec3 off = m.p_N - place.at(m.time);
  return off.dot(covariance.inverse() * off);
}

// Whether a measurement can be one of a member; without addresses it may be another's.
bool can_be_member(const TrafficMeasurement& m, const TeamPlace& place) {
  if (m.address && place.address)
    return m.address == place.address &&
           ((m.p_N - place.at(m.time)).norm() <= kAddressReach ||
            distance2(m, place) <= kAddressGate2);
  return distance2(m, place) <= kGate2;
}

// Two aircraft at least gave these two measurements.
bool of_one_look(const TrafficMeasurement& a, const TrafficMeasurement& b) {
  return a.source == b.source && a.time == b.time &&
         !(a.address && a.address == b.address);
}

// Which measurements are of the team. A member explains one of each look of a source.
std::vector<bool> of_team(std::span<const TrafficMeasurement> all,
                          std::span<const TeamPlace> team) {
  std::vector<bool> owned(all.size(), false);
  std::vector<std::size_t> near;
  for (const TeamPlace& place : team) {
    near.clear();
    for (std::size_t k = 0; k < all.size(); ++k)
      if (!owned[k] && can_be_member(all[k], place)) near.push_back(k);
    const auto nearer = [&](std::size_t a, std::size_t b) {
      return of_one_look(all[a], all[b]) &&
             distance2(all[a], place) < distance2(all[b], place);
    };
    for (const std::size_t k : near)
      owned[k] = std::ranges::none_of(
          near, [&](std::size_t other) { return other != k && nearer(other, k); });
  }
  return owned;
}

std::optional<Time>& heard(TrafficTrack& track, TrafficSource source) {
  return track.heard[static_cast<std::size_t>(source)];
}

// Whether a source has said something of this time or a later one about a track.
bool is_old(TrafficTrack& track, const TrafficMeasurement& m) {
  const auto& last = heard(track, m.source);
  return last && *last >= m.time;
}

bool can_be(const TrafficTrack& track, const TrafficMeasurement& m) {
  const double off = (m.p_N - track.filter.at(m.time).p_N).norm();
  return off <= kAddressReach || track.filter.distance2(m) <= kAddressGate2;
}

}  // namespace

double TeamPlace::sd_at(Time now) const {
  constexpr double kManoeuvre = 2;  // standard deviation of an acceleration [m/s^2]
  // Nothing is said of its motion: it is where it is said to be.
  if (v_N.isZero()) return sd;
  const double age = (now - time).seconds();
  return math::hypot(sd, kManoeuvre * age * age / 2);
}

void TrafficTracker::step(Time now, std::span<const TrafficMeasurement> measurements,
                          std::span<const TeamPlace> team) {
  sound_.clear();
  for (const TrafficMeasurement& m : measurements)
    if (is_sound(m) && m.time <= now && m.time > now - kMemory) sound_.push_back(m);
  const std::vector<bool> owned = of_team(sound_, team);
  for (std::size_t k = 0; k < sound_.size(); ++k)
    if (!owned[k]) take(sound_[k]);
  std::erase_if(tracks_, [&](const TrafficTrack& track) {
    return track.filter.time() <= now - kMemory;
  });
}

TrafficTrack* TrafficTracker::find(const TrafficMeasurement& m) {
  if (m.address)
    for (TrafficTrack& track : tracks_)
      if (track.address == m.address && can_be(track, m)) return &track;
  TrafficTrack* nearest = nullptr;
  double least = kGate2;
  for (TrafficTrack& track : tracks_) {
    if (is_old(track, m) || (m.address && track.address)) continue;
    const double distance = track.filter.distance2(m);
    if (distance > least) continue;
    least = distance;
    nearest = &track;
  }
  return nearest;
}

void TrafficTracker::take(const TrafficMeasurement& m) {
  TrafficTrack* track = find(m);
  if (!track) {
    if (tracks_.size() >= kMaxTracks)
      tracks_.erase(std::ranges::min_element(
          tracks_, {}, [](const TrafficTrack& each) { return each.filter.time(); }));
    tracks_.push_back({++last_number_, m.address, TrackFilter(m), 1});
    heard(tracks_.back(), m.source) = m.time;
    return;
  }
  if (is_old(*track, m)) return;
  track->filter.update(m);
  ++track->updates;
  if (m.address) track->address = m.address;
  heard(*track, m.source) = m.time;
}

}  // namespace skein::reasoning
