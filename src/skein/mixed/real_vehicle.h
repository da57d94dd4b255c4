// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "skein/base/time.h"
#include "skein/data/vehicle/vehicle_report.h"
#include "skein/mixed/command_monitor.h"
#include "skein/mixed/driven_plant.h"
#include "skein/mixed/flight_director.h"
#include "skein/mixed/motion_tracker.h"
#include "skein/mixed/position_monitor.h"
#include "skein/mixed/virtual_feeds.h"
#include "skein/role/autopilot.h"
#include "skein/role/sensor.h"
#include "skein/role/vehicle.h"
#include "skein/role/vehicle_port.h"

namespace skein::mixed {

/// What a vehicle behind a link is made of here.
struct RealVehicleParts {
  std::string name;
  std::unique_ptr<VehiclePort> port;
  /// Guidance: turns commands into setpoints, from the motion that it is given.
  std::unique_ptr<Autopilot> guidance;
  std::vector<std::unique_ptr<Sensor>> payload;  ///< virtual: they look at the world here
  FlightLimits limits;
  NavEstimate start;                     ///< where it is believed until it says so
  Time max_age = Time::from_seconds(5);  ///< older motions are good for nothing
  /// Its plant, where that is simulated here and only its autopilot is elsewhere.
  std::unique_ptr<DrivenPlant> body = nullptr;
  VirtualFeedOptions feeds = {};  ///< what it is sent of the virtual world
};

/// A vehicle that is not simulated here: a real aircraft, or one in another program. Its
/// asset, autopilot and flight sensors are at the far end of a link; what looks at the
/// virtual world, its payload, is here.
///
/// Its state is what it says, carried on to now (MotionTracker); its age is seen in the
/// estimate. It is not commanded while that is no position (PositionMonitor), nor while
/// somebody else has it (ControlMonitor). Commands of the agent become setpoints at each
/// step of the run, by the guidance; arming, taking off, modes and landing are
/// FlightDirector's. Nobody knows the truth. One that flies and cannot be commanded
/// (CommandMonitor) is brought back.
///
/// With a body here (DrivenPlant) only the autopilot is elsewhere: then the truth is the
/// body's, which the payload looks from, and its parts can be made to fail.
///
/// Everything it learns comes in by its port and is given out by take_reports(), so a run
/// can be done again with what was recorded.
class RealVehicle final : public Vehicle {
 public:
  explicit RealVehicle(RealVehicleParts parts);

  Result<void> open() override {
    if (auto opened = parts_.port->open(); !opened) return opened;
    return parts_.body ? parts_.body->open() : Result<void>();
  }
  bool real_time() const override { return !parts_.body || parts_.body->real_time(); }
  void begin(const Surroundings& world, Time now) override;
  void begin_step(Time now) override;
  void look(const Surroundings& world, Time now, PayloadSamples& out) override;
  void advance(const Surroundings& world, Time now, Time until,
               const Vehicle* next) override;
  NavEstimate estimate() const override { return estimate_; }
  AutopilotStatus status() const override;
  void command(const AutopilotCommand& command) override;
  CommandFate command_fate() const override;
  void set_return(const ReturnRoute& route) override;
  void set_region_of_interest(const RegionOfInterest& region) override {
    region_of_interest_ = region.place_N;
  }
  void set_zones(std::span<const Zone> zones) override { feeds_.set_zones(zones); }
  void ground_received(Time /*now*/) override {}
  bool link_works() const override { return director_.up(); }
  const VehicleState* truth() const override {
    return parts_.body ? &parts_.body->state() : nullptr;
  }
  bool lost() const override { return parts_.body && parts_.body->lost(); }
  void take_events(std::vector<VehicleEvent>& out) override;
  void take_reports(std::vector<VehicleReport>& out) override;
  Result<void> hand_back(Time now) override;
  /// Part "link": nothing comes in or goes out any more. Others: of its body.
  Result<void> set_fault(const std::string& part, bool fails, Time now) override;

 private:
  struct Listener;

  void take_in(Time now);
  void note_link(const LinkChange& change);
  void set_blocked(bool blocked);
  std::optional<SensorView> view(const Surroundings& world, Time now, VehicleState& state,
                                 Air& air) const;
  void land_from_above();
  void command_autopilot(const Surroundings& world, Time now, Time until);
  void give(const AutopilotCommand& command);
  void send_setpoint(Time now, double dt);
  void watch_command(Time now);

  RealVehicleParts parts_;
  MotionTracker tracker_;
  FlightDirector director_;
  PositionMonitor position_;
  CommandMonitor monitor_;
  VirtualFeeds feeds_;
  VehicleCondition condition_;
  NavEstimate estimate_;
  std::optional<Vec3> region_of_interest_;
  std::optional<LandRequest> over_landing_;  // it flies to above the point first
  std::vector<VehicleReport> reports_;       // of this step
  std::vector<VehicleEvent> events_;
  std::optional<Time> received_;  // the step, last
  std::uint32_t commands_ = 0;
  int refusals_before_ = 0;  // when the last command was given
  bool blocked_ = false;     // its link was made to fail
  bool up_ = false;          // its link is up, but for that
};

}  // namespace skein::mixed
