#include "skein/record/report_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "skein/base/math.h"
#include "skein/data/json.h"
#include "skein/data/zone.h"
#include "skein/record/page.h"
#include "skein/record/run_database.h"

namespace skein::record {
namespace {

using Json = nlohmann::ordered_json;
using Shorts = std::vector<std::uint16_t>;

constexpr double kLevels = 65535;
constexpr double kLowest = -1000, kAltitudeStep = 0.25;  // of packed altitudes [m]
constexpr std::size_t kMaxRingPoints = 150000;  // of all true perimeters together

std::uint16_t level(double part) {
  return static_cast<std::uint16_t>(std::clamp(std::round(part), 0.0, kLevels));
}

// The square that holds everything, and places in it as 16-bit numbers.
class Extent {
 public:
  void add(double north, double east) {
    if (!std::isfinite(north) || !std::isfinite(east)) return;
    low_ = low_.cwiseMin(Vec2(north, east));
    high_ = high_.cwiseMax(Vec2(north, east));
  }
  bool empty() const { return !(low_.x() <= high_.x()); }
  const Vec2& low() const { return low_; }
  double step() const { return std::max((high_ - low_).maxCoeff(), 1.0) / kLevels; }
  std::uint16_t north(double value) const { return level((value - low_.x()) / step()); }
  std::uint16_t east(double value) const { return level((value - low_.y()) / step()); }

