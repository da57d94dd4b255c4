// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "skein/data/team/task.h"
#include "skein/data/team/team_message.h"

namespace skein::reasoning {

/// A task as TeamTask::what carries it.
std::vector<std::uint8_t> packed(const TaskKind& task);

/// The word for the kind of a team's task; "nothing": it cannot be read.
std::string name_of_kind(const TeamTask& task);

/// What a task of a team has its executor fly; none: nothing, or what cannot be read.
std::optional<TaskKind> unpacked(const TeamTask& task);

}  // namespace skein::reasoning
