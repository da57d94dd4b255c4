// SPDX-License-Identifier: Apache-2.0
#include "skein/data/command/command.h"

namespace skein {

std::string_view kind_of(const Command& command) {
  return std::visit([]<class T>(const T&) { return kind_of<T>(); }, command);
}

}  // namespace skein
