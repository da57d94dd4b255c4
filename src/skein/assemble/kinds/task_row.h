// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include "skein/assemble/kinds/task_kinds.h"
#include "skein/data/team/task_form_of.h"

// The body of TaskKinds::add(). Includes all of the JSON library: for source files that
// add rows.

namespace skein::assemble {

template <class T, class Make>
TaskKinds& TaskKinds::add(Make maker) {
  add_row(task_form_of<T>(),
          [maker = std::move(maker)](const TaskKind& task,
                                     const TaskContext& context) -> Made {
            // Its form has found nothing wrong with it: it is a T.
            auto made = maker(*task_as<T>(task), context);
            if constexpr (std::is_same_v<decltype(made), Made>)
              return made;
            else
              return std::unique_ptr<reasoning::TaskExecutor>(std::move(made));
          });
  return *this;
}

}  // namespace skein::assemble
