// SPDX-License-Identifier: Apache-2.0
#include "skein/record/store/record_stream.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "skein/record/figures/metrics.h"
#include "skein/record/store/record_table.h"
#include "skein/record/store/run_database.h"
#include "skein/record/store/run_facts.h"

namespace skein::record {
namespace stream {

struct Timed {
  Time time;
  std::variant<Record, MetricSample> what;
};

// A table that is read from its begin to its end, piece by piece.
class Cursor {
 public:
  virtual ~Cursor() = default;
  // Goes to the first row, or near the last one before a time.
  virtual Result<void> seek(Sqlite& database, Time time) = 0;
  // Appends all rows up to a time.
  virtual Result<void> take(Sqlite& database, Time until, std::vector<Timed>& out) = 0;
};

}  // namespace stream

namespace {

using stream::Cursor, stream::Timed;

constexpr std::int64_t kPiece = 1000;  // rows that are read at once
constexpr double kMotionBefore = 2;    // of vehicles, before the time that is gone to [s]

// When a record came; what was there from the start comes first.
template <class T>
Time time_of(const T& record) {
  if constexpr (requires { record.time; })
    return record.time;
  else if constexpr (std::is_same_v<T, EstimateRecord>)
    return record.nav.time;
  else if constexpr (std::is_same_v<T, MessageRecord> || std::is_same_v<T, TaskRow>)
    return record.arrived;
  else if constexpr (std::is_same_v<T, ArrivalRecord>)
    return record.forecast.made;
  else
    return Time::from_ns(-1);
}

std::string piece_after(std::int64_t row) {
  return "WHERE rowid > " + std::to_string(row) + " ORDER BY rowid LIMIT " +
         std::to_string(kPiece);
}

// Rows of vehicles end with the run.
template <class T>
void check_time(const T& record, const Statement& row, const std::optional<Time>& end) {
  const double time = time_of(record).seconds();
  if (std::abs(time) > kLatestRecord) row.refuse(1, "a time of a run, up to 1e7 s");
  if constexpr (std::is_same_v<T, TruthRecord> || std::is_same_v<T, EstimateRecord>)
    if (end && time > end->seconds() + kMaxAfterEnd)
      row.refuse(
          1, "a time up to the end of the run, " + std::to_string(end->seconds()) + " s");
}

template <class Item>
class PieceCursor : public Cursor {
 public:
  Result<void> seek(Sqlite&, Time) override {
    go_to(0);
    return {};
  }

  Result<void> take(Sqlite& database, Time until, std::vector<Timed>& out) override {
    for (;;) {
      while (!ahead_.empty() && time_of_item(ahead_.front()) <= until) {
        put(std::move(ahead_.front()), out);
        ahead_.pop_front();
      }
      if (!ahead_.empty() || ended_) {
        // A run that is being written goes on.
        ended_ = false;
        return {};
      }
      const std::int64_t before = row_;
      if (auto read = read_piece(database); !read) return read.error();
      ended_ = row_ == before;
    }
  }

 protected:
  void go_to(std::int64_t row) {
    ahead_.clear();
    row_ = row;
    ended_ = false;
  }
  // Appends to ahead_, and moves row_ to the last row that was read.
  virtual Result<void> read_piece(Sqlite& database) = 0;
  virtual Time time_of_item(const Item& item) const = 0;
  virtual void put(Item item, std::vector<Timed>& out) = 0;

  std::deque<Item> ahead_;
  std::int64_t row_ = 0;

 private:
  bool ended_ = false;
};

// Records of a kind, by its table.
template <Described T>
class TableCursor final : public PieceCursor<T> {
 public:
  // @param end  of the run; none: it is not known.
  explicit TableCursor(std::optional<Time> end) : end_(end) {}

