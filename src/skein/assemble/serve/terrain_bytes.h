#pragma once

#include <string>

#include "skein/assemble/build.h"
#include "skein/record/rows.h"

namespace skein::assemble {

/// The ground as /api/terrain answers it (docs/live-feed.md).
std::string terrain_bytes(const TerrainPatch& patch);

/// The ground as a run has stored it; without rows where it has not, or not as a square.
TerrainPatch patch_of(const record::TerrainRow* stored);

}  // namespace skein::assemble
