// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "skein/base/time.h"
#include "skein/data/vehicle/agent_step.h"
#include "skein/data/vehicle/entity_report.h"
#include "skein/data/vehicle/vehicle_report.h"
#include "skein/mixed/motion_tracker.h"
#include "skein/mixed/recorded_port.h"
#include "skein/role/agent.h"
#include "skein/role/entity_port.h"
#include "skein/role/sensor.h"
#include "skein/role/vehicle.h"

namespace skein::mixed {

/// What an entity in another program is made of here.
struct RemoteEntityParts {
  std::string name;
  EntityId self;
  std::unique_ptr<EntityPort> port;
  std::vector<std::unique_ptr<Sensor>> payload;  ///< virtual: they look at the world here
  bool hovers = false;
  NavEstimate start;                     ///< where it is believed until it says so
  Time max_age = Time::from_seconds(5);  ///< older states are good for nothing
  /// Its messages go over a modem, by which it may be heard when its link is down, and
  /// not be when that is up. The port says so: "neighbour-found", "neighbour-lost".
  bool by_modem = false;
};

/// What the vehicle and the agent of such an entity share.
struct RemoteEntity {
  std::unique_ptr<EntityPort> port;
  AgentOutput said;  ///< since the agent's last step
};

/// The vehicle of an entity whose agent, autopilot and asset run in another program. Its
/// state is what that program says, carried on to now; its payload is here, and what it
/// measures is sent there.
///
/// Everything it learns comes in by its port and is given out by take_reports(), so a run
/// can be done again with what was recorded.
class RemoteVehicle final : public Vehicle {
 public:
  explicit RemoteVehicle(RemoteEntityParts parts);

  /// What stands here for its agent; it shares the port.
  std::unique_ptr<Agent> agent() const;

  bool real_time() const override { return true; }
  void begin(const Surroundings& world, Time now) override;
  void begin_step(Time now) override;
  void look(const Surroundings& world, Time now, PayloadSamples& out) override;
  void advance(const Surroundings& world, Time now, Time until,
               const Vehicle* next) override;
  NavEstimate estimate() const override { return estimate_; }
  AutopilotStatus status() const override;
  // Its agent commands it where it is.
  void command(const AutopilotCommand&) override {}
  CommandFate command_fate() const override { return {}; }
  void set_return(const ReturnRoute&) override {}
  void pilot(const PilotInput& sticks) override;
  void ground_received(Time) override {}
  bool link_works() const override { return (by_modem_ ? heard_ : up_) && !blocked_; }
  const VehicleState* truth() const override { return truth_ ? &*truth_ : nullptr; }
  bool lost() const override { return state_ && state_->lost; }
  void take_events(std::vector<VehicleEvent>& out) override;
  void take_reports(std::vector<VehicleReport>& out) override;
  /// Part "link": nothing comes in or goes out any more. Other parts are the other
  /// program's.
  Result<void> set_fault(const std::string& part, bool fails, Time now) override;

 private:
  struct Listener;
  struct SayingListener;

  bool fresh(Time now) const { return state_ && now - state_->nav.time <= max_age_; }
  void carry_on(Time now);

  std::string name_;
  EntityId self_;
  std::shared_ptr<RemoteEntity> shared_;
  std::vector<std::unique_ptr<Sensor>> payload_;
  Time max_age_;
  MotionTracker believed_, true_;
  NavEstimate estimate_;               // at the beginning of the step
  std::optional<VehicleState> truth_;  // the same
  std::optional<RemoteState> state_;   // the newest
  std::optional<Vec3> region_of_interest_;
  std::vector<VehicleReport> reports_;  // of this step
  std::vector<VehicleEvent> events_;
  Time now_;
  bool by_modem_;
  bool up_ = false, heard_ = false, blocked_ = false, stale_ = false;
};

/// A port that says again what was recorded, for a run that is done again; what is sent
/// goes nowhere.
class RecordedEntityPort final : public EntityPort {
 public:
  /// @param reports  by rising time.
  explicit RecordedEntityPort(std::vector<TimedReport> reports)
      : recorded_(std::move(reports), false) {}

  void receive(Time now, std::vector<VehicleReport>& out) override {
    recorded_.receive(now, out);
  }
  void send(Time, EntityInput) override {}

 private:
  RecordedPort recorded_;
};

}  // namespace skein::mixed