 private:
  Vec2 low_ = Vec2::Constant(std::numeric_limits<double>::infinity());
  Vec2 high_ = -low_;
};

// Marks the points of the open line first..last that stay. Reference: [Douglas73].
void keep_corners(const geo::Ring& ring, std::size_t first, std::size_t last,
                  double tolerance, std::vector<bool>& keep) {
  std::vector<std::pair<std::size_t, std::size_t>> open = {{first, last}};
  while (!open.empty()) {
    const auto [from, to] = open.back();
    open.pop_back();
    const Vec2& a = ring[from];
    const Vec2 chord = ring[to % ring.size()] - a;
    double worst = tolerance;
    std::size_t at = from;
    for (std::size_t i = from + 1; i < to; ++i) {
      const Vec2 p = ring[i] - a;
      const double along =
          std::clamp(p.dot(chord) / std::max(chord.squaredNorm(), 1e-12), 0.0, 1.0);
      const double off = (p - along * chord).norm();
      if (off > worst) {
        worst = off;
        at = i;
      }
    }
    if (at == from) continue;
    keep[at] = true;
    open.push_back({from, at});
    open.push_back({at, to});
  }
}

geo::Ring simplified(const geo::Ring& ring, double tolerance) {
  if (ring.size() < 4 || tolerance <= 0) return ring;
  std::size_t far = 0;
  for (std::size_t i = 1; i < ring.size(); ++i)
    if ((ring[i] - ring[0]).squaredNorm() > (ring[far] - ring[0]).squaredNorm()) far = i;
  std::vector<bool> keep(ring.size(), false);
  keep[0] = keep[far] = true;
  keep_corners(ring, 0, far, tolerance, keep);
  keep_corners(ring, far, ring.size(), tolerance, keep);
  geo::Ring out;
  for (std::size_t i = 0; i < ring.size(); ++i)
    if (keep[i]) out.push_back(ring[i]);
  return out;
}

struct TruthFrame {
  double time = 0;
  geo::Region region;
};

// The true perimeters, coarse enough to fit the page.
std::vector<TruthFrame> simplified_truth(const StoredRun& run, double extent) {
  std::vector<TruthFrame> full;
  for (const StoredFrame& frame : run.truth) {
    full.push_back({frame.time, {}});
    for (const std::vector<float>& floats : frame.rings) {
      geo::Ring ring;
      for (std::size_t i = 0; i + kTruthFloats <= floats.size(); i += kTruthFloats)
        if (std::isfinite(floats[i]) && std::isfinite(floats[i + 1]))
          ring.emplace_back(floats[i], floats[i + 1]);
      full.back().region.push_back(std::move(ring));
    }
  }
  for (double tolerance = std::max(0.5, extent / 8000);; tolerance *= 2) {
    std::vector<TruthFrame> out;
    std::size_t points = 0;
    for (const TruthFrame& frame : full) {
      out.push_back({frame.time, {}});
      for (const geo::Ring& ring : frame.region) {
        out.back().region.push_back(simplified(ring, tolerance));
        points += out.back().region.back().size();
      }
    }
    if (points <= kMaxRingPoints || tolerance > extent) return out;
  }
}

Extent extent_of(const StoredRun& run) {
  Extent extent;
  for (const StoredTrack& track : run.tracks)
    for (std::size_t i = 0; i < track.north.size(); ++i)
      extent.add(track.north[i], track.east[i]);
  const auto add = [&extent](const std::vector<StoredFrame>& frames, std::size_t stride) {
    for (const StoredFrame& frame : frames)
      for (const auto& floats : frame.rings)
        for (std::size_t i = 0; i + stride <= floats.size(); i += stride)
          extent.add(floats[i], floats[i + 1]);
  };
  add(run.truth, kTruthFloats);
  add(run.belief, kBeliefFloats);
  for (const StoredForecast& forecast : run.ahead)
    add({{forecast.time, forecast.rings}}, kBeliefFloats);
  for (const Crossing& crossing : run.crossings)
    extent.add(crossing.point.x(), crossing.point.y());
  for (const StoredObject& each : run.objects) {
    for (const ObjectMotion& motion : each.track.motions())
      extent.add(motion.position.x(), motion.position.y());
    if (const auto last = each.track.at(Time::from_seconds(run.duration)))
      extent.add(last->x(), last->y());
  }
  for (const Detection& detection : run.detections)
    extent.add(detection.point.x(), detection.point.y());
  return extent;
}

Json tracks_json(const StoredRun& run, const Extent& extent) {
  Json tracks = Json::array();
  for (const StoredTrack& track : run.tracks) {
    Shorts north, east, altitude;
    std::vector<std::uint8_t> heading;
    for (std::size_t i = 0; i < track.north.size(); ++i) {
      north.push_back(extent.north(track.north[i]));
      east.push_back(extent.east(track.east[i]));
      altitude.push_back(level((track.altitude_msl[i] - kLowest) / kAltitudeStep));
      const double turn = geo::wrap_2pi(track.heading[i]) / (2 * geo::kPi);
      heading.push_back(static_cast<std::uint8_t>(std::lround(turn * 256) % 256));
    }
    tracks.push_back({{"entity", track.id.value},
                      {"start_s", track.start},
                      {"step_s", track.step},
                      {"north", packed(north)},
                      {"east", packed(east)},
                      {"heading", packed(heading)},
                      {"altitude", packed(altitude)}});
  }
  return tracks;
}

Json truth_json(const StoredRun& run, const Extent& extent) {
  Json frames = Json::array();
  for (const TruthFrame& frame : simplified_truth(run, extent.step() * kLevels)) {
    Json rings = Json::array();
    for (const geo::Ring& ring : frame.region) {
      Shorts shorts;
      for (const Vec2& p : ring) {
        shorts.push_back(extent.north(p.x()));
        shorts.push_back(extent.east(p.y()));
      }
      rings.push_back(packed(shorts));
    }
    frames.push_back({{"time_s", frame.time}, {"rings", std::move(rings)}});
  }
  return frames;
}

Json belief_json(const StoredRun& run, const Extent& extent, double sigma_step) {
  Json frames = Json::array();
  for (const StoredFrame& frame : run.belief) {
    Json rings = Json::array();
    for (const std::vector<float>& floats : frame.rings) {
      Shorts shorts;
      for (std::size_t i = 0; i + kBeliefFloats <= floats.size(); i += kBeliefFloats) {
        const std::span<const float> p(&floats[i], kBeliefFloats);
        if (!std::all_of(p.begin(), p.end(), [](float f) { return std::isfinite(f); }))
          continue;
        const double turn =
            geo::wrap_2pi(math::atan2(double{p[3]}, double{p[2]})) / (2 * geo::kPi);
        shorts.push_back(extent.north(p[0]));
        shorts.push_back(extent.east(p[1]));
        shorts.push_back(static_cast<std::uint16_t>(std::lround(turn * 65536) % 65536));
        shorts.push_back(level(double{p[4]} / sigma_step));
      }
      rings.push_back(packed(shorts));
    }
    frames.push_back({{"time_s", frame.time}, {"rings", std::move(rings)}});
  }
  return frames;
}

// Places alone: the map shows no bands of what is ahead.
Json ahead_json(const StoredRun& run, const Extent& extent) {
  Json all = Json::array();
  for (const StoredForecast& forecast : run.ahead) {
    Json rings = Json::array();
    for (const std::vector<float>& floats : forecast.rings) {
      Shorts shorts;
      for (std::size_t i = 0; i + kBeliefFloats <= floats.size(); i += kBeliefFloats) {
        if (!std::isfinite(floats[i]) || !std::isfinite(floats[i + 1])) continue;
        shorts.push_back(extent.north(floats[i]));
        shorts.push_back(extent.east(floats[i + 1]));
      }
      rings.push_back(packed(shorts));
    }
    all.push_back({{"made_s", forecast.made},
                   {"time_s", forecast.time},
                   {"mission", forecast.mission},
                   {"rings", std::move(rings)}});
  }
  return all;
}

double largest_sigma(const StoredRun& run) {
  float largest = 0;
  for (const StoredFrame& frame : run.belief)
    for (const auto& floats : frame.rings)
      for (std::size_t i = 4; i < floats.size(); i += kBeliefFloats)
        if (std::isfinite(floats[i])) largest = std::max(largest, floats[i]);
  return largest;
}

Json crossings_json(const StoredRun& run, const Extent& extent) {
  std::vector<float> times;
  Shorts north, east;
  for (const Crossing& crossing : run.crossings) {
    times.push_back(static_cast<float>(crossing.time.seconds()));
    north.push_back(extent.north(crossing.point.x()));
    east.push_back(extent.east(crossing.point.y()));
  }
  return {{"time_s", packed(times)}, {"north", packed(north)}, {"east", packed(east)}};
}

// The things on the ground, and where the aircraft believed what they found of them.
Json objects_json(const StoredRun& run) {
  Json objects = Json::array();
  for (const StoredObject& each : run.objects) {
    Json object = json::to_json(each.object);
    std::vector<float> motions;
    for (const ObjectMotion& m : each.track.motions())
      for (const double value : {m.time.seconds(), m.position.x(), m.position.y(),
                                 m.velocity.x(), m.velocity.y()})
        motions.push_back(static_cast<float>(value));
    object["motions"] = packed(motions);
    objects.push_back(std::move(object));
  }
  return objects;
}

Json detections_json(const StoredRun& run, const Extent& extent) {
  std::vector<float> times;
  Shorts north, east, object;
  for (const Detection& detection : run.detections) {
    times.push_back(static_cast<float>(detection.time.seconds()));
    north.push_back(extent.north(detection.point.x()));
    east.push_back(extent.east(detection.point.y()));
    object.push_back(static_cast<std::uint16_t>(detection.object));
  }
  return {{"time_s", packed(times)},
          {"north", packed(north)},
          {"east", packed(east)},
          {"object", packed(object)}};
}

// Other aircraft: numbers of a motion that is not there are none.
Json traffic_json(const StoredRun& run) {
  Json all = Json::array();
  for (const StoredTraffic& each : run.traffic) {
    Json traffic = json::to_json(each.what);
    std::vector<float> motions;
    for (const TrafficMotion& m : each.path.motions()) {
      const double place =
          is_there(m.phase) ? m.position.x() : std::numeric_limits<double>::quiet_NaN();
      for (const double value :
           {m.time.seconds(), place, m.position.y(), m.velocity.x(), m.velocity.y()})
        motions.push_back(static_cast<float>(value));
    }
    traffic["motions"] = packed(motions);
    all.push_back(std::move(traffic));
  }
  return all;
}

// Where firm tracks had them.
Json traffic_beliefs_json(const StoredRun& run) {
  std::vector<float> beliefs;
  for (const TrafficBeliefRecord& r : run.traffic_beliefs)
    for (const double value :
         {r.time.seconds(), r.belief.position.x(), r.belief.position.y(),
          r.belief.horizontal_sd, -r.belief.position.z(), r.belief.velocity.x(),
          r.belief.velocity.y(), -r.belief.velocity.z(),
          static_cast<double>(r.believer.value), static_cast<double>(r.belief.track)})
      beliefs.push_back(static_cast<float>(value));
  return packed(beliefs);
}

Json ring_json(const geo::Ring& ring) {
  Json places = Json::array();
  for (const Vec2& p : ring) places.push_back({p.x(), p.y()});
  return places;
}

// No-fly zones with the times in which they were in force.
Json zones_json(const StoredRun& run) {
  Json zones = Json::array();
  for (const ZoneRecord& record : run.zones) {
    const Zone& zone = record.change.zone;
    for (Json& other : zones)  // a new one replaces that of the same name
      if (other["name"] == zone.name && other["off_s"].is_null())
        other["off_s"] = record.time.seconds();
    if (!record.change.on) continue;
    Json off = nullptr;
    if (std::isfinite(zone.until)) off = zone.until;
    zones.push_back({{"name", zone.name},
                     {"on_s", std::max(record.time.seconds(), zone.from)},
                     {"off_s", off},
                     {"ring", ring_json(outline(zone, 0.5))}});
  }
  return zones;
}

// What of a mission's goal has a place on the map.
struct GoalShape {
  std::vector<geo::Ring> areas, lines;

