// SPDX-License-Identifier: Apache-2.0
#include "skein/record/store/run_facts.h"

#include <cmath>

#include "skein/record/store/record_table.h"

namespace skein::record {
namespace {

constexpr std::int64_t kMaxTerrainSide = 10'000;  // points
constexpr float kMaxHeight = 1e6F;                // [m]

}  // namespace

Result<RunInfo> read_info(Sqlite& database) {
  RunInfo info;
  auto done = for_each_row(
      database, "SELECT name, value FROM meta",
      [&info](const Statement& row) {
        const std::string name = row.text(0), value = row.text(1);
        if (name == "version") info.version = value;
        if (name == "name") info.name = value;
        if (name == "start_utc") info.start_utc = value;
        if (name == "scenario") info.scenario_text = value;
        if (name == "seed") info.seed = std::strtoull(value.c_str(), nullptr, 10);
      },
      "table meta");
  if (!done) return done.error();
  return info;
}

Result<std::unique_ptr<TerrainRow>> read_terrain(Sqlite& database) {
  std::unique_ptr<TerrainRow> terrain;
  auto done = for_each_row_of(
      database, "terrain",
      "rows, columns, low_north_m, low_east_m, spacing_m, heights_msl_m", "LIMIT 1",
      [&terrain](const Statement& row) {
        const auto rows = static_cast<int>(row.whole(1, 1, kMaxTerrainSide));
        const auto columns = static_cast<int>(row.whole(2, 1, kMaxTerrainSide));
        const double spacing = row.real(5);
        if (!(spacing > 0)) row.refuse(5, "a distance above 0 m");
        std::vector<float> heights = float_blob(row, 6);
        if (heights.size() !=
            static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns))
          row.refuse(6, "a 32-bit float for each row and column");
        for (const float height : heights)
          if (!(std::abs(height) <= kMaxHeight)) row.refuse(6, "heights up to 1e6 m");
        terrain = std::make_unique<TerrainRow>(TerrainRow{
            rows, columns, Vec2(row.real(3), row.real(4)), spacing, std::move(heights)});
      });
  if (!done) return done.error();
  return terrain;
}

}  // namespace skein::record
