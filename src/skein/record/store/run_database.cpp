// SPDX-License-Identifier: Apache-2.0
#include "skein/record/store/run_database.h"

#include <bit>
#include <cmath>

#include "skein/data/describe/columns.h"
#include "skein/record/store/sql_row.h"

namespace skein::record {
namespace {

static_assert(std::endian::native == std::endian::little,
              "blobs are documented as little-endian");

// What is not described: docs/records.md explains the columns.
constexpr const char* kOtherTables = R"sql(
CREATE TABLE meta (name TEXT PRIMARY KEY, value) WITHOUT ROWID;
CREATE TABLE perimeters (time_s REAL, source TEXT, phenomenon INTEGER,
  believer_id INTEGER, mission TEXT, ring INTEGER, points INTEGER, data BLOB,
  made_s REAL);
CREATE TABLE mission_metrics (time_s REAL, station_id INTEGER, mission TEXT,
  figure TEXT, value REAL);
CREATE TABLE terrain (rows INTEGER, columns INTEGER, low_north_m REAL, low_east_m REAL,
  spacing_m REAL, heights_msl_m BLOB);
CREATE TABLE summary (name TEXT PRIMARY KEY, value) WITHOUT ROWID;
)sql";

constexpr std::int64_t kPageBytes = 4096;

std::string values(std::size_t count) {
  std::string list = " VALUES (?";
  for (std::size_t i = 1; i < count; ++i) list += ",?";
  return list + ")";
}

std::string metrics_schema() {
  std::string columns;
  for (const MetricField& field : metric_fields())
    columns += ", " + std::string(field.name) + std::string(field.unit) + " REAL";
  const std::string whose = " (time_s REAL, believer_id INTEGER, mission TEXT";
  return "CREATE TABLE metrics" + whose + columns + ");CREATE TABLE forecast_metrics" +
         whose + columns + ", made_s REAL);";
}

// What is said of a kind that has a table.
template <Described T>
std::string create_table() {
  std::string sql;
  for (const columns::Column& column : columns::columns_of<T>())
    sql += (sql.empty() ? "" : ", ") + column.name + " " + std::string(column.type);
  return "CREATE TABLE " + std::string(kDescription<T>.name.table) + " (" + sql + ");";
}

std::span<const std::byte> bytes(const std::vector<float>& floats) {
  return std::as_bytes(std::span(floats));
}

}  // namespace

std::string run_schema() {
  std::string sql = kOtherTables + create_table<TaskRow>();
  type_traits::for_each_alternative(static_cast<const Record*>(nullptr), [&]<class T>() {
    if constexpr (!kDescription<T>.name.table.empty()) sql += create_table<T>();
  });
  return sql + metrics_schema();
}

Result<RunDatabase> RunDatabase::create(const std::filesystem::path& file,
                                        const RunInfo& info, std::int64_t max_size) {
  Result<Sqlite> opened = Sqlite::open(file, Sqlite::Mode::kCreate);
  if (!opened) return opened.error();
  RunDatabase database(std::move(opened).value());

  // NORMAL: the log is synced at checkpoints only. A killed process loses nothing that
  // was committed; a power cut may lose the last commits but never breaks the file.
  std::string pragmas = "PRAGMA page_size=" + std::to_string(kPageBytes) +
                        "; PRAGMA journal_mode=WAL; PRAGMA synchronous=NORMAL;"
                        "PRAGMA wal_autocheckpoint=4000; PRAGMA user_version=" +
                        std::to_string(kSchemaVersion) + ";";
  if (max_size > 0)
    pragmas += "PRAGMA max_page_count=" + std::to_string(max_size / kPageBytes) + ";";
  for (const std::string& sql : {pragmas, "BEGIN;" + run_schema()})
    if (const auto done = database.sqlite_.execute(sql); !done) return done.error();
  if (const auto done = database.prepare(); !done) return done.error();

  const auto meta = [&](const char* name, const auto& value) {
    return database.insert(database.meta_, name, value);
  };
  // SQLite's integers are signed; as text every seed is exact.
  for (const Result<void>& done :
       {meta("version", info.version), meta("seed", std::to_string(info.seed)),
        meta("name", info.name), meta("start_utc", info.start_utc),
        meta("scenario", info.scenario_text), database.commit()})
    if (!done) return done.error();
  return database;
}

Result<void> RunDatabase::prepare() {
  Result<void> all;
  const auto prepare_one = [&](Statement& statement, const std::string& table,
                               std::size_t columns) {
    auto prepared = sqlite_.prepare("INSERT INTO " + table + values(columns));
    if (prepared)
      statement = std::move(prepared).value();
    else
      all = prepared.error();
  };
  prepare_one(meta_, "meta", 2);
  prepare_one(terrain_, "terrain", 6);
  prepare_one(perimeter_, "perimeters", 9);
  prepare_one(mission_metrics_, "mission_metrics", 5);
  prepare_one(metrics_, "metrics", 3 + metric_fields().size());
  prepare_one(forecast_metrics_, "forecast_metrics", 4 + metric_fields().size());
  prepare_one(summary_, "summary", 2);
  prepare_one(task_, "tasks", columns::columns_of<TaskRow>().size());
  std::size_t k = 0;
  type_traits::for_each_alternative(static_cast<const Record*>(nullptr), [&]<class T>() {
    Statement& statement = records_[k++];
    if constexpr (!kDescription<T>.name.table.empty())
      prepare_one(statement, std::string(kDescription<T>.name.table),
                  columns::columns_of<T>().size());
  });
  return all;
}

