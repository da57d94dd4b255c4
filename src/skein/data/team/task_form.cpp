// SPDX-License-Identifier: Apache-2.0
#include "skein/data/team/task_form.h"

#include <fmt/format.h>

#include "skein/data/team/task_form_of.h"

namespace skein {

std::string_view short_kind(std::string_view kind) {
  for (const std::string_view first : {"fly_", "follow_"})
    if (kind.starts_with(first) && kind != "fly_to") return kind.substr(first.size());
  return kind;
}

const TaskForm* TaskForms::find(std::string_view kind) const {
  for (const TaskForm& form : all_)
    if (kind == form.kind) return &form;
  for (const TaskForm& form : all_)
    if (kind == short_kind(form.kind)) return &form;
  return nullptr;
}

std::string TaskForms::error(const TaskKind& task) const {
  if (!std::holds_alternative<NamedTask>(task)) return task_error(task);
  const std::string_view kind = kind_of(task);
  const TaskForm* form = find(kind);
  return form ? form->error(task) : fmt::format("there is no task \"{}\".", kind);
}

const TaskForms& message_task_forms() {
  static const TaskForms kForms = [] {
    TaskForms forms;
    type_traits::for_each_alternative(static_cast<const TaskKind*>(nullptr),
                                      [&]<class T>() {
                                        if constexpr (!std::is_same_v<T, NamedTask>)
                                          forms.add(task_form_of<T>());
                                      });
    return forms;
  }();
  return kForms;
}

}  // namespace skein
