#include "layer/asset/test/allocations.h"

#include <cstdlib>
#include <new>

namespace {

std::size_t count = 0;

}  // namespace

// In a file of its own, so that no compiler sees through them and takes the pair of new
// and free for a mistake.
void* operator new(std::size_t size) {
  ++count;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace skein::asset {

std::size_t allocations() {
  return count;
}

}  // namespace skein::asset
