// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "skein/data/perimeter/object.h"

namespace skein::reasoning {

/// Remembers the objects that were seen, by oneself or others.
///
/// Each is tracked by a filter, per axis, whose velocity decays: people turn.
///
///   p' = p + v r,  v' = v e^(-dt/T),  r = T (1 - e^(-dt/T))
///   Q = n^2 [r^2/4  r/2; r/2  1],  n = a min(dt, T)
///
/// with a random acceleration of standard deviation a. How much it changes its motion,
/// how fast it may be and how long it is remembered unseen follow from its class: people
/// 10 minutes, animals and vehicles 5; structures stand and are never forgotten.
/// Reference: [Selecky18] section 5.2, temporal model of non-actual observations.
class ObjectMemory {
 public:
  /// Takes in a sighting. One older than the last is left out.
  void add(const ObjectSighting& sighting);

  /// Forgets what is too old at a time.
  void forget(Time now);

  /// What is believed of an object, as of its last sighting; none: not seen, or
  /// forgotten.
  std::optional<ObjectBelief> find(std::uint32_t object) const;

  std::size_t size() const { return objects_.size(); }

 private:
  struct Track {
    Time time;
    Vec2 position, velocity;
    double pp, pv, vv;  // covariance, the same on both axes
    ObjectClass what;
  };
  std::map<std::uint32_t, Track> objects_;
};

}  // namespace skein::reasoning
