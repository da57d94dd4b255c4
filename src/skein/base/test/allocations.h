// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

namespace skein {

/// How often this test program has asked for memory so far, by malloc or new. None under
/// a sanitizer, which has a malloc of its own. Counts when its source is among the TESTS
/// of a module.
std::optional<long> allocations();

}  // namespace skein
