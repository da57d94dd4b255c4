// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/kinds/task_kinds.h"

#include <utility>

namespace skein::assemble {

void TaskKinds::add_row(TaskForm form, MakeRow make) {
  auto forms = std::make_shared<TaskForms>(*forms_);
  forms->add(std::move(form));
  forms_ = std::move(forms);
  makers_.push_back(std::move(make));
}

TaskKinds::Made TaskKinds::make(const TaskKind& task, const TaskContext& context) const {
  if (std::string error = forms_->error(task); !error.empty())
    return Error{ErrorCode::kBadInput, "", std::move(error), ""};
  const TaskForm* form = forms_->find(kind_of(task));
  if (!form) return Error{ErrorCode::kBadInput, "", "nothing here flies such tasks.", ""};
  return makers_[static_cast<std::size_t>(form - forms_->all().data())](task, context);
}

void TaskKinds::append(const TaskKinds& more) {
  for (std::size_t k = 0; k < more.makers_.size(); ++k)
    add_row(more.forms_->all()[k], more.makers_[k]);
}

void TaskKinds::describe(scenario::KindTable& table) const {
  for (const TaskForm& form : forms_->all()) table.add("task", form.kind, form.help);
}

}  // namespace skein::assemble
