// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "skein/assemble/world/build.h"
#include "skein/record/store/rows.h"

namespace skein::serve {

/// The ground as /api/terrain answers it (docs/live-feed.md).
std::string terrain_bytes(const assemble::TerrainPatch& patch);

/// The ground as a run has stored it; without rows where it has not, or not as a square.
assemble::TerrainPatch patch_of(const record::TerrainRow* stored);

}  // namespace skein::serve
