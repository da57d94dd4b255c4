#include "skein/record/run_database.h"

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "skein/geo/vec.h"

namespace skein::record {
namespace {

static_assert(std::endian::native == std::endian::little,
              "blobs are documented as little-endian");

// Every quantity has its unit in its name: docs/records.md explains the columns.
constexpr const char* kSchema = R"sql(
CREATE TABLE meta (name TEXT PRIMARY KEY, value) WITHOUT ROWID;
CREATE TABLE entities (entity_id INTEGER PRIMARY KEY, name TEXT, kind TEXT);
CREATE TABLE truth (time_s REAL, entity_id INTEGER, north_m REAL, east_m REAL,
  altitude_msl_m REAL, velocity_north_m_s REAL, velocity_east_m_s REAL,
  climb_m_s REAL, airspeed_m_s REAL, heading_deg REAL, roll_deg REAL, pitch_deg REAL,
  charge REAL, power_w REAL);
CREATE TABLE estimates (time_s REAL, entity_id INTEGER, north_m REAL, east_m REAL,
  altitude_msl_m REAL, velocity_north_m_s REAL, velocity_east_m_s REAL, climb_m_s REAL,
  heading_deg REAL, wind_north_m_s REAL, wind_east_m_s REAL, position_sd_m REAL,
  roll_deg REAL, pitch_deg REAL, cross_track_m REAL, time_error_s REAL, mode TEXT,
  failsafe TEXT, reaction TEXT, charge REAL, reserve REAL, endurance_s REAL);
CREATE TABLE readings (time_s REAL, entity_id INTEGER, north_m REAL, east_m REAL,
  position_sd_m REAL, inside INTEGER);
CREATE TABLE crossings (time_s REAL, entity_id INTEGER, north_m REAL, east_m REAL,
  position_sd_m REAL, entered INTEGER);
CREATE TABLE messages (sent_s REAL, arrived_s REAL, from_id INTEGER, to_id INTEGER,
  number INTEGER, kind TEXT, size_bytes INTEGER, lost INTEGER);
CREATE TABLE tasks (sent_s REAL, arrived_s REAL, from_id INTEGER, entity_id INTEGER,
  task_number INTEGER, kind TEXT, north_m REAL, east_m REAL, course_deg REAL,
  clockwise INTEGER, points_json TEXT, lost INTEGER);
CREATE TABLE perimeters (time_s REAL, source TEXT, believer_id INTEGER, ring INTEGER,
  points INTEGER, data BLOB);
CREATE TABLE events (time_s REAL, entity_id INTEGER, kind TEXT, text TEXT);
CREATE TABLE terrain (rows INTEGER, columns INTEGER, low_north_m REAL, low_east_m REAL,
  spacing_m REAL, heights_msl_m BLOB);
CREATE TABLE objects (object_id INTEGER PRIMARY KEY, name TEXT, north_m REAL,
  east_m REAL, velocity_north_m_s REAL, velocity_east_m_s REAL);
CREATE TABLE detections (time_s REAL, entity_id INTEGER, sensor INTEGER,
  object_id INTEGER, north_m REAL, east_m REAL, position_sd_m REAL);
CREATE TABLE footprints (time_s REAL, entity_id INTEGER, sensor INTEGER,
  front_left_north_m REAL, front_left_east_m REAL, front_right_north_m REAL,
  front_right_east_m REAL, back_right_north_m REAL, back_right_east_m REAL,
  back_left_north_m REAL, back_left_east_m REAL);
CREATE TABLE ranges (time_s REAL, entity_id INTEGER, sensor INTEGER, beams INTEGER,
  hits INTEGER, least_m REAL, mean_m REAL, data BLOB);
CREATE TABLE zones (time_s REAL, number INTEGER, name TEXT, in_force INTEGER,
  ring_json TEXT, centre_north_m REAL, centre_east_m REAL, radius_m REAL,
  floor_msl_m REAL, ceiling_msl_m REAL, from_s REAL, until_s REAL);
CREATE TABLE summary (name TEXT PRIMARY KEY, value) WITHOUT ROWID;
)sql";

constexpr double kNull = std::numeric_limits<double>::quiet_NaN();
constexpr std::int64_t kPageBytes = 4096;

// The order of Message::content.
constexpr std::array kContentNames = {"reading",      "report",        "task",
                                      "sign-of-life", "team-position", "zone"};
static_assert(kContentNames.size() == std::variant_size_v<decltype(Message::content)>);

std::string values(int count) {
  std::string list = " VALUES (?";
  for (int i = 1; i < count; ++i) list += ",?";
  return list + ")";
}

std::string metrics_schema() {
  std::string sql = "CREATE TABLE metrics (time_s REAL, believer_id INTEGER";
  for (const MetricField& field : metric_fields())
    sql += ", " + std::string(field.name) + std::string(field.unit) + " REAL";
  return sql + ");";
}

// [[north, east], ...]
std::string json_list(const std::vector<Vec2>& points) {
  nlohmann::json list = nlohmann::json::array();
  for (const Vec2& p : points) list.push_back({p.x(), p.y()});
  return list.dump();
}

// The columns of `tasks` that depend on the kind of task.
struct TaskColumns {
  const char* kind = "";
  std::optional<double> north, east, course_deg, clockwise;
  std::string points_json;

