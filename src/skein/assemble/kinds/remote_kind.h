// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "skein/assemble/kinds/kinds_of.h"

namespace skein::assemble {

inline constexpr std::string_view kRemoteKind = "remote";

/// The row of vehicles whose agent is in another program too.
void add_remote_kind(Kinds<Vehicle, VehicleContext>& kinds);

}  // namespace skein::assemble
