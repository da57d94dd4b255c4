// SPDX-License-Identifier: Apache-2.0
#include "skein/record/store/run_views.h"

#include <cmath>
#include <map>
#include <utility>

#include "skein/data/event/record.h"
#include "skein/record/store/record_table.h"
#include "skein/record/store/run_database.h"

namespace skein::record {
namespace {

constexpr double kPathStep = 1;  // [s]

BoundaryPoint point_of(const float* f) {
  BoundaryPoint point;
  point.position = {f[0], f[1]};
  point.normal = {f[2], f[3]};
  point.sigma = f[4];
  point.sigma_growth = f[5];
  point.rate = f[6];
  point.major_axis = {f[7], f[8]};
  return point;
}

std::vector<BoundaryPoint> ring_of(const std::vector<float>& floats) {
  std::vector<BoundaryPoint> ring;
  for (std::size_t k = 0; k + kBeliefFloats <= floats.size(); k += kBeliefFloats)
    ring.push_back(point_of(&floats[k]));
  return ring;
}

std::string seconds(Time time) {
  return std::to_string(time.seconds() + 1e-6);
}

}  // namespace

Result<RunViews> RunViews::open(const std::filesystem::path& directory) {
  auto database = Sqlite::open(directory / "run.sqlite", Sqlite::Mode::kRead);
  if (!database) return database.error();
  RunViews views(std::move(database).value());
  if (auto good = check_store(views.database_); !good) return good.error();
  return views;
}

Result<Time> RunViews::last() const {
  Time last;
  auto done = for_each_row(
      database_,
      "SELECT max(coalesce((SELECT max(time_s) FROM estimates), 0),"
      " coalesce((SELECT max(time_s) FROM metrics), 0)) AS end_s",
      [&](const Statement& row) {
        const double end = row.real(0);
        if (end < 0 || end > kLongestRun)
          row.refuse(0, "the end of a run, from 0 to 4e6 s");
        else
          last = Time::from_seconds(end);
      },
      "tables estimates and metrics");
  if (!done) return done.error();
  return last;
}

Result<bool> RunViews::ended() const {
  bool ended = false;
  auto done = for_each_row(database_, "SELECT count(*) FROM summary",
                           [&](const Statement& row) { ended = row.integer(0) > 0; });
  if (!done) return done.error();
  return ended;
}

Result<std::string> RunViews::start_utc() const {
  std::string utc;
  auto done = for_each_row(database_, "SELECT value FROM meta WHERE name = 'start_utc'",
                           [&](const Statement& row) { utc = row.text(0); });
  if (!done) return done.error();
  return utc;
}

// Rings of each mission at its newest `time` column not after `at`.
Result<std::vector<StoredBelief>> RunViews::rings(const std::string& source,
                                                  const std::string& time,
                                                  Time at) const {
  std::vector<StoredBelief> all;
  // The newest time is looked up once, not for each row.
  const std::string newest = "JOIN (SELECT believer_id AS who, mission AS whose, max(" +
                             time + ") AS at FROM perimeters WHERE source = '" + source +
                             "' AND " + time + " <= " + seconds(at) +
                             " GROUP BY believer_id, mission) ON who = believer_id AND "
                             "whose = mission AND at = " +
                             time + " WHERE source = '" + source +
                             "' ORDER BY believer_id, mission, time_s, ring";
  auto done = for_each_row_of(
      database_, "perimeters", "believer_id, mission, time_s, made_s, data", newest,
      [&](const Statement& row) {
        const Believer who{entity_id(row, 1), row.text(2)};
        const Time valid = time_of_row(row, 3);
        if (all.empty() || all.back().who != who || all.back().boundary.time != valid) {
          all.push_back({who, {valid, {}}, std::nullopt});
          if (!row.is_null(4)) all.back().made = time_of_row(row, 4);
        }
        all.back().boundary.rings.push_back(ring_of(stored_ring(row, 5, kBeliefFloats)));
      });
  if (!done) return done.error();
  return all;
}

Result<std::vector<StoredBelief>> RunViews::beliefs(Time at) const {
  return rings("belief", "time_s", at);
}

Result<std::vector<StoredBelief>> RunViews::forecasts(Time at) const {
  return rings("forecast", "made_s", at);
}

Result<std::vector<StoredPath>> RunViews::paths(Time at) const {
  std::map<std::uint32_t, StoredPath> paths;
  auto done = for_each_row_of(
      database_, "estimates",
      "estimates.entity_id, n.name, estimates.time_s, north_m, east_m",
      "JOIN entities n USING (entity_id) WHERE estimates.time_s <= " + seconds(at) +
          " ORDER BY estimates.entity_id, estimates.time_s",
      [&](const Statement& row) {
        const Time time = time_of_row(row, 3);
        const auto [found, first] = paths.try_emplace(entity_id(row, 1).value);
        StoredPath& path = found->second;
        if (first) {
          path.name = row.text(2);
          path.from = time;
        } else if ((time - path.until).seconds() < kPathStep) {
          return;
        }
        path.until = time;
        path.places.emplace_back(row.real(4), row.real(5));
      });
  if (!done) return done.error();
  std::vector<StoredPath> all;
  for (auto& [id, path] : paths)
    if (path.places.size() > 1) all.push_back(std::move(path));
  return all;
}

Result<std::vector<Zone>> RunViews::zones(Time at) const {
  std::vector<Zone> all;
  auto done = for_each_record<ZoneRecord>(
      database_, "WHERE time_s <= " + seconds(at) + " ORDER BY time_s",
      [&](ZoneRecord record) {
        Zone& zone = record.change.zone;
        std::erase_if(all, [&](const Zone& other) { return other.name == zone.name; });
        if (record.change.on) all.push_back(std::move(zone));
      });
  if (!done) return done.error();
  std::erase_if(all, [&](const Zone& zone) {
    return at.seconds() < zone.from || at.seconds() > zone.until;
  });
  return all;
}

}  // namespace skein::record
