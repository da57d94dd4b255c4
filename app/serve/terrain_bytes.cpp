// SPDX-License-Identifier: Apache-2.0
#include "app/serve/terrain_bytes.h"

#include <cstdint>
#include <cstring>

namespace skein::serve {
namespace {

template <class T>
void put_raw(std::string& out, const T& value) {
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  out.append(bytes, sizeof value);
}

}  // namespace

std::string terrain_bytes(const assemble::TerrainPatch& patch) {
  std::string bytes;
  put_raw(bytes, static_cast<std::uint32_t>(patch.rows));
  put_raw(bytes, static_cast<std::uint32_t>(patch.rows));
  put_raw(bytes, patch.low.x());
  put_raw(bytes, patch.low.y());
  put_raw(bytes, patch.spacing);
  for (const float height : patch.heights) put_raw(bytes, height);
  return bytes;
}

assemble::TerrainPatch patch_of(const record::TerrainRow* stored) {
  assemble::TerrainPatch patch;
  if (!stored || stored->rows != stored->columns) return patch;
  patch.rows = stored->rows;
  patch.low = stored->low;
  patch.spacing = stored->spacing;
  patch.heights = stored->heights;
  return patch;
}

}  // namespace skein::serve