  Result<void> seek(Sqlite& database, Time time) override {
    this->go_to(0);
    if constexpr (!std::is_same_v<T, TruthRecord> && !std::is_same_v<T, EstimateRecord>)
      return {};
    // Rows are in order of time: by halves, also where numbers are missing.
    std::int64_t low = 0, high = 0;
    const std::string table(kDescription<T>.name.table);
    auto done = for_each_row(
        database, "SELECT coalesce(max(rowid), 0) AS last_row FROM " + table,
        [&](const Statement& row) { high = row.whole(0, 0, kMaxRow); }, "table " + table);
    const double target = time.seconds() - kMotionBefore;
    while (done && high - low > 1) {
      const std::int64_t middle = low + (high - low) / 2;
      bool before = false;
      done = for_each_row_of(
          database, table, "time_s",
          "WHERE rowid >= " + std::to_string(middle) + " ORDER BY rowid LIMIT 1",
          [&](const Statement& row) { before = row.seconds(1) < target; });
      (before ? low : high) = middle;
    }
    this->go_to(low);
    return done;
  }

 private:
  Result<void> read_piece(Sqlite& database) override {
    const std::string piece = piece_after(this->row_);
    const std::size_t before = this->ahead_.size();
    auto done = for_each_record<T>(
        database, piece,
        [this](T value, std::int64_t number) {
          this->ahead_.push_back(std::move(value));
          this->row_ = number;
        },
        [this](const T& value, const Statement& row) { check_time(value, row, end_); });
    if constexpr (std::is_same_v<T, RecommendationRecord>)
      if (done) return read_paths(database, piece, before);
    return done;
  }

  // Lists are not read back with their records.
  Result<void> read_paths(Sqlite& database, const std::string& piece, std::size_t next) {
    return for_each_row_of(
        database, "recommendations", "path_json", piece, [&](const Statement& row) {
          const auto list = json::Json::parse(row.text(1), nullptr, false);
          if (next >= this->ahead_.size()) return;  // written since
          auto& path = this->ahead_.at(next++).value.path;
          if (list.is_array())
            for (const json::Json& item : list)
              if (auto point = json::from_json<RecommendedPoint>(item))
                path.push_back(std::move(point).value());
        });
  }
  Time time_of_item(const T& value) const override { return time_of(value); }
  void put(T value, std::vector<Timed>& out) override {
    const Time time = time_of(value);
    if constexpr (std::is_same_v<T, TaskRow>) {
      MessageRecord message;
      message.message.from = value.from;
      message.message.to = value.to;
      message.message.sent = value.sent;
      message.message.content = std::move(value.task);
      message.arrived = value.arrived;
      message.lost = value.lost;
      out.push_back({time, Record(std::move(message))});
    } else if constexpr (std::is_same_v<T, MessageRecord>) {
      // What it said is not stored: whoever reads it must not take it for a reading.
      value.message.content = Heartbeat{};
      out.push_back({time, Record(std::move(value))});
    } else {
      out.push_back({time, Record(std::move(value))});
    }
  }

  std::optional<Time> end_;
};

// Boundaries, whose rings are rows.
struct RingRow {
  Time time, made;
  std::string source, mission;
  std::uint32_t phenomenon = 0;
  EntityId believer;
  std::int64_t ring = 0;
  std::vector<float> floats;
};

geo::Ring true_ring(const std::vector<float>& floats) {
  geo::Ring ring;
  for (std::size_t k = 0; k + kTruthFloats <= floats.size(); k += kTruthFloats)
    ring.push_back(Vec2(floats[k], floats[k + 1]));
  return ring;
}

std::vector<BoundaryPoint> believed_ring(const std::vector<float>& floats) {
  std::vector<BoundaryPoint> ring;
  for (std::size_t k = 0; k + kBeliefFloats <= floats.size(); k += kBeliefFloats) {
    const float* f = &floats[k];
    ring.push_back(
        {Vec2(f[0], f[1]), Vec2(f[2], f[3]), f[4], f[5], f[6], Vec2(f[7], f[8])});
  }
  return ring;
}

class PerimeterCursor final : public PieceCursor<RingRow> {
 public:
  static constexpr std::int64_t kMaxPhenomenon = 1'000'000;

  Result<void> seek(Sqlite& database, Time time) override {
    truth_.clear();
    return PieceCursor::seek(database, time);
  }

