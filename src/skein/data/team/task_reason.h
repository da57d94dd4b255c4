// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/base/id.h"
#include "skein/data/describe/describe.h"
#include "skein/data/describe/named_value.h"

namespace skein {

/// Why an aircraft was given the task that it has: the terms that have decided.
struct TaskReason {
  EntityId aircraft;
  std::vector<NamedValue> terms;
};

constexpr auto describe(const TaskReason*) {
  using T = TaskReason;
  return described<T>({"task_reason"}, "Why an aircraft was given the task that it has.",
                      field("aircraft_id", &T::aircraft, "who was given it"),
                      field("terms", &T::terms, Storage::kCoded, "that have decided"));
}

}  // namespace skein
