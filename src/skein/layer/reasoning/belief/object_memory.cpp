#include "skein/layer/reasoning/belief/object_memory.h"

#include <algorithm>
#include <cmath>

#include "skein/base/check.h"
#include "skein/base/math.h"

namespace skein::reasoning {
namespace {

constexpr double kMinSd = 0.5;  // of a sighting: no camera is perfect [m]

// How fast what is known of a class of objects grows old.
struct RateOfChange {
  double acceleration;  // standard deviation per axis [m/s^2]
  double first_speed;   // the same of the velocity when first seen [m/s]
  double forgotten;     // unseen for so long [s]
};

RateOfChange rate_of_change(ObjectClass what) {
  switch (what) {
    case ObjectClass::kPerson:
      return {0.7, 2, 600};
    case ObjectClass::kAnimal:
      return {1.5, 4, 300};
    case ObjectClass::kVehicle:
      return {1.5, 10, 300};
    case ObjectClass::kStructure:
      return {0, 0, math::kInfinity};
  }
  SKEIN_CHECK(false, static_cast<int>(what));
  return {};
}

}  // namespace

void ObjectMemory::add(const ObjectSighting& sighting) {
  const double sd = std::max(sighting.position_sd, kMinSd), r = sd * sd;
  const RateOfChange rate = rate_of_change(sighting.what);
  const auto [at, first] = objects_.try_emplace(
      sighting.object, Track{sighting.time, sighting.position, Vec2::Zero(), r, 0,
                             rate.first_speed * rate.first_speed, sighting.what});
  if (first) return;
  Track& t = at->second;
  const double dt = (sighting.time - t.time).seconds();
  if (dt < 0) return;
  const double q = rate.acceleration * rate.acceleration;
  t.position += dt * t.velocity;
  t.pp += 2 * dt * t.pv + dt * dt * t.vv + q * dt * dt * dt * dt / 4;
  t.pv += dt * t.vv + q * dt * dt * dt / 2;
  t.vv += q * dt * dt;
  t.time = sighting.time;
  const double s = t.pp + r;
  const double gain_p = t.pp / s, gain_v = t.pv / s;
  const Vec2 innovation = sighting.position - t.position;
  t.position += gain_p * innovation;
  t.velocity += gain_v * innovation;
  t.vv -= gain_v * t.pv;
  t.pv *= 1 - gain_p;
  t.pp *= 1 - gain_p;
}

void ObjectMemory::forget(Time now) {
  std::erase_if(objects_, [&](const auto& entry) {
    return (now - entry.second.time).seconds() >
           rate_of_change(entry.second.what).forgotten;
  });
}

std::optional<ObjectBelief> ObjectMemory::find(std::uint32_t object) const {
  const auto found = objects_.find(object);
  if (found == objects_.end()) return std::nullopt;
  const Track& t = found->second;
  return ObjectBelief{object,     t.time,          t.position,
                      t.velocity, std::sqrt(t.pp), std::sqrt(t.vv)};
}

}  // namespace skein::reasoning
