// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "skein/base/id.h"
#include "skein/base/result.h"
#include "skein/data/event/record.h"
#include "skein/role/recorder.h"

namespace skein::simulation {

/// What whoever holds a run may ask of its records: the newest beliefs, and the events
/// since the last look. Hands all records on.
class RunView final : public Recorder {
 public:
  /// @param next  outlives it.
  explicit RunView(Recorder& next) : next_(next) {}

  void record(const Record& record) override;
  Result<void> step_done(Time time) override { return next_.step_done(time); }

  /// Events since the last call, in the order in which they were recorded.
  std::vector<Event> take_events() { return std::exchange(events_, {}); }

  /// The newest of each mission and phenomenon that a station believes something of.
  std::vector<PerimeterRecord> perimeters(EntityId station) const;

  /// The newest of each mission and object that a station believes something of.
  std::vector<ObjectBeliefRecord> objects(EntityId station) const;

  /// The tracks that an aircraft recorded last, all of one time.
  std::vector<TrafficBeliefRecord> traffic(EntityId aircraft) const;

 private:
  // Whose mission's belief about which phenomenon or object.
  using Subject = std::tuple<EntityId, std::string, std::uint32_t>;

  Recorder& next_;
  std::vector<Event> events_;
  std::map<Subject, PerimeterRecord> perimeters_;
  std::map<Subject, ObjectBeliefRecord> objects_;
  std::map<EntityId, std::vector<TrafficBeliefRecord>> traffic_;
};

}  // namespace skein::simulation
