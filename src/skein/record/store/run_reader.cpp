// SPDX-License-Identifier: Apache-2.0
#include "skein/record/store/run_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "skein/base/log.h"
#include "skein/record/figures/statistics.h"
#include "skein/record/store/read_radio.h"
#include "skein/record/store/record_table.h"
#include "skein/record/store/run_database.h"
#include "skein/record/store/run_facts.h"

namespace skein::record {
namespace {

// Before everything: no row of truth is of this time.
constexpr Time kNever = Time::from_ns(-1);
constexpr double kShortestStep = 1;  // between samples of a flight [s]
constexpr std::int64_t kMaxAlertLevel = 1000;

double known(const Statement& row, int column) {
  return row.is_null(column) ? std::numeric_limits<double>::quiet_NaN()
                             : row.real(column);
}

// Every k-th, so that about `max` are left at most.
template <class T>
std::vector<T> thinned(const std::vector<T>& all, int max) {
  const std::size_t keep_each =
      all.size() / static_cast<std::size_t>(std::max(1, max)) + 1;
  std::vector<T> kept;
  for (std::size_t i = 0; i < all.size(); i += keep_each) kept.push_back(all[i]);
  return kept;
}

// All metrics, as columns of a query behind others.
std::string metric_columns() {
  std::string columns;
  for (const MetricField& field : metric_fields())
    columns += ", " + std::string(field.name) + std::string(field.unit);
  return columns;
}

PerimeterMetrics metrics_from(const Statement& row, int column) {
  PerimeterMetrics metrics;
  for (const MetricField& field : metric_fields()) {
    if (!row.is_null(column)) metrics.*field.value = row.real(column);
    ++column;
  }
  return metrics;
}

std::vector<StoredBand> stored_bands(const std::string& text) {
  std::vector<StoredBand> all;
  const auto list = nlohmann::json::parse(text, nullptr, false);
  if (!list.is_array()) return all;
  for (const auto& item : list) {
    if (!item.is_object()) continue;
    StoredBand band;
    for (const auto& [key, value] : item.items()) {
      if (key.starts_with("from") && value.is_number()) band.from = value;
      if (key.starts_with("to") && value.is_number()) band.to = value;
      if (key != "region" || !value.is_string()) continue;
      const auto names = names_of(static_cast<const AlertRegion*>(nullptr));
      const auto at = std::ranges::find(names, value.get<std::string>());
      if (at != names.end()) band.region = static_cast<AlertRegion>(at - names.begin());
    }
    all.push_back(band);
  }
  return all;
}

class Reader {
 public:
  Reader(Sqlite database, const ReadBudget& budget)
      : database_(std::move(database)), budget_(budget) {}

  Result<StoredRun> read() {
    using Part = Result<void> (Reader::*)();
    for (const Part part :
         {&Reader::schema,    &Reader::meta,    &Reader::entities,
          &Reader::duration,  &Reader::events,  &Reader::metrics,
          &Reader::forecasts, &Reader::flights, &Reader::estimates,
          &Reader::readings,  &Reader::radio,   &Reader::crossings,
          &Reader::payload,   &Reader::memory,  &Reader::traffic,
          &Reader::alerts,    &Reader::bands,   &Reader::recommendations,
          &Reader::missions,  &Reader::team,    &Reader::summary})
      if (auto done = (this->*part)(); !done) return done.error();
    return std::move(run_);
  }

 private:
  template <class Take>
  Result<void> sums(const std::string& sql, const std::string& what, Take&& take) {
    return for_each_row(database_, sql, std::forward<Take>(take), what);
  }
  // The first column is the number of the row.
  template <class Take>
  Result<void> rows(const std::string& table, const std::string& columns,
                    const std::string& rest, Take&& take) {
    return for_each_row_of(database_, table, columns, rest, std::forward<Take>(take));
  }
  // Of a vehicle, whose columns 1 and 2 are its entity and a time.
  void check_vehicle(const Statement& row) const {
    if (!known_.contains(entity_id(row, 1)))
      row.refuse(1, "the number of an entity of the run");
    if (row.seconds(2) > run_.duration + kMaxAfterEnd)
      row.refuse(
          2, "a time up to the end of the run, " + std::to_string(run_.duration) + " s");
  }
  template <Described T, class Take>
  Result<void> records(const std::string& order, Take&& take) {
    return for_each_record<T>(database_, order, std::forward<Take>(take));
  }

  Result<void> schema() { return check_store(database_); }

