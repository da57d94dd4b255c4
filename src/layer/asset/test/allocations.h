#pragma once

#include <cstddef>

namespace skein::asset {

/// How often this program has asked for memory so far.
std::size_t allocations();

}  // namespace skein::asset