Result<void> RunDatabase::begin() {
  return sqlite_.execute("BEGIN");
}

Result<void> RunDatabase::commit() {
  if (!sqlite_.in_transaction()) return {};
  return sqlite_.execute("COMMIT");
}

template <class T>
Result<void> RunDatabase::write_described(Statement& statement, const T& value) {
  RowSink sink(statement);
  columns::put(value, sink);
  if (statement.run() != 0) return sqlite_.error();
  return {};
}

Result<void> RunDatabase::write(const Record& record) {
  Statement& statement = records_[record.index()];
  return std::visit(
      [&]<class T>(const T& value) {
        SKEIN_CHECK(!kDescription<T>.name.table.empty(), kind_of<T>());
        return write_described(statement, value);
      },
      record);
}

Result<void> RunDatabase::write(const TaskRow& row) {
  return write_described(task_, row);
}

Result<void> RunDatabase::write(const TerrainRow& row) {
  return insert(terrain_, row.rows, row.columns, row.low.x(), row.low.y(), row.spacing,
                bytes(row.heights));
}

Result<void> RunDatabase::write(const MissionFigures& row) {
  for (const MissionFigure& figure : row.figures) {
    auto done = insert(mission_metrics_, row.time.seconds(), row.station.value,
                       row.mission, std::string(figure.name), figure.value);
    if (!done) return done;
  }
  return {};
}

Result<void> RunDatabase::write_truth(Time time, std::uint32_t phenomenon,
                                      const geo::Region& truth) {
  std::vector<float> floats;
  for (std::size_t r = 0; r < truth.size(); ++r) {
    floats.clear();
    columns::put_floats(truth[r], floats);
    auto done =
        insert(perimeter_, time.seconds(), "truth", phenomenon, nullptr, nullptr,
               static_cast<std::int64_t>(r), static_cast<std::int64_t>(truth[r].size()),
               bytes(floats), nullptr);
    if (!done) return done;
  }
  return {};
}

Result<void> RunDatabase::write_belief(const PerimeterRecord& record) {
  return write_rings("belief", record.time, std::nullopt, record.phenomenon,
                     {record.believer, record.mission}, record.belief);
}

Result<void> RunDatabase::write_forecast(const ForecastRecord& record) {
  const PerimeterForecast& forecast = record.forecast;
  return write_rings("forecast", forecast.boundary.time, forecast.made.seconds(),
                     forecast.phenomenon, {record.believer, forecast.mission},
                     forecast.boundary);
}

Result<void> RunDatabase::write_rings(const char* source, Time time,
                                      std::optional<double> made,
                                      std::uint32_t phenomenon, const Believer& who,
                                      const BoundaryEstimate& belief) {
  std::vector<float> floats;
  for (std::size_t r = 0; r < belief.rings.size(); ++r) {
    floats.clear();
    columns::put_floats(belief.rings[r], floats);
    auto done =
        insert(perimeter_, time.seconds(), source, phenomenon, who.station.value,
               who.mission, static_cast<std::int64_t>(r),
               static_cast<std::int64_t>(belief.rings[r].size()), bytes(floats), made);
    if (!done) return done;
  }
  return {};
}

template <class... More>
Result<void> RunDatabase::insert_metrics(Statement& statement, Time time,
                                         const Believer& who,
                                         const PerimeterMetrics& metrics,
                                         const More&... more) {
  constexpr std::size_t kFieldCount = 13;
  const auto fields = metric_fields();
  SKEIN_CHECK(fields.size() == kFieldCount, fields.size());
  return [&]<std::size_t... I>(std::index_sequence<I...>) {
    return insert(statement, time.seconds(), who.station.value, who.mission,
                  metrics.*fields[I].value..., more...);
  }
  (std::make_index_sequence<kFieldCount>());
}

Result<void> RunDatabase::write_metrics(Time time, const Believer& who,
                                        const PerimeterMetrics& metrics) {
  return insert_metrics(metrics_, time, who, metrics);
}

Result<void> RunDatabase::write(const ForecastScore& row) {
  return insert_metrics(forecast_metrics_, row.time, row.who, row.metrics,
                        row.made.seconds());
}

Result<void> RunDatabase::finish(const RunSummary& summary) {
  if (auto done = begin(); !done) return done;
  for (const auto& [name, value] : summary.numbers)
    if (std::isfinite(value))
      if (auto done = insert(summary_, name, value); !done) return done;
  if (auto done = insert(summary_, "content_hash", summary.content_hash); !done)
    return done;
  if (auto done = insert(summary_, "interrupted", summary.interrupted); !done)
    return done;
  if (auto done = commit(); !done) return done;
  if (auto done = sqlite_.execute("PRAGMA wal_checkpoint(TRUNCATE)"); !done) return done;
  // A run that is over needs no log: it can be read where nothing can be written. While
  // somebody reads it, it keeps one; that is no failure.
  static_cast<void>(sqlite_.execute("PRAGMA journal_mode=DELETE"));
  return {};
}

}  // namespace skein::record
