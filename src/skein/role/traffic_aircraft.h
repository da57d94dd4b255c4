// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "skein/base/id.h"
#include "skein/base/time.h"
#include "skein/data/traffic/traffic.h"
#include "skein/geo/vec.h"

namespace skein {

/// An aircraft that takes part, as other traffic may notice it.
struct NoticedAircraft {
  EntityId id;
  Vec3 p_N = Vec3::Zero();  ///< true place [m]
  Vec3 v_N = Vec3::Zero();  ///< over ground [m/s]
};

/// What the pilot of other traffic may notice.
struct TrafficView {
  Time now;  ///< since it has come
  std::span<const NoticedAircraft> aircraft = {};
};

/// Where other traffic is, and how it flies.
struct TrafficState {
  Vec3 p_N = Vec3::Zero();  ///< [m]
  Vec3 v_N = Vec3::Zero();  ///< over ground [m/s]
  TrafficPhase phase = TrafficPhase::kFlies;
};

/// How one aircraft flies that belongs to nobody who takes part.
class TrafficAircraft {
 public:
  virtual ~TrafficAircraft() = default;

  /// Flies on to `view.now`, which never goes back. Called for time 0 first, then once in
  /// each step of the run.
  virtual void advance(const TrafficView& view) = 0;

  /// As of the last advance(). Finite always; while it is there its place goes on as its
  /// velocity says, but for TrafficPhase::kJumped.
  virtual TrafficState state() const = 0;
};

}  // namespace skein
