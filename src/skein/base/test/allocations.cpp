// SPDX-License-Identifier: Apache-2.0
#include "skein/base/test/allocations.h"

#include <atomic>
#include <cstdlib>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)

std::optional<long> skein::allocations() {
  return std::nullopt;
}

#else

namespace {
std::atomic<long> count = 0;
}  // namespace

// NOLINTBEGIN(bugprone-reserved-identifier, readability-identifier-naming)
extern "C" void* __libc_malloc(std::size_t size);
extern "C" void* malloc(std::size_t size) {
  ++count;
  return __libc_malloc(size);
}
// NOLINTEND(bugprone-reserved-identifier, readability-identifier-naming)

std::optional<long> skein::allocations() {
  return count;
}

#endif