  void place(const Vec2& point) {
    north = point.x();
    east = point.y();
  }
  void list(const std::vector<Vec2>& points) { points_json = json_list(points); }
  void operator()(const Loiter& task) {
    kind = "loiter";
    place(task.centre);
  }
  void operator()(const FlyTo& task) {
    kind = "fly_to";
    place(task.point);
  }
  void operator()(const FollowEdge& task) {
    kind = "follow_edge";
    place(task.start);
    clockwise = task.clockwise ? 1 : 0;
    if (!task.tangent.isZero()) course_deg = geo::degrees(geo::bearing(task.tangent));
  }
  void operator()(const FollowLine& task) {
    kind = "follow_line";
    list(task.points);
  }
  void operator()(const FlyCourse& task) {
    kind = "fly_course";
    course_deg = geo::degrees(task.course);
  }
  void operator()(const FlyRoute& task) {
    kind = "fly_route";
    list(task.points);
  }
  void operator()(const FollowLeader& task) {
    kind = "follow_leader";
    list({task.offset});
  }
};

std::span<const std::byte> bytes(const std::vector<float>& floats) {
  return std::as_bytes(std::span(floats));
}

}  // namespace

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
  const std::string schema = std::string("BEGIN;") + kSchema + metrics_schema();
  for (const std::string& sql : {pragmas, schema})
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
  const struct {
    Statement& statement;
    std::string table;
    int columns;
  } inserts[] = {
      {meta_, "meta", 2},
      {entity_, "entities", 3},
      {truth_, "truth", 14},
      {estimate_, "estimates", 22},
      {reading_, "readings", 6},
      {crossing_, "crossings", 6},
      {message_, "messages", 8},
      {task_, "tasks", 12},
      {event_, "events", 4},
      {object_, "objects", 6},
      {detection_, "detections", 7},
      {footprint_, "footprints", 11},
      {ranges_, "ranges", 8},
      {zone_, "zones", 12},
      {terrain_, "terrain", 6},
      {perimeter_, "perimeters", 6},
      {metrics_, "metrics", 2 + static_cast<int>(metric_fields().size())},
      {summary_, "summary", 2},
  };
  for (const auto& insert : inserts) {
    auto prepared =
        sqlite_.prepare("INSERT INTO " + insert.table + values(insert.columns));
    if (!prepared) return prepared.error();
    insert.statement = std::move(prepared).value();
  }
  return {};
}

Result<void> RunDatabase::begin() {
  return sqlite_.execute("BEGIN");
}

