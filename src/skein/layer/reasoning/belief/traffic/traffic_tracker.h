// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "skein/base/id.h"
#include "skein/layer/reasoning/belief/traffic/track_filter.h"

namespace skein::reasoning {

/// Another aircraft that does not belong to the team, as it is followed.
struct TrafficTrack {
  std::uint32_t number = 0;                   ///< never used again
  std::optional<std::uint32_t> address = {};  ///< that it sends itself
  TrackFilter filter;
  int updates = 0;
  /// Of the newest measurement of each source.
  std::array<std::optional<Time>, kTrafficSources> heard = {};
};

/// Where somebody of the own team is believed to be.
struct TeamPlace {
  Vec3 p_N = Vec3::Zero();                    ///< [m]
  double sd = 0;                              ///< of each axis, at that time [m]
  Vec3 v_N = Vec3::Zero();                    ///< [m/s]
  Time time = {};                             ///< of p_N
  std::optional<std::uint32_t> address = {};  ///< that it sends, if that is known

  /// Where it is believed to be at a time, if it flies on evenly.
  Vec3 at(Time now) const { return p_N + (now - time).seconds() * v_N; }
  /// How well that is known: it may have turned since [m].
  double sd_at(Time now) const;
};

/// Follows the aircraft around that do not belong to the team.
///
/// A measurement belongs to the track with its address; one without, or with one that is
/// new, to the track that it is nearest to, no further off than 3 in 1000 true ones are,
/// that has no other address and no measurement of the same source and time.
/// Else it begins a track.
///
/// Measurements of the own team are left out: one with the address of a member, if it is
/// not far from where that one is; of those without an address, for each member and look
/// of a source the nearest, if it is where the member is. An address that no member has
/// is an intruder's, however near to one it flies. A member of which no address is known
/// takes all that is where it is.
///
/// A track is firm from its third measurement on, and forgotten 10 s after its last.
///
/// An address whose place has jumped further than the aircraft can have flown is a new
/// track: the old one goes on until it is forgotten.
///
/// Cost: the measurements of a step times the tracks.
class TrafficTracker {
 public:
  static constexpr int kFirm = 3;                  ///< measurements
  static constexpr std::size_t kMaxTracks = 2000;  ///< those heard last are kept

  /// Takes in measurements, of which unsound ones and those older than a source's last
  /// of the same track are left out, and forgets what has not been heard for long.
  void step(Time now, std::span<const TrafficMeasurement> measurements,
            std::span<const TeamPlace> team);

  std::span<const TrafficTrack> tracks() const { return tracks_; }

 private:
  void take(const TrafficMeasurement& measurement);
  TrafficTrack* find(const TrafficMeasurement& measurement);

  std::vector<TrafficTrack> tracks_;       // by number
  std::vector<TrafficMeasurement> sound_;  // of one step
  std::uint32_t last_number_ = 0;
};

/// Whether a track may be acted on.
inline bool is_firm(const TrafficTrack& track) {
  return track.updates >= TrafficTracker::kFirm;
}

}  // namespace skein::reasoning
