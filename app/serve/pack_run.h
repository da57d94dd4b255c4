// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "skein/base/result.h"

namespace skein::serve {

/// A stored run for a page without a server: what a server would answer to it, and what
/// it would tell it, thinned so that it fits into a file.
///
/// Messages are those of the live feed (docs/live-feed.md), with the truth. Each stands
/// behind its time [s] and its length: a 64-bit float and a 32-bit unsigned integer,
/// little-endian.
struct PackedRun {
  std::string description;  ///< JSON, as /api/run has it; an origin that is null: unknown
  std::string terrain;      ///< as /api/terrain has it; empty: none was stored
  std::vector<std::byte> records;  ///< messages of records
  std::vector<std::byte> frames;   ///< messages of a fleet frame and a truth frame each
  double step = 0;  ///< at most, between frames, or tracks of other aircraft [s]
};

/// Packs the run in a directory.
///
/// Aircraft have a place every second, in long runs and for many aircraft more rarely.
///
/// @param share  of the room of a file, above 0, up to 1: several runs share one.
/// @returns      no messages when the run has neither positions nor perimeters.
/// Fails:        as record::RecordStream::open().
Result<PackedRun> pack_run(const std::filesystem::path& directory, double share);

/// The same, compressed, as JSON for the map of a report (`MapData` of
/// web/report/data.ts); empty when there is nothing to be seen on a map.
Result<std::string> report_map(const std::filesystem::path& directory, double share);

}  // namespace skein::serve
