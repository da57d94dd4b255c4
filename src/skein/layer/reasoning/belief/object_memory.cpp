#include "skein/layer/reasoning/belief/object_memory.h"

#include <algorithm>
#include <cmath>

namespace skein::reasoning {
namespace {

constexpr double kAcceleration = 0.7;  // of people and vehicles on foot paths [m/s^2]
constexpr double kFirstSpeed = 2;   // standard deviation per axis when first seen [m/s]
constexpr double kMinSd = 0.5;      // of a sighting: no camera is perfect [m]
constexpr double kForgotten = 600;  // unseen for so long [s]

}  // namespace

void ObjectMemory::add(const ObjectSighting& sighting) {
  const double sd = std::max(sighting.position_sd, kMinSd), r = sd * sd;
  const auto [at, first] = objects_.try_emplace(
      sighting.object, Track{sighting.time, sighting.position, Vec2::Zero(), r, 0,
                             kFirstSpeed * kFirstSpeed});
  if (first) return;
  Track& t = at->second;
  const double dt = (sighting.time - t.time).seconds();
  if (dt < 0) return;
  const double q = kAcceleration * kAcceleration;
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
    return (now - entry.second.time).seconds() > kForgotten;
  });
}

std::optional<ObjectBelief> ObjectMemory::find(std::uint32_t object) const {
  const auto found = objects_.find(object);
  if (found == objects_.end()) return std::nullopt;
  const Track& t = found->second;
  return ObjectBelief{t.time, t.position, t.velocity, std::sqrt(t.pp), std::sqrt(t.vv)};
}

Vec2 position_at(const ObjectBelief& object, Time time) {
  return object.position + (time - object.time).seconds() * object.velocity;
}

}  // namespace skein::reasoning