  Result<void> meta() {
    auto info = read_info(database_);
    if (!info) return info.error();
    run_.info = std::move(info).value();
    return {};
  }

  Result<void> entities() {
    return records<EntityRecord>("", [this](EntityRecord entity) {
      known_.insert(entity.id);
      statistics_.entity(entity);
      run_.entities.push_back(std::move(entity));
    });
  }

  // Of a run that is over, what it says; else the last that there is.
  Result<void> duration() {
    return sums(
        "SELECT coalesce((SELECT value FROM summary WHERE name = 'simulated_s'),"
        " max(coalesce((SELECT max(time_s) FROM truth), 0),"
        " coalesce((SELECT max(time_s) FROM metrics), 0),"
        " coalesce((SELECT max(time_s) FROM readings), 0))) AS end_s",
        "tables summary, truth, metrics and readings", [this](const Statement& row) {
          run_.duration = row.real(0);
          if (run_.duration < 0 || run_.duration > kLongestRun)
            row.refuse(0, "the end of a run, from 0 to 4e6 s");
        });
  }

  Result<void> events() {
    int total = 0;
    auto done =
        sums("SELECT count(*) AS events FROM events", "table events",
             [&](const Statement& row) {
               total = static_cast<int>(row.whole(0, 0, std::numeric_limits<int>::max()));
             });
    if (!done) return done;
    // The rarest kinds say the most: they stay when there are too many.
    done = records<Event>(
        "JOIN (SELECT kind AS k, count(*) AS n FROM events GROUP BY kind) ON k = kind"
        " ORDER BY n, time_s LIMIT " +
            std::to_string(budget_.events),
        [this](Event event) { run_.events.push_back(std::move(event)); });
    if (!done) return done;
    std::stable_sort(run_.events.begin(), run_.events.end(),
                     [](const Event& a, const Event& b) { return a.time < b.time; });
    run_.events_left_out = total - static_cast<int>(run_.events.size());
    // Only for the figures of a run that was cut off, but when allocation began.
    return records<Event>("ORDER BY rowid", [this](const Event& event) {
      statistics_.event(event);
      statistics_.missions().event(event);
      statistics_.team().event(event);
      if (event.kind == EventKind::kAllocation)
        run_.allocation_start = std::fmin(run_.allocation_start, event.time.seconds());
    });
  }

  // Likewise.
  Result<void> team() {
    auto done = records<TeamLeadRecord>(
        "ORDER BY rowid",
        [this](const TeamLeadRecord& record) { statistics_.team().lead(record); });
    if (!done) return done;
    return records<TeamAllocationRecord>("ORDER BY rowid",
                                         [this](const TeamAllocationRecord& record) {
                                           statistics_.team().allocation(record.value);
                                         });
  }

  Result<void> metrics() {
    std::optional<Believer> first;  // whose metrics are plotted
    return rows("metrics", "time_s, believer_id, mission" + metric_columns(), "",
                [&](const Statement& row) {
                  const PerimeterMetrics metrics = metrics_from(row, 4);
                  const Believer who{entity_id(row, 2), row.text(3)};
                  statistics_.metrics(time_of_row(row, 1), who, metrics);
                  if (!first) first = who;
                  if (who != *first) return;
                  run_.metric_times.push_back(row.seconds(1));
                  run_.metrics.push_back(metrics);
                });
  }

  Result<void> flights() {
    flights_.emplace(std::max(kShortestStep, run_.duration / budget_.flight_samples),
                     budget_.flights);
    return rows(
        "truth",
        "entity_id, time_s, north_m, east_m, altitude_msl_m, charge, airspeed_mps,"
        " on_ground",
        "", [&](const Statement& row) {
          check_vehicle(row);
          const EntityId id = entity_id(row, 1);
          VehicleState state;
          state.p_N = Vec3(row.real(3), row.real(4), -row.real(5));
          state.energy.charge = row.real(6);
          state.on_ground = row.integer(8) != 0;
          statistics_.truth(time_of_row(row, 2), id, state);
          flights_->truth(id, {row.seconds(2), Vec2(row.real(3), row.real(4)),
                               row.real(5), known(row, 7), known(row, 6)});
        });
  }

