// SPDX-License-Identifier: Apache-2.0
#include "app/serve/resident_memory.h"

#include <unistd.h>

#include <fstream>

namespace skein::serve {

// Of proc(5): pages in all, then those that are resident.
std::uint64_t resident_bytes() {
  std::ifstream statm("/proc/self/statm");
  std::uint64_t all = 0, resident = 0;
  if (!(statm >> all >> resident)) return 0;
  return resident * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

}  // namespace skein::serve
