// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "skein/base/result.h"
#include "skein/data/command/command.h"
#include "skein/data/team/task_form.h"
#include "skein/geo/local_frame.h"

namespace skein::assemble {

/// A command as a person writes it (data/command/command_text.h), with what it names
/// loaded: the plan of a file, which is looked for from the working folder.
///
/// @param forms  of the kinds of tasks that there are.
Result<Command> read_command(std::string_view line, const geo::LocalFrame& frame,
                             const TaskForms& forms);

}  // namespace skein::assemble
