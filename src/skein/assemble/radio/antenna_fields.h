#pragma once

#include "skein/layer/communication/antenna/antenna_profile.h"
#include "skein/scenario/fields.h"

namespace skein::assemble {

/// The keys of an antenna.
scenario::Fields<communication::AntennaProfile> antenna_fields();

}  // namespace skein::assemble
