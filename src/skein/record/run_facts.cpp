#include "skein/record/run_facts.h"

#include "skein/record/record_table.h"

namespace skein::record {

Result<RunInfo> read_info(Sqlite& database) {
  RunInfo info;
  auto done = for_each_row(database, "SELECT name, value FROM meta",
                           [&info](const Statement& row) {
                             const std::string name = row.text(0), value = row.text(1);
                             if (name == "version") info.version = value;
                             if (name == "name") info.name = value;
                             if (name == "start_utc") info.start_utc = value;
                             if (name == "scenario") info.scenario_text = value;
                             if (name == "seed")
                               info.seed = std::strtoull(value.c_str(), nullptr, 10);
                           });
  if (!done) return done.error();
  return info;
}

Result<std::unique_ptr<TerrainRow>> read_terrain(Sqlite& database) {
  std::unique_ptr<TerrainRow> terrain;
  auto done = for_each_row(
      database,
      "SELECT rows, columns, low_north_m, low_east_m, spacing_m, heights_msl_m"
      " FROM terrain LIMIT 1",
      [&terrain](const Statement& row) {
        terrain = std::make_unique<TerrainRow>(
            TerrainRow{static_cast<int>(row.integer(0)), static_cast<int>(row.integer(1)),
                       Vec2(row.real(2), row.real(3)), row.real(4), float_blob(row, 5)});
      });
  if (!done) return done.error();
  const bool fits =
      terrain && terrain->rows > 0 && terrain->columns > 0 &&
      terrain->heights.size() == static_cast<std::size_t>(terrain->rows) *
                                     static_cast<std::size_t>(terrain->columns);
  if (!fits) terrain.reset();
  return terrain;
}

}  // namespace skein::record
