// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "skein/base/result.h"
#include "skein/data/team/task_form.h"

namespace skein {

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
/// @param forms  of the kinds that there are.
/// Fails: kBadInput, saying what the kind takes.
Result<TaskText> parse_task(std::string_view kind,
                            std::span<const std::string_view> words,
                            const TaskForms& forms = message_task_forms());

/// As parse_task(), of a whole line: "orbit 100,200 radius 80".
Result<TaskText> parse_task(std::string_view line, const TaskForms& forms);

}  // namespace skein
