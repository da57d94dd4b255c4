// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "skein/base/result.h"
#include "skein/data/team/task.h"

namespace skein {

/// A task as a person writes it, before names have become numbers and files plans.
struct TaskText {
  TaskKind what = Loiter{};
  std::vector<std::string> others;  ///< names, in the order of the task's entities
  std::string file;                 ///< that the plan of a FlyPlan is read from
};

/// A task from its kind and what follows, by the description of its values:
///
/// - the kind as described, or without its first word: `fly_route`, `route`;
/// - NORTH,EAST: its place or, one after the other, its points;
/// - a number alone: its first number; else the name of a value, then the value, in the
///   unit of its description: `radius 120`, `laps 3`;
/// - the name of a switch alone turns it on, with `counter` or `no-` before it off;
/// - any other word: the name of an aircraft, or `station`;
/// - `file NAME`: a file with a plan.
///
/// Fails: kBadInput, saying what the kind takes.
Result<TaskText> parse_task(std::string_view kind,
                            std::span<const std::string_view> words);

/// A line for each kind of task: how it is written, and what it is. For help and docs.
std::vector<std::pair<std::string, std::string>> task_usage();

}  // namespace skein
