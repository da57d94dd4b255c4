// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "skein/base/result.h"
#include "skein/data/command/command.h"
#include "skein/data/team/task_form.h"

namespace skein {

/// A command as a person writes it, in a terminal or a scenario:
///
///   zone on|off NAME ...                        see data/airspace/zone_command.h
///   task AIRCRAFT KIND ...                      see data/team/task_text.h
///   task AIRCRAFT pause|resume|cancel           the task that it has
///   task AIRCRAFT give AIRCRAFT                 what is left of it, to another
///   mission pause|resume|start|end [NAME]      without a name: all missions
///   pause      resume      step [N]      speed fast|real|FACTOR
///   fault AIRCRAFT PART     repair AIRCRAFT PART        such as: motor, sensor imu, link
///   wind SPEED FROM_DEGREES      on top of the scenario's; wind off
///   add AIRCRAFT            remove AIRCRAFT
///
/// Metres in the local frame, metres per second, seconds of the run.
///
/// Programs may write it as a JSON object instead, with its kind and the fields of its
/// description: {"kind": "speed", "factor": 10}.
///
/// @param line   any bytes: what is no text becomes U+FFFD (valid_text.h).
/// @param forms  of the kinds of tasks that there are.
/// Fails: kBadInput when the line is none of these; the message says what is wrong.
Result<Command> parse_command(std::string_view line,
                              const TaskForms& forms = message_task_forms());

}  // namespace skein
