// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <variant>

#include "skein/record/figures/metrics.h"
#include "skein/record/figures/statistics.h"
#include "skein/record/store/rows.h"
#include "skein/record/store/sqlite.h"
#include "skein/record/store/summary.h"

namespace skein::record {

/// One ring of a stored perimeter: little-endian 32-bit floats, `kTruthFloats` or
/// `kBeliefFloats` of them per point (see docs/records.md).
inline constexpr std::size_t kTruthFloats = 2;   ///< north, east [m]
inline constexpr std::size_t kBeliefFloats = 9;  ///< the columns of a BoundaryPoint

/// Of the tables, in `PRAGMA user_version`. 3: energy reserves and the payload's tables;
/// 4: zones; 5: tables as values are described, commands; 6: planners, missions as
/// commands name them; 7: motions and beliefs of objects, missions, several phenomena;
/// 9: what is physical, and the memory of it; 10: alerts, bands, recommendations;
/// 11: allocations of teams, what their messages say, copies of messages to all; 12: why
/// messages are lost and how they went, radios and links; 13: paths ahead, reasons for
/// tasks; 14: how sure estimates are of their altitude; 15: tasks of
/// teams; 16: losses of separation; 17: numbers of events.
inline constexpr int kSchemaVersion = 17;

/// The statements that make the tables.
std::string run_schema();

/// The tables of one run, for writing. Write errors leave what was committed untouched.
class RunDatabase {
 public:
  /// Makes the file with all tables and `meta` filled in, committed.
  /// @param max_size  largest size of the file [bytes]; 0 = as large as the disk.
  /// Fails: kUnavailable when the place cannot be written.
  static Result<RunDatabase> create(const std::filesystem::path& file,
                                    const RunInfo& info, std::int64_t max_size);

  Result<void> begin();
  /// Ends the transaction, if one is open.
  Result<void> commit();

  /// Fails: Bug for a PerimeterRecord, which has no table of its own.
  Result<void> write(const Record& record);
  Result<void> write(const TaskRow& row);
  Result<void> write(const TerrainRow& row);
  Result<void> write(const MissionFigures& row);
  Result<void> write(const ForecastScore& row);
  Result<void> write_forecast(const ForecastRecord& record);
  Result<void> write_truth(Time time, std::uint32_t phenomenon, const geo::Region& truth);
  Result<void> write_belief(const PerimeterRecord& record);
  Result<void> write_metrics(Time time, const Believer& who,
                             const PerimeterMetrics& metrics);
  /// Writes the summary and merges the log into the file. Outside of transactions.
  Result<void> finish(const RunSummary& summary);

 private:
  explicit RunDatabase(Sqlite sqlite) : sqlite_(std::move(sqlite)) {}
  Result<void> prepare();
  Result<void> write_rings(const char* source, Time time, std::optional<double> made,
                           std::uint32_t phenomenon, const Believer& who,
                           const BoundaryEstimate& belief);
  template <class... More>
  Result<void> insert_metrics(Statement& statement, Time time, const Believer& who,
                              const PerimeterMetrics& metrics, const More&... more);
  template <class T>
  Result<void> write_described(Statement& statement, const T& value);
  template <class... Values>
  Result<void> insert(Statement& statement, const Values&... values) {
    if (statement.bind(values...).run() != 0) return sqlite_.error();
    return {};
  }

  Sqlite sqlite_;
  Statement meta_, task_, terrain_, perimeter_, metrics_, mission_metrics_,
      forecast_metrics_, summary_;
  std::array<Statement, std::variant_size_v<Record>> records_;  // by index
};

}  // namespace skein::record
