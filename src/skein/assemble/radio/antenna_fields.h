// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/assemble/radio/radio_parts.h"
#include "skein/scenario/fields.h"

namespace skein::assemble {

/// The keys of an antenna.
scenario::Fields<AntennaChoice> antenna_fields();

}  // namespace skein::assemble
