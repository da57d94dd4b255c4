// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace skein::serve {

/// The memory of this program that lies in the machine's, as the system counts it
/// [bytes]; 0 where it does not say.
std::uint64_t resident_bytes();

}  // namespace skein::serve
