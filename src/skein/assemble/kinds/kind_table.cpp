// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/kinds/kind_registry.h"

namespace skein::assemble {

scenario::KindTable kind_table() {
  return KindRegistry().table();
}

}  // namespace skein::assemble