Result<void> RunDatabase::commit() {
  if (!sqlite_.in_transaction()) return {};
  return sqlite_.execute("COMMIT");
}

Result<void> RunDatabase::write(const EntityRow& row) {
  return insert(entity_, row.id.value, row.name, row.kind);
}

Result<void> RunDatabase::write(const TruthRow& row) {
  const geo::Euler attitude = geo::to_euler(row.q_NB);
  return insert(truth_, row.time.seconds(), row.id.value, row.p_N.x(), row.p_N.y(),
                -row.p_N.z(), row.v_N.x(), row.v_N.y(), -row.v_N.z(), row.airspeed,
                geo::degrees(geo::wrap_2pi(attitude.yaw)), geo::degrees(attitude.roll),
                geo::degrees(attitude.pitch), row.charge, row.power);
}

Result<void> RunDatabase::write(const EstimateRow& row) {
  const NavEstimate& e = row.estimate;
  return insert(estimate_, e.time.seconds(), row.id.value, e.p_N.x(), e.p_N.y(),
                -e.p_N.z(), e.v_N.x(), e.v_N.y(), -e.v_N.z(), geo::degrees(e.heading),
                e.wind_N.x(), e.wind_N.y(), e.position_sd, geo::degrees(e.roll),
                geo::degrees(e.pitch), row.follows ? row.cross_track : kNull,
                row.follows ? row.time_error : kNull, name_of(row.mode),
                name_of(row.trigger), name_of(row.reaction), row.charge, row.reserve,
                row.endurance);
}

Result<void> RunDatabase::write(const FireReading& row) {
  return insert(reading_, row.time.seconds(), row.aircraft.value, row.point.x(),
                row.point.y(), row.point_sd, row.inside);
}

Result<void> RunDatabase::write(const Crossing& row) {
  return insert(crossing_, row.time.seconds(), row.aircraft.value, row.point.x(),
                row.point.y(), row.point_sd, row.entered);
}

Result<void> RunDatabase::write(const MessageRow& row) {
  return insert(message_, row.sent.seconds(), row.arrived.seconds(), row.from.value,
                row.to.value, static_cast<std::int64_t>(row.number),
                kContentNames[static_cast<std::size_t>(row.content)], row.size_bytes,
                row.lost);
}

Result<void> RunDatabase::write(const TaskRow& row) {
  TaskColumns columns;
  std::visit(columns, row.task.what);
  return insert(task_, row.sent.seconds(), row.arrived.seconds(), row.from.value,
                row.to.value, row.task.number, columns.kind, columns.north, columns.east,
                columns.course_deg, columns.clockwise, columns.points_json, row.lost);
}

Result<void> RunDatabase::write(const Event& row) {
  return insert(event_, row.time.seconds(), row.entity.value, row.kind, row.text);
}

Result<void> RunDatabase::write(const ZoneRow& row) {
  const Zone& zone = row.change.zone;
  const auto* disc = std::get_if<Disc>(&zone.area);
  const auto* ring = std::get_if<geo::Ring>(&zone.area);
  // Of a zone that goes only the name is told; no limit is null.
  const bool on = row.change.on;
  const auto limit = [&](double value) {
    return on && std::isfinite(value) ? value : kNull;
  };
  return insert(zone_, row.time.seconds(), row.change.number, zone.name, on,
                ring && on ? json_list(*ring) : std::string(),
                disc ? disc->centre.x() : kNull, disc ? disc->centre.y() : kNull,
                disc ? disc->radius : kNull, limit(zone.floor_msl),
                limit(zone.ceiling_msl), limit(zone.from), limit(zone.until));
}

Result<void> RunDatabase::write(const GroundObject& row) {
  return insert(object_, row.id, row.name, row.position.x(), row.position.y(),
                row.velocity.x(), row.velocity.y());
}

Result<void> RunDatabase::write(const Detection& row) {
  return insert(detection_, row.time.seconds(), row.aircraft.value, row.sensor,
                row.object, row.point.x(), row.point.y(), row.point_sd);
}

