// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <filesystem>
#include <string>

#include "skein/base/random.h"
#include "skein/data/radio/message.h"
#include "skein/geo/vec.h"
#include "skein/role/recorder.h"

namespace skein::record {

/// A folder of its own for one test, removed at the end.
class TemporaryFolder {
 public:
  explicit TemporaryFolder(const std::string& name)
      : path_(std::filesystem::temp_directory_path() /
              ("skein_" + name + "_" + std::to_string(::getpid()))) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline geo::Ring circle(const Vec2& centre, double radius, int count) {
  geo::Ring ring;
  for (int i = 0; i < count; ++i)
    ring.push_back(centre + radius * geo::unit(2 * geo::kPi * i / count));
  return ring;
}

/// A belief in a circle, every point with the same deviation.
inline BoundaryEstimate believed_circle(Time time, const Vec2& centre, double radius,
                                        double sigma, int count = 60) {
  BoundaryEstimate belief;
  belief.time = time;
  belief.rings.emplace_back();
  for (const Vec2& p : circle(centre, radius, count))
    belief.rings[0].push_back({p, (p - centre).normalized(), sigma, 0.05, 0.2});
  return belief;
}

/// Fills a recorder as a simulation would: aircraft that circle along a growing fire,
/// crossing it now and then. Same arguments, same calls.
inline void record_sample(Recorder& recorder, int seconds, int aircraft = 2,
                          int rows_per_second = 10) {
  RandomStream random(7, 0, Purpose::kTest);
  const EntityId ground{0};
  recorder.record(EntityRecord{ground, "ground", "ground_station"});
  for (int a = 1; a <= aircraft; ++a)
    recorder.record(EntityRecord{EntityId{static_cast<std::uint32_t>(a)},
                                 "uav" + std::to_string(a), "aircraft"});
  recorder.record(GroundObject{0, "car", ObjectClass::kVehicle});
  recorder.record(GroundObject{1, "person", ObjectClass::kPerson});  // never seen
  const ObjectMotion car{Time(), 0, {40, -30}, {0.1, 0}};
  recorder.record(car);
  recorder.record(ObjectMotion{Time(), 1, {-500, 0}, {0, 0}});
  std::uint64_t number = 0;
  for (int step = 0; step <= seconds * rows_per_second; ++step) {
    const Time now = Time::from_seconds(static_cast<double>(step) / rows_per_second);
    const double t = now.seconds();
    const double radius = 300 + 0.2 * t;
    const bool whole_second = step % rows_per_second == 0;
    for (int a = 1; a <= aircraft; ++a) {
      const EntityId id{static_cast<std::uint32_t>(a)};
      const double bearing = 2 * geo::kPi * a / aircraft + 20 * t / radius;
      const double distance = radius + 60 * std::sin(t / 9 + a);
      const Vec2 p = distance * geo::unit(bearing);
      VehicleState state;
      state.p_N = Vec3(p.x(), p.y(), -400);
      state.v_N = Vec3(-20 * std::sin(bearing), 20 * std::cos(bearing), 0);
      state.airspeed = 20;
      state.q_NB = geo::from_euler({0, 0, bearing + geo::kPi / 2});
      recorder.record(TruthRecord{now, id, state});
      NavEstimate estimate;
      estimate.time = now;
      estimate.p_N = state.p_N + Vec3(random.normal(), random.normal(), 0);
      estimate.v_N = state.v_N;
      estimate.heading = geo::yaw(state.q_NB);
      estimate.position_sd = 1;
      AutopilotStatus status;
      status.follows = a == 1;
      status.cross_track = 0.5 * std::sin(t);
      if (a == 1) {
        status.charge = 1 - t / 1000;
        status.reserve = status.charge - 0.1;
        status.endurance = 1000 - t;
      }
      recorder.record(EstimateRecord{id, estimate, status});
      if (!whole_second) continue;
      // A camera and a LiDAR of three beams, the last without a hit.
      if (a == 1) {
        recorder.record(Footprint{
            now,
            id,
            0,
            {{p + Vec2(9, -9), p + Vec2(9, 9), p + Vec2(-9, 9), p + Vec2(-9, -9)}}});
        if (step % (10 * rows_per_second) == 0)
          recorder.record(
              Detection{now, id, 0, car.object, car.at(now) + Vec2(3, 4), 2.5});
        recorder.record(RangeScan{
            now,
            id,
            1,
            {{now, {0, 0, 1}, 40}, {now, {0, 0.6, 0.8}, 50}, {now, {0, 1, 0}, 0}}});
      }
      const FireReading reading{now, id, p, 1.5, distance < radius};
      recorder.record(reading);
      const double before =
          distance - 60 * (std::sin(t / 9 + a) - std::sin((t - 1) / 9 + a));
      if ((before < radius) != (distance < radius))
        recorder.record(
            Crossing{now, id, radius * geo::unit(bearing), p, 1.5, distance < radius});
      const Message message{id, ground, ++number, now, reading};
      MessageRecord said{message, now + Time::from_seconds(0.05), 32};
      said.lost = random.uniform() < 0.05;
      if (said.lost) said.cause = LossCause::kRetryLimit;
      recorder.record(said);
      if (step % (60 * rows_per_second) == 0) {
        Task task;
        task.number = static_cast<std::uint32_t>(1 + t);
        task.what.emplace<FlyTo>(FlyTo{p});
        const Message order{ground, id, ++number, now, task};
        recorder.record(MessageRecord{order, now + Time::from_seconds(0.05), 24, false});
      }
    }
    if (step == 60 * rows_per_second)
      recorder.record(Event{now, ground, EventKind::kAllocation,
                            "every aircraft has found the fire"});
    if (whole_second && step % (5 * rows_per_second) == 0) {
      const double sigma = 10 + 40 * std::exp(-t / 200);
      BoundaryEstimate belief =
          believed_circle(now, {0, 0}, radius + sigma * std::sin(t / 50), sigma, 80);
      for (BoundaryPoint& point : belief.rings[0])
        point.position += 0.6 * sigma * random.normal() * point.normal;
      recorder.record(
          PerimeterRecord{now, ground, {circle({0, 0}, radius, 400)}, belief});
    }
    // Aircraft that hear the ground less well the further back they stand in the list.
    if (whole_second && step > 0 && step % (10 * rows_per_second) == 0) {
      for (int a = 0; a <= aircraft; ++a) {
        const EntityId id{static_cast<std::uint32_t>(a)};
        recorder.record(RadioUseRecord{
            now, id, {20, 0.1, a == 0 ? 0.3 : 0.1, 2, 1, a == 1 ? 3u : 0u, 0, 9}});
        if (a > 0)
          recorder.record(
              LinkUseRecord{now, {id, ground, 9, 1, -70.0 - 5 * a, 20.0, 0.02}});
      }
    }
    if (!recorder.step_done(now)) return;
  }
}

}  // namespace skein::record
