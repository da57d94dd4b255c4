#include "skein/record/run_views.h"

#include <cmath>
#include <map>
#include <utility>

#include "skein/data/record.h"
#include "skein/record/record_table.h"
#include "skein/record/run_database.h"

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
  if (auto good = check_schema(views.database_); !good) return good.error();
  return views;
}

Result<Time> RunViews::last() const {
  Time last;
  auto done =
      for_each_row(database_,
                   "SELECT max(coalesce((SELECT max(time_s) FROM estimates), 0),"
                   " coalesce((SELECT max(time_s) FROM metrics), 0))",
                   [&](const Statement& row) { last = Time::from_seconds(row.real(0)); });
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
  const std::string which = "p.source = '" + source + "' AND p." + time +
                            " = (SELECT max(" + time +
                            ") FROM perimeters q WHERE q.source = p.source AND"
                            " q.believer_id = p.believer_id AND q.mission = p.mission AND"
                            " q." +
                            time + " <= " + seconds(at) + ")";
  auto done = for_each_row(
      database_,
      "SELECT p.believer_id, p.mission, p.time_s, p.made_s, p.data FROM perimeters p"
      " WHERE " +
          which + " ORDER BY p.believer_id, p.mission, p.time_s, p.ring",
      [&](const Statement& row) {
        const Believer who{entity_id(row, 0), row.text(1)};
        const Time valid = Time::from_seconds(row.real(2));
        if (all.empty() || all.back().who != who || all.back().boundary.time != valid) {
          all.push_back({who, {valid, {}}, std::nullopt});
          if (!row.is_null(3)) all.back().made = Time::from_seconds(row.real(3));
        }
        all.back().boundary.rings.push_back(ring_of(float_blob(row, 4)));
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
  auto done = for_each_row(
      database_,
      "SELECT e.entity_id, n.name, e.time_s, e.north_m, e.east_m FROM estimates e"
      " JOIN entities n USING (entity_id) WHERE e.time_s <= " +
          seconds(at) + " ORDER BY e.entity_id, e.time_s",
      [&](const Statement& row) {
        const Time time = Time::from_seconds(row.real(2));
        const auto [found, first] =
            paths.try_emplace(static_cast<std::uint32_t>(row.integer(0)));
        StoredPath& path = found->second;
        if (first) {
          path.name = row.text(1);
          path.from = time;
        } else if ((time - path.until).seconds() < kPathStep) {
          return;
        }
        path.until = time;
        path.places.emplace_back(row.real(3), row.real(4));
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
