#pragma once

#include <optional>
#include <span>
#include <vector>

#include "skein/data/object.h"
#include "skein/role/moving_object.h"
#include "skein/role/recorder.h"
#include "skein/simulation/world.h"

namespace skein::simulation {

/// The things on the ground of a run: moves them, shows them to sensors, and records how
/// they move.
class ObjectMotions {
 public:
  /// @param objects  of the world; kept as a reference.
  explicit ObjectMotions(std::vector<WorldObject>& objects);

  void advance(const ObjectView& view);

  /// Records those that do not go on as was recorded of them last.
  void record(Time now, Recorder& recorder);

  /// All, as of the last advance().
  std::span<const VisibleObject> visible() const { return visible_; }

 private:
  std::vector<WorldObject>& objects_;
  std::vector<VisibleObject> visible_;
  std::vector<std::optional<ObjectMotion>> recorded_;
};

}  // namespace skein::simulation