  // The figures of a run that was cut off have no truth beside the estimates.
  Result<void> estimates() {
    auto done = rows(
        "estimates",
        "entity_id, time_s, north_m, east_m, reserve, follows, cross_track_m", "",
        [this](const Statement& row) {
          check_vehicle(row);
          const double cross_track = row.integer(6) != 0
                                         ? row.real(7)
                                         : std::numeric_limits<double>::quiet_NaN();
          if (std::isfinite(cross_track))
            statistics_.estimate(kNever, entity_id(row, 1), Vec3::Zero(), cross_track);
          if (!row.is_null(5)) statistics_.reserve(entity_id(row, 1), row.real(5));
          flights_->estimate(entity_id(row, 1),
                             {row.seconds(2), Vec2(row.real(3), row.real(4)), cross_track,
                              known(row, 5)});
        });
    run_.flights = flights_->take();
    return done;
  }

  // Only for the counts of a run that was cut off.
  Result<void> readings() {
    return rows("readings", "1", "", [this](const Statement&) { statistics_.reading(); });
  }

  Result<void> radio() { return read_radio(database_, statistics_.radio(), run_); }

  Result<void> forecasts() {
    auto done = records<ArrivalRecord>("ORDER BY made_s", [this](ArrivalRecord record) {
      run_.arrivals.push_back(std::move(record.forecast));
    });
    if (!done) return done;
    return rows("forecast_metrics",
                "made_s, time_s, believer_id, mission" + metric_columns(), "",
                [&](const Statement& row) {
                  ForecastScore score;
                  score.made = time_of_row(row, 1);
                  score.time = time_of_row(row, 2);
                  score.who = {entity_id(row, 3), row.text(4)};
                  score.metrics = metrics_from(row, 5);
                  statistics_.forecasts().score(score);
                  run_.forecasts.push_back(std::move(score));
                });
  }

  Result<void> missions() {
    return rows("mission_metrics", "mission, figure, time_s, value",
                "ORDER BY mission, figure, time_s", [this](const Statement& row) {
                  auto& all = run_.mission_series;
                  if (all.empty() || all.back().mission != row.text(1) ||
                      all.back().figure != row.text(2))
                    all.push_back({row.text(1), row.text(2), {}, {}});
                  all.back().times.push_back(static_cast<float>(row.seconds(3)));
                  all.back().values.push_back(static_cast<float>(row.real(4)));
                });
  }

  // Only for the figures of a run that was cut off.
  Result<void> crossings() {
    return records<Crossing>("ORDER BY time_s", [&](const Crossing& crossing) {
      statistics_.crossing(crossing);
    });
  }

  // What cameras and ranging sensors saw: likewise.
  Result<void> payload() {
    auto done = records<GroundObject>(
        "", [this](const GroundObject& object) { statistics_.payload().object(object); });
    if (!done) return done;
    done = records<ObjectMotion>("ORDER BY time_s", [&](const ObjectMotion& motion) {
      statistics_.payload().motion(motion);
    });
    if (!done) return done;
    done = records<Detection>("ORDER BY time_s", [&](const Detection& detection) {
      statistics_.payload().detection(detection);
    });
    if (!done) return done;
    done = rows("footprints", "1", "",
                [this](const Statement&) { statistics_.payload().footprint(); });
    if (!done) return done;
    return rows("ranges", "1", "",
                [this](const Statement&) { statistics_.payload().ranges(); });
  }

  // Other air traffic, and what was believed of it: likewise.
  Result<void> traffic() {
    auto done = records<AirTraffic>(
        "", [this](const AirTraffic& what) { statistics_.traffic().aircraft(what); });
    if (!done) return done;
    done = records<TrafficMotion>("ORDER BY time_s", [&](const TrafficMotion& motion) {
      statistics_.traffic().motion(motion);
    });
    if (!done) return done;
    return records<TrafficBeliefRecord>("ORDER BY time_s",
                                        [&](const TrafficBeliefRecord& record) {
                                          statistics_.traffic().belief(record);
                                          statistics_.alerts().belief(record.value);
                                        });
  }

  Result<void> alerts() {
    std::vector<AlertRecord> all;
    auto done = records<AlertRecord>("ORDER BY time_s", [&](const AlertRecord& record) {
      statistics_.alerts().alert(record);
      all.push_back(record);
    });
    // A level that rises says most: those that are over go first.
    if (static_cast<int>(all.size()) > budget_.alerts)
      std::erase_if(all, [](const AlertRecord& each) { return each.value.level == 0; });
    run_.alerts = thinned(all, budget_.alerts);
    return done;
  }

