// SPDX-License-Identifier: Apache-2.0
#include "skein/data/team/task_text.h"

#include <fmt/format.h>

#include "skein/data/describe/words.h"

namespace skein {
namespace {

Error no_task(std::string message) {
  return {ErrorCode::kBadInput, "", std::move(message), ""};
}

}  // namespace

Result<TaskText> parse_task(std::string_view kind,
                            std::span<const std::string_view> words,
                            const TaskForms& forms) {
  const TaskForm* form = forms.find(kind);
  if (!form) return no_task(fmt::format("\"{}\" is no task.", kind));
  return form->parse(words);
}

Result<TaskText> parse_task(std::string_view line, const TaskForms& forms) {
  const auto words = words::split(line);
  if (words.empty()) return no_task("says no task.");
  return parse_task(words.front(), std::span(words).subspan(1), forms);
}

}  // namespace skein