 private:
  Result<void> read_piece(Sqlite& database) override {
    return for_each_row_of(
        database, "perimeters",
        "time_s, made_s, source, mission, phenomenon, believer_id, ring, points, data",
        piece_after(row_), [this](const Statement& row, std::int64_t number) {
          RingRow& ring = ahead_.emplace_back();
          ring.time = time_of_row(row, 1);
          ring.made = row.is_null(2) ? ring.time : time_of_row(row, 2);
          ring.source = row.text(3);
          ring.mission = row.text(4);
          ring.phenomenon = static_cast<std::uint32_t>(row.whole(5, 0, kMaxPhenomenon));
          ring.believer = entity_id(row, 6);
          ring.ring = row.whole(7, 0, kMaxRow);
          const std::size_t each = ring.source == "truth" ? kTruthFloats : kBeliefFloats;
          ring.floats = stored_ring(row, 9, each);
          if (row.integer(8) != static_cast<std::int64_t>(ring.floats.size() / each))
            row.refuse(8, "the number of points of the blob data");
          row_ = number;
        });
  }
  Time time_of_item(const RingRow& ring) const override { return ring.made; }

  // Rings of one boundary follow each other; the first has number 0.
  void put(RingRow ring, std::vector<Timed>& out) override {
    if (ring.source == "truth") {
      geo::Region& region = truth_[ring.phenomenon];
      if (ring.ring == 0) region.clear();
      region.push_back(true_ring(ring.floats));
      // It stands behind the belief of its time.
      if (auto* last = out.empty() ? nullptr : record_in<PerimeterRecord>(out);
          last && last->time == ring.time && last->phenomenon == ring.phenomenon)
        last->truth = region;
      return;
    }
    const bool goes_on = ring.ring > 0 && !out.empty();
    if (ring.source == "forecast") {
      auto* last = goes_on ? record_in<ForecastRecord>(out) : nullptr;
      if (!last) {
        ForecastRecord record;
        record.believer = ring.believer;
        record.forecast.made = ring.made;
        record.forecast.boundary.time = ring.time;
        record.forecast.phenomenon = ring.phenomenon;
        record.forecast.mission = ring.mission;
        out.push_back({ring.made, Record(std::move(record))});
        last = record_in<ForecastRecord>(out);
      }
      last->forecast.boundary.rings.push_back(believed_ring(ring.floats));
      return;
    }
    auto* last = goes_on ? record_in<PerimeterRecord>(out) : nullptr;
    if (!last) {
      PerimeterRecord record;
      record.time = ring.time;
      record.believer = ring.believer;
      record.truth = truth_[ring.phenomenon];
      record.belief.time = ring.time;
      record.mission = ring.mission;
      record.phenomenon = ring.phenomenon;
      out.push_back({ring.time, Record(std::move(record))});
      last = record_in<PerimeterRecord>(out);
    }
    last->belief.rings.push_back(believed_ring(ring.floats));
  }

  template <class T>
  static T* record_in(std::vector<Timed>& out) {
    auto* record = std::get_if<Record>(&out.back().what);
    return record ? std::get_if<T>(record) : nullptr;
  }

  std::map<std::uint32_t, geo::Region> truth_;  // by phenomenon
};

class MetricsCursor final : public PieceCursor<MetricSample> {
 private:
  Result<void> read_piece(Sqlite& database) override {
    std::string columns;
    std::vector<std::string> names;
    for (const MetricField& field : metric_fields())
      columns +=
          ", " + names.emplace_back(std::string(field.name) + std::string(field.unit));
    return for_each_row_of(
        database, "metrics", "time_s, mission" + columns, piece_after(row_),
        [&](const Statement& row, std::int64_t number) {
          MetricSample& sample = ahead_.emplace_back();
          sample.time = time_of_row(row, 1);
          sample.mission = row.text(2);
          for (std::size_t k = 0; k < names.size(); ++k)
            if (const int column = static_cast<int>(k) + 3; !row.is_null(column))
              sample.values.push_back({names[k], row.real(column)});
          row_ = number;
        });
  }
  Time time_of_item(const MetricSample& sample) const override { return sample.time; }
  void put(MetricSample sample, std::vector<Timed>& out) override {
    const Time time = sample.time;
    out.push_back({time, std::move(sample)});
  }
};

}  // namespace

struct RecordStream::Parts {
  explicit Parts(Sqlite of) : database(std::move(of)) {}

