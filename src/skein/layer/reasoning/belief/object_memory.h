#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "skein/data/object.h"

namespace skein::reasoning {

/// What is believed of an object on the ground.
struct ObjectBelief {
  Time time;                     ///< of the last sighting
  Vec2 position = Vec2::Zero();  ///< then [m]
  Vec2 velocity = Vec2::Zero();  ///< [m/s]
  double position_sd = 0;        ///< per axis, then [m]
  double velocity_sd = 0;        ///< per axis [m/s]
};

/// Remembers the objects that were seen, by oneself or others.
///
/// Each is tracked by a filter of constant velocity, per axis
///
///   p' = p + v dt,   Q = a^2 [dt^4/4 dt^3/2; dt^3/2 dt^2]
///
/// with a random acceleration of standard deviation a. An object that has not been seen
/// for the age of its class is forgotten (mixed-reality spec, section 3).
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
  };
  std::map<std::uint32_t, Track> objects_;
};

/// Where an object is believed to be at a time, going on as it did [m].
Vec2 position_at(const ObjectBelief& object, Time time);

}  // namespace skein::reasoning
