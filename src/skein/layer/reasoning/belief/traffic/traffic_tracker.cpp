#include "skein/layer/reasoning/belief/traffic/traffic_tracker.h"

#include <Eigen/LU>

#include <algorithm>
#include <limits>

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
  const Mat3 covariance = m.p_covariance + place.sd * place.sd * Mat3::Identity();
  const Vec3 off = m.p_N - place.p_N;
  return off.dot(covariance.inverse() * off);
}

bool is_of_team(const TrafficMeasurement& m, std::span<const TeamPlace> team) {
  return std::ranges::any_of(
      team, [&](const TeamPlace& place) { return distance2(m, place) <= kGate2; });
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

void TrafficTracker::step(Time now, std::span<const TrafficMeasurement> measurements,
                          std::span<const TeamPlace> team) {
  for (const TrafficMeasurement& m : measurements)
    if (is_sound(m) && m.time <= now && m.time > now - kMemory && !is_of_team(m, team))
      take(m);
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