  void operator()(const SurveyGoal& goal) {
    areas.push_back(goal.area);
    areas.insert(areas.end(), goal.holes.begin(), goal.holes.end());
  }
  void operator()(const PatrolGoal& goal) {
    lines.push_back(goal.line);
    if (goal.closed) lines.back().push_back(Vec2(goal.line.front()));
  }
  void operator()(const TrackGoal&) {}
  void operator()(const PerimeterGoal&) {}
  void operator()(const FormationGoal&) {}
  void operator()(const OpenGoal&) {}
};

Json missions_json(const StoredRun& run) {
  Json missions = Json::array();
  for (const MissionRecord& record : run.missions) {
    if (record.change.state != MissionState::kBegun) continue;
    GoalShape shape;
    std::visit(shape, record.change.goal);
    if (shape.areas.empty() && shape.lines.empty()) continue;
    Json areas = Json::array(), lines = Json::array();
    for (const geo::Ring& ring : shape.areas) areas.push_back(ring_json(ring));
    for (const geo::Ring& line : shape.lines) lines.push_back(ring_json(line));
    missions.push_back({{"name", record.change.mission},
                        {"begun_s", record.time.seconds()},
                        {"areas", std::move(areas)},
                        {"lines", std::move(lines)}});
  }
  return missions;
}

Json terrain_json(const TerrainRow& terrain) {
  float low = std::numeric_limits<float>::infinity(), high = -low;
  for (const float height : terrain.heights)
    if (std::isfinite(height)) {
      low = std::min(low, height);
      high = std::max(high, height);
    }
  if (!(low <= high)) return nullptr;
  const double step = std::max(double{high} - double{low}, 1.0) / kLevels;
  Shorts heights;
  for (const float height : terrain.heights)
    heights.push_back(std::isfinite(height) ? level((double{height} - double{low}) / step)
                                            : std::uint16_t{0});
  return {{"rows", terrain.rows},
          {"columns", terrain.columns},
          {"low_north_m", terrain.low.x()},
          {"low_east_m", terrain.low.y()},
          {"spacing_m", terrain.spacing},
          {"low_m", low},
          {"step_m", step},
          {"heights", packed(heights)}};
}

}  // namespace

Json map_json(const StoredRun& run) {
  const Extent extent = extent_of(run);
  if (extent.empty()) return nullptr;
  const double sigma_step = std::max(largest_sigma(run), 1e-3) / kLevels;
  Json map = {{"low_north_m", extent.low().x()},
              {"low_east_m", extent.low().y()},
              {"step_m", extent.step()},
              {"sigma_step_m", sigma_step},
              {"tracks", tracks_json(run, extent)},
              {"truth", truth_json(run, extent)},
              {"belief", belief_json(run, extent, sigma_step)},
              {"ahead", ahead_json(run, extent)},
              {"crossings", crossings_json(run, extent)},
              {"objects", objects_json(run)},
              {"detections", detections_json(run, extent)},
              {"traffic", traffic_json(run)},
              {"traffic_beliefs", traffic_beliefs_json(run)},
              {"zones", zones_json(run)},
              {"missions", missions_json(run)}};
  if (run.terrain)
    if (Json terrain = terrain_json(*run.terrain); !terrain.is_null())
      map["terrain"] = std::move(terrain);
  return map;
}

}  // namespace skein::record
