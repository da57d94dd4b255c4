// SPDX-License-Identifier: Apache-2.0
#include "skein/simulation/object_motions.h"

namespace skein::simulation {
namespace {

constexpr double kTolerance = 0.01;  // of recorded places [m]

}  // namespace

ObjectMotions::ObjectMotions(std::vector<WorldObject>& objects)
    : objects_(objects), recorded_(objects.size()) {
  for (const WorldObject& each : objects_) {
    all_.push_back({each.object.id, each.object.what, each.movement->position()});
    any_physical_ |= each.body.has_value();
  }
}

void ObjectMotions::advance(const ObjectView& view, const ObjectView& physical) {
  for (std::size_t k = 0; k < objects_.size(); ++k) {
    objects_[k].movement->advance(objects_[k].body ? physical : view);
    all_[k].position = objects_[k].movement->position();
  }
  if (!any_physical_) return;
  physical_.clear();
  virtual_.clear();
  for (std::size_t k = 0; k < objects_.size(); ++k)
    (objects_[k].body ? physical_ : virtual_).push_back(all_[k]);
}

void ObjectMotions::remember(std::span<const VisibleObject> remembered) {
  remembered_ = virtual_;
  remembered_.insert(remembered_.end(), remembered.begin(), remembered.end());
}

std::span<const VisibleObject> ObjectMotions::visible_to(
    const EntityReality& entity) const {
  const bool there = entity.presence == Reality::kPhysical;
  switch (entity.interaction) {
    case Reality::kNone:
      return {};
    case Reality::kVirtual:
      return any_physical_ ? virtual_ : all_;
    case Reality::kPhysical:
      return physical_;
    case Reality::kBoth:
      return there || !any_physical_ ? all_ : remembered_;
  }
  return {};
}

void ObjectMotions::record(Time now, Recorder& recorder) {
  for (std::size_t k = 0; k < objects_.size(); ++k) {
    std::optional<ObjectMotion>& last = recorded_[k];
    const MovingObject& movement = *objects_[k].movement;
    const ObjectMotion motion{now, all_[k].id, all_[k].position, movement.velocity()};
    if (last && last->velocity == motion.velocity &&
        (last->at(now) - motion.position).norm() < kTolerance)
      continue;
    last = motion;
    recorder.record(motion);
  }
}

}  // namespace skein::simulation
