// SPDX-License-Identifier: Apache-2.0
#include "app/serve/task_forms.h"

#include <nlohmann/json.hpp>

namespace skein::serve {

nlohmann::ordered_json task_forms(const TaskForms& forms) {
  auto all = nlohmann::ordered_json::array();
  for (const TaskForm& form : forms.all())
    if (form.page_form) all.push_back(form.page_form());
  return all;
}

}  // namespace skein::serve