Result<void> RunDatabase::write(const Footprint& row) {
  const auto& c = row.corners;
  return insert(footprint_, row.time.seconds(), row.aircraft.value, row.sensor, c[0].x(),
                c[0].y(), c[1].x(), c[1].y(), c[2].x(), c[2].y(), c[3].x(), c[3].y());
}

Result<void> RunDatabase::write(const RangeScan& row) {
  std::vector<float> floats;
  double hits = 0, sum = 0, least = std::numeric_limits<double>::infinity();
  for (const RangeSample& beam : row.beams) {
    for (const double number :
         {beam.beam_B.x(), beam.beam_B.y(), beam.beam_B.z(), beam.range})
      floats.push_back(static_cast<float>(number));
    if (beam.range <= 0) continue;
    hits += 1;
    sum += beam.range;
    least = std::min(least, beam.range);
  }
  return insert(ranges_, row.time.seconds(), row.aircraft.value, row.sensor,
                static_cast<std::int64_t>(row.beams.size()),
                static_cast<std::int64_t>(hits), hits > 0 ? least : kNull,
                hits > 0 ? sum / hits : kNull, bytes(floats));
}

Result<void> RunDatabase::write(const TerrainRow& row) {
  return insert(terrain_, row.rows, row.columns, row.low.x(), row.low.y(), row.spacing,
                bytes(row.heights));
}

Result<void> RunDatabase::write_truth(Time time, const geo::Region& truth) {
  std::vector<float> floats;
  for (std::size_t r = 0; r < truth.size(); ++r) {
    floats.clear();
    for (const Vec2& p : truth[r])
      floats.insert(floats.end(), {static_cast<float>(p.x()), static_cast<float>(p.y())});
    auto done =
        insert(perimeter_, time.seconds(), "truth", nullptr, static_cast<std::int64_t>(r),
               static_cast<std::int64_t>(truth[r].size()), bytes(floats));
    if (!done) return done;
  }
  return {};
}

Result<void> RunDatabase::write_belief(Time time, EntityId believer,
                                       const BoundaryEstimate& belief) {
  std::vector<float> floats;
  for (std::size_t r = 0; r < belief.rings.size(); ++r) {
    floats.clear();
    for (const BoundaryPoint& p : belief.rings[r])
      for (const double number : {p.position.x(), p.position.y(), p.normal.x(),
                                  p.normal.y(), p.sigma, p.sigma_growth, p.rate})
        floats.push_back(static_cast<float>(number));
    auto done = insert(perimeter_, time.seconds(), "belief", believer.value,
                       static_cast<std::int64_t>(r),
                       static_cast<std::int64_t>(belief.rings[r].size()), bytes(floats));
    if (!done) return done;
  }
  return {};
}

Result<void> RunDatabase::write_metrics(Time time, EntityId believer,
                                        const PerimeterMetrics& metrics) {
  const auto fields = metric_fields();
  const auto with_columns = [&]<std::size_t... I>(std::index_sequence<I...>) {
    return insert(metrics_, time.seconds(), believer.value, metrics.*fields[I].value...);
  };
  constexpr std::size_t kFieldCount = 13;
  SKEIN_CHECK(fields.size() == kFieldCount, fields.size());
  return with_columns(std::make_index_sequence<kFieldCount>());
}

Result<void> RunDatabase::finish(const RunSummary& summary) {
  if (auto done = begin(); !done) return done;
  for (const auto& [name, value] : summary.numbers)
    if (auto done = insert(summary_, name, value); !done) return done;
  if (auto done = insert(summary_, "content_hash", summary.content_hash); !done)
    return done;
  if (auto done = insert(summary_, "interrupted", summary.interrupted); !done)
    return done;
  if (auto done = commit(); !done) return done;
  return sqlite_.execute("PRAGMA wal_checkpoint(TRUNCATE)");
}

}  // namespace skein::record