  Result<void> bands() {
    std::int64_t count = 0;
    auto done = sums("SELECT count(*) AS bands FROM bands", "table bands",
                     [&](const Statement& row) { count = row.integer(0); });
    if (!done) return done;
    const std::int64_t each = count / std::max(1, budget_.bands) + 1;
    // Ends stay, lest a display show what is over.
    return rows(
        "bands",
        "entity_id, time_s, level, track_advised_deg, speed_advised_mps,"
        " vertical_speed_advised_mps, recovery_s, tracks_json, speeds_json,"
        " vertical_speeds_json, altitudes_json",
        "WHERE rowid % " + std::to_string(each) + " = 0 OR level = 0 ORDER BY time_s",
        [this](const Statement& row) {
          StoredBands bands;
          bands.id = entity_id(row, 1);
          bands.time = row.seconds(2);
          bands.level = static_cast<std::uint32_t>(row.whole(3, 0, kMaxAlertLevel));
          bands.track_advised_deg = known(row, 4);
          bands.speed_advised = known(row, 5);
          bands.vertical_speed_advised = known(row, 6);
          bands.recovery = known(row, 7);
          bands.tracks = stored_bands(row.text(8));
          bands.speeds = stored_bands(row.text(9));
          bands.vertical_speeds = stored_bands(row.text(10));
          bands.altitudes = stored_bands(row.text(11));
          run_.bands.push_back(std::move(bands));
        });
  }

  Result<void> recommendations() {
    auto done = rows("recommendations", "path_json", "ORDER BY time_s, rowid",
                     [this](const Statement& row) {
                       run_.recommendations.push_back({{}, row.text(1)});
                     });
    if (!done) return done;
    std::size_t next = 0;
    done = records<RecommendationRecord>(
        "ORDER BY time_s, rowid", [&](RecommendationRecord record) {
          statistics_.alerts().recommendation(record);
          if (next < run_.recommendations.size())
            run_.recommendations[next++].record = std::move(record);
        });
    if (!done) return done;
    done = records<ConflictRecord>("ORDER BY time_s", [this](const ConflictRecord& each) {
      statistics_.separation().conflict(each.value);
      statistics_.alerts().conflict(each);
    });
    if (!done) return done;
    return records<SeparationLossRecord>("ORDER BY time_s",
                                         [this](const SeparationLossRecord& each) {
                                           statistics_.separation().loss(each);
                                         });
  }

  // Only for the counts of a run that was cut off.
  Result<void> memory() {
    auto done = rows("physical_objects", "1", "", [this](const Statement&) {
      statistics_.memory().physical_object();
    });
    if (!done) return done;
    return records<ObservationRecord>("", [this](const ObservationRecord& record) {
      statistics_.memory().observation(record.fate);
    });
  }

  Result<void> summary() {
    run_.summary.version = run_.info.version;
    run_.summary.name = run_.info.name;
    run_.summary.seed = run_.info.seed;
    int infinite = 0;  // versions before this one wrote such figures
    auto done = sums("SELECT name, value, value IN (9e999, -9e999) FROM summary",
                     "table summary", [&](const Statement& row) {
                       const std::string name = row.text(0);
                       if (name == "content_hash") {
                         run_.summary.content_hash = row.text(1);
                         if (run_.ending == RunEnding::kCutOff)
                           run_.ending = RunEnding::kComplete;
                       } else if (name == "interrupted") {
                         run_.summary.interrupted = row.integer(1) != 0;
                         if (run_.summary.interrupted)
                           run_.ending = RunEnding::kInterrupted;
                       } else if (row.integer(2) != 0) {
                         ++infinite;
                       } else {
                         run_.summary.numbers[name] = row.real(1);
                       }
                     });
    if (!done) return done;
    if (infinite > 0)
      log_warning("{}: {} figures of the table summary are infinite; left out.",
                  database_.file().string(), infinite);
    if (run_.ending == RunEnding::kCutOff) {
      run_.summary.numbers = statistics_.figures();
      run_.summary.numbers["simulated_s"] = run_.duration;
      for (const StoredSeries& series : run_.mission_series)
        run_.summary.numbers["mission_" + series.mission + "_" + series.figure] =
            series.values.back();
    }
    return {};
  }

  Sqlite database_;
  std::set<EntityId> known_;  // entities
  ReadBudget budget_;
  RunStatistics statistics_;
  StoredRun run_;
  std::optional<FlightSeriesBuilder> flights_;
};

}  // namespace

Result<StoredRun> read_run(const std::filesystem::path& directory,
                           const ReadBudget& budget) {
  auto database = Sqlite::open(directory / "run.sqlite", Sqlite::Mode::kRead);
  if (!database) return database.error();
  return Reader(std::move(database).value(), budget).read();
}

}  // namespace skein::record
