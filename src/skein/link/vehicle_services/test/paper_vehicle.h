// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "skein/data/vehicle/vehicle_request.h"
#include "skein/link/vehicle_services/vehicle_snapshot.h"

namespace skein::vehicle_services {

/// The simplest simulation that does what it is asked: it goes straight to where it is
/// sent, and climbs on the spot.
class PaperVehicle {
 public:
  explicit PaperVehicle(const VehicleSnapshot& start) : snapshot(start) {}

  void obey(const VehicleRequest& request) {
    std::visit([this](const auto& r) { obey_one(r); }, request);
  }

  void step(double dt) {
    const VehicleCondition& condition = snapshot.condition;
    if (!condition.armed) return;
    switch (condition.mode) {
      case VehicleMode::kTakeOff:
        snapshot.condition.on_ground = false;
        if (approach({here().x(), here().y(), -target_msl_}, dt)) set(VehicleMode::kHold);
        break;
      case VehicleMode::kGuided:
        if (place_) approach(*place_, dt);
        break;
      case VehicleMode::kMission:
        fly_mission(dt);
        break;
      case VehicleMode::kReturn: {
        const Vec3 above(snapshot.home_N.x(), snapshot.home_N.y(), here().z());
        if (approach(above, dt)) set(VehicleMode::kLand);
        break;
      }
      case VehicleMode::kLand:
        if (approach({here().x(), here().y(), -snapshot.ground_msl}, dt)) {
          snapshot.condition.on_ground = true;
          snapshot.condition.armed = false;
        }
        break;
      default:
        break;
    }
  }

  VehicleSnapshot snapshot;
  std::vector<MissionItem> mission;
  std::map<std::string, int> obeyed;  ///< requests by their kind
  double airspeed = 20;

 private:
  Vec3& here() { return snapshot.motion.p_N; }
  void set(VehicleMode mode) { snapshot.condition.mode = mode; }

  bool approach(const Vec3& there, double dt) {
    const Vec3 way = there - here();
    const double step = airspeed * dt;
    snapshot.motion.v_N =
        way.norm() > step ? Vec3(way.normalized() * airspeed) : Vec3(Vec3::Zero());
    here() = way.norm() > step ? Vec3(here() + way.normalized() * step) : there;
    return way.norm() <= step;
  }

  void fly_mission(double dt) {
    MissionProgress& progress = snapshot.progress;
    if (progress.current >= mission.size()) return;
    const MissionItem& item = mission[progress.current];
    snapshot.condition.on_ground = false;
    if (item.kind == MissionItem::Kind::kSpeed) airspeed = item.airspeed;
    if (item.kind != MissionItem::Kind::kSpeed && !approach(item.p_N, dt)) return;
    if (item.kind == MissionItem::Kind::kLand) {
      snapshot.condition.on_ground = true;
      snapshot.condition.armed = false;
    }
    if (progress.current + 1U < mission.size())
      ++progress.current;
    else
      progress.finished = true;
  }

  void obey_one(const ArmRequest& r) {
    ++obeyed["arm"];
    snapshot.condition.armed = r.arm;
  }
  void obey_one(const ModeRequest& r) {
    ++obeyed["mode"];
    place_.reset();
    set(r.mode);
  }
  void obey_one(const TakeOffRequest& r) {
    ++obeyed["take-off"];
    target_msl_ = r.altitude_msl;
    set(VehicleMode::kTakeOff);
  }
  void obey_one(const LandRequest&) { set(VehicleMode::kLand); }
  void obey_one(const FlyToRequest& r) {
    ++obeyed["fly-to"];
    place_ = r.p_N;
  }
  void obey_one(const BankSetpoint&) { ++obeyed["bank"]; }
  void obey_one(const TrackSetpoint& r) {
    ++obeyed["track"];
    place_ = r.p_N;
  }
  void obey_one(const SpeedRequest& r) {
    ++obeyed["speed"];
    airspeed = r.airspeed;
  }
  void obey_one(const MissionUpload& r) {
    ++obeyed["upload"];
    mission = r.items;
    snapshot.progress = {};
  }
  void obey_one(const MissionStart& r) {
    ++obeyed["start"];
    snapshot.progress = {r.item, false};
    set(VehicleMode::kMission);
  }
  void obey_one(const PilotRequest&) { ++obeyed["pilot"]; }
  // Of a virtual world it sees nothing.
  void obey_one(const ObstacleDistances&) {}
  void obey_one(const FenceUpload&) {}
  void obey_one(const PositionFix&) {}

  double target_msl_ = 0;
  std::optional<Vec3> place_;
};

}  // namespace skein::vehicle_services
