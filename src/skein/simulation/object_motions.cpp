#include "skein/simulation/object_motions.h"

namespace skein::simulation {
namespace {

constexpr double kTolerance = 0.01;  // of recorded places [m]

}  // namespace

ObjectMotions::ObjectMotions(std::vector<WorldObject>& objects)
    : objects_(objects), recorded_(objects.size()) {
  for (const WorldObject& each : objects_)
    visible_.push_back({each.object.id, each.object.what, each.movement->position()});
}

void ObjectMotions::advance(const ObjectView& view) {
  for (std::size_t k = 0; k < objects_.size(); ++k) {
    objects_[k].movement->advance(view);
    visible_[k].position = objects_[k].movement->position();
  }
}

void ObjectMotions::record(Time now, Recorder& recorder) {
  for (std::size_t k = 0; k < objects_.size(); ++k) {
    std::optional<ObjectMotion>& last = recorded_[k];
    const MovingObject& movement = *objects_[k].movement;
    const ObjectMotion motion{now, visible_[k].id, visible_[k].position,
                              movement.velocity()};
    if (last && last->velocity == motion.velocity &&
        (last->at(now) - motion.position).norm() < kTolerance)
      continue;
    last = motion;
    recorder.record(motion);
  }
}

}  // namespace skein::simulation
