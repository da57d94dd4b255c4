// SPDX-License-Identifier: Apache-2.0
#include "skein/mixed/virtual_feeds.h"

#include <algorithm>
#include <utility>

#include "skein/mixed/obstacle_sweep.h"

namespace skein::mixed {
namespace {

constexpr double kFixSd = 1;  // of a position that is the truth [m]

// Whether something that happens `rate` times a second does so now.
bool is_due(Time now, double rate, Time& due) {
  if (now < due) return false;
  due = std::max(due + Time::from_seconds(1 / rate), now);
  return true;
}

}  // namespace

VirtualFeeds::VirtualFeeds(VirtualFeedOptions options) : options_(std::move(options)) {
  if (options_.fence) fence_.emplace(options_.zones);
}

void VirtualFeeds::set_zones(std::span<const Zone> zones) {
  options_.zones.assign(zones.begin(), zones.end());
  if (fence_) fence_->set_zones(zones);
}

void VirtualFeeds::hear(const LinkChange& change) {
  if (fence_) fence_->hear(change);
}

void VirtualFeeds::hear(const RequestAnswer& answer, Time now,
                        std::vector<VehicleEvent>& events) {
  if (fence_) fence_->hear(answer, now, events);
}

void VirtualFeeds::look(Time now) {
  fix_.reset();
  if (!options_.fix || !is_due(now, options_.fix->rate, fix_due_)) return;
  const Vehicle* source = options_.fix->source();
  if (source == nullptr || source->lost()) return;
  if (const VehicleState* truth = source->truth())
    fix_ = PositionFix{truth->p_N, truth->v_N, kFixSd};
}

void VirtualFeeds::step(const Surroundings& world, Time now, const VehicleMotion* motion,
                        bool on_ground, VehiclePort& port) {
  if (fix_) port.send(0, *fix_);
  if (!motion) return;
  if (fence_) fence_->step(now, -motion->p_N.z(), port);
  // Who stands has the ground on all sides.
  if (!options_.obstacles || on_ground ||
      !is_due(now, options_.obstacles->rate, obstacles_due_))
    return;
  const std::span<const Zone> zones = options_.zones;
  port.send(0,
            sweep(world.terrain, options_.obstacles->zones ? zones : zones.first(0),
                  motion->p_N, geo::yaw(motion->q_NB), now, options_.obstacles->range));
}

}  // namespace skein::mixed
