// SPDX-License-Identifier: Apache-2.0
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
  double persistence;   // time constant of the velocity [s]
  double forgotten;     // unseen for so long [s]
};

RateOfChange rate_of_change(ObjectClass what) {
  switch (what) {
    case ObjectClass::kPerson:
      return {0.7, 2, 30, 600};
    case ObjectClass::kAnimal:
      return {1.5, 4, 20, 300};
    case ObjectClass::kVehicle:
      return {1.5, 10, 30, 300};
    case ObjectClass::kStructure:
      return {0, 0, 1, math::kInfinity};
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
  const double decay = math::exp(-dt / rate.persistence);
  const double reach = rate.persistence * (1 - decay);  // of a velocity of 1
  t.position += reach * t.velocity;
  t.velocity *= decay;
  const double noise = rate.acceleration * std::min(dt, rate.persistence);
  const double step = noise * reach / 2;
  t.pp += 2 * reach * t.pv + reach * reach * t.vv + step * step;
  t.pv = decay * (t.pv + reach * t.vv) + step * noise;
  t.vv = decay * decay * t.vv + noise * noise;
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
  return ObjectBelief{object,
                      t.time,
                      t.position,
                      t.velocity,
                      std::sqrt(t.pp),
                      std::sqrt(t.vv),
                      rate_of_change(t.what).persistence};
}

}  // namespace skein::reasoning
