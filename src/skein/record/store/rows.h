// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <variant>
#include <vector>

#include "skein/data/event/record.h"

// What a run database has besides records.

namespace skein::record {

/// The order that a message carried: a table of its own, beside that of messages.
struct TaskRow {
  Time sent, arrived;
  EntityId from, to;
  Task task;
  bool lost = false;
};

constexpr auto describe(const TaskRow*) {
  using T = TaskRow;
  return described<T>(
      {"task", "tasks"}, "An order sent to an aircraft.", field("sent", &T::sent, "when"),
      field("arrived", &T::arrived, "when; or when it was lost"),
      field("from_id", &T::from, "who ordered"),
      field("entity_id", &T::to, "who shall do it"), field("", &T::task, "what to do"),
      field("lost", &T::lost, "it never arrived"));
}

/// The ground, for the map of a report.
struct TerrainRow {
  int rows = 0, columns = 0;
  Vec2 low = Vec2::Zero();
  double spacing = 0;
  std::vector<float> heights;
};

/// One thing to be stored.
using Row = std::variant<Record, std::unique_ptr<TerrainRow>>;

}  // namespace skein::record
