// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "skein/data/perimeter/object.h"
#include "skein/data/perimeter/observation.h"
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

  /// @param view      with all aircraft.
  /// @param physical  with those that exist in reality: physical objects notice no
  ///                  others.
  void advance(const ObjectView& view, const ObjectView& physical);

  /// What is remembered of the physical ones, for whoever is not there: until the next
  /// call.
  void remember(std::span<const VisibleObject> remembered);

  /// Records those that do not go on as was recorded of them last.
  void record(Time now, Recorder& recorder);

  /// What an entity's sensors may find, as of the last advance(). Whoever has a body in
  /// reality finds physical objects where they are, others where they are remembered.
  std::span<const VisibleObject> visible_to(const EntityReality& entity) const;

 private:
  std::vector<WorldObject>& objects_;
  bool any_physical_ = false;
  std::vector<VisibleObject> all_;
  std::vector<VisibleObject> physical_, virtual_;  // empty without physical ones
  std::vector<VisibleObject> remembered_;          // with the virtual ones
  std::vector<std::optional<ObjectMotion>> recorded_;
};

}  // namespace skein::simulation