  // Of a run that is over, what it says; else the last that there is.
  Result<void> read_end() {
    return for_each_row(
        database,
        "SELECT coalesce((SELECT value FROM summary WHERE name = 'simulated_s'),"
        " max(coalesce((SELECT time_s FROM truth ORDER BY rowid DESC LIMIT 1), 0),"
        " coalesce((SELECT time_s FROM metrics ORDER BY rowid DESC LIMIT 1), 0)))"
        " AS end_s, EXISTS (SELECT 1 FROM summary WHERE name = 'simulated_s')",
        [this](const Statement& row) {
          const double seconds = row.real(0);
          if (seconds < 0 || seconds > kLongestRun)
            return row.refuse(0, "the end of a run, from 0 to 4e6 s");
          end = Time::from_seconds(seconds);
          if (row.integer(1) != 0) known_end = end;
        },
        "tables summary, truth and metrics");
  }
  void make_cursors() {
    type_traits::for_each_alternative(
        static_cast<const Record*>(nullptr), [this]<class T>() {
          if constexpr (!kDescription<T>.name.table.empty())
            cursors.push_back(std::make_unique<TableCursor<T>>(known_end));
        });
    cursors.push_back(std::make_unique<TableCursor<TaskRow>>(known_end));
    cursors.push_back(std::make_unique<PerimeterCursor>());
    cursors.push_back(std::make_unique<MetricsCursor>());
  }

  Sqlite database;
  RunInfo info;
  Time end;
  std::optional<Time> known_end;  // of a run that is over
  std::unique_ptr<TerrainRow> terrain;
  std::vector<std::unique_ptr<stream::Cursor>> cursors;
  std::vector<stream::Timed> gathered;
};

RecordStream::RecordStream(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
RecordStream::RecordStream(RecordStream&&) noexcept = default;
RecordStream& RecordStream::operator=(RecordStream&&) noexcept = default;
RecordStream::~RecordStream() = default;

Result<RecordStream> RecordStream::open(const std::filesystem::path& directory) {
  auto database = Sqlite::open(directory / "run.sqlite", Sqlite::Mode::kRead);
  if (!database) return database.error();
  auto parts = std::make_unique<Parts>(std::move(database).value());
  if (auto good = check_store(parts->database); !good) return good.error();
  auto info = read_info(parts->database);
  if (!info) return info.error();
  parts->info = std::move(info).value();
  if (auto read = parts->read_end(); !read) return read.error();
  auto terrain = read_terrain(parts->database);
  if (!terrain) return terrain.error();
  parts->terrain = std::move(terrain).value();
  parts->make_cursors();
  return RecordStream(std::move(parts));
}

const RunInfo& RecordStream::info() const {
  return parts_->info;
}
Time RecordStream::end() const {
  return parts_->end;
}
const TerrainRow* RecordStream::terrain() const {
  return parts_->terrain.get();
}

Result<void> RecordStream::seek(Time time) {
  for (const auto& cursor : parts_->cursors)
    if (auto done = cursor->seek(parts_->database, time); !done) return done.error();
  return {};
}

Result<void> RecordStream::advance(Time until, const Listener& listener) {
  std::vector<Timed>& all = parts_->gathered;
  all.clear();
  for (const auto& cursor : parts_->cursors)
    if (auto done = cursor->take(parts_->database, until, all); !done)
      return done.error();
  std::stable_sort(all.begin(), all.end(),
                   [](const Timed& a, const Timed& b) { return a.time < b.time; });
  for (const Timed& each : all) {
    if (const auto* record = std::get_if<Record>(&each.what))
      listener.record(each.time, *record);
    else
      listener.metrics(each.time, std::get<MetricSample>(each.what));
  }
  return {};
}

}  // namespace skein::record
