// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "skein/data/vehicle/air.h"
#include "skein/data/vehicle/fault.h"
#include "skein/mixed/motion_predictor.h"
#include "skein/role/autopilot.h"
#include "skein/role/fault_schedule.h"
#include "skein/role/flight_model.h"
#include "skein/role/sensor.h"
#include "skein/role/vehicle.h"

namespace skein::mixed {

/// What a vehicle whose flight model is outside is made of here.
struct FlightModelVehicleParts {
  std::string name;
  std::unique_ptr<FlightModel> model;
  std::unique_ptr<Autopilot> autopilot;          ///< takes actuators
  std::vector<std::unique_ptr<Sensor>> sensors;  ///< of the autopilot
  std::vector<std::unique_ptr<Sensor>> payload;  ///< of the agent
  std::vector<VehicleFault> faults;     ///< that are going to happen: sensors, link
  std::vector<VehicleFault> breakable;  ///< all that can be made to fail, by name
  VehicleState state;                   ///< until the model says another
  Air air;
  Time max_age = Time::from_seconds(0.5);  ///< older motions are good for nothing
};

/// A vehicle whose autopilot and sensors are here and whose flight model is in another
/// program. What that says, carried on to now (MotionPredictor), is the truth.
///
/// Once in each step of the run the sensors measure it, and the autopilot says what the
/// actuators do; they do so until the next step. A model that is silent for longer than
/// max_age is not flown: its actuators stay, the payload sees nothing, and the truth
/// stands still. When it is heard again, or begins anew, the autopilot's flight begins
/// again there, with the last command.
///
/// Events: `flight-model-heard`, `flight-model-silent`, `flight-model-back`,
/// `flight-model-reset`, and what becomes of its program.
///
/// Everything that comes from outside comes from FlightModel and is given out by
/// take_reports(), so a run can be done again with what was recorded.
class FlightModelVehicle final : public Vehicle {
 public:
  explicit FlightModelVehicle(FlightModelVehicleParts parts);

  Result<void> open() override { return parts_.model->open(); }
  bool real_time() const override { return true; }
  void begin(const Surroundings& world, Time now) override;
  void begin_step(Time now) override;
  void look(const Surroundings& world, Time now, PayloadSamples& out) override;
  void advance(const Surroundings& world, Time now, Time until,
               const Vehicle* next) override;
  NavEstimate estimate() const override { return parts_.autopilot->estimate(); }
  AutopilotStatus status() const override { return parts_.autopilot->status(); }
  void command(const AutopilotCommand& command) override;
  CommandFate command_fate() const override;
  void set_return(const ReturnRoute& route) override {
    parts_.autopilot->set_return(route);
  }
  void set_region_of_interest(const RegionOfInterest& region) override {
    region_of_interest_ = region.place_N;
  }
  void pilot(const PilotInput& sticks) override { parts_.autopilot->sense(sticks); }
  void ground_received(Time now) override { parts_.autopilot->sense(LinkSample{now}); }
  bool link_works() const override { return !faults_.in_force().link; }
  const VehicleState* truth() const override { return &parts_.state; }
  void take_events(std::vector<VehicleEvent>& out) override;
  void take_reports(std::vector<VehicleReport>& out) override;
  /// Its sensors, and "link". What the flight model has is the program's to break.
  Result<void> set_fault(const std::string& part, bool fails, Time now) override {
    return faults_.set(parts_.name, part, fails, now);
  }

 private:
  struct Listener;
  /// Whether the model is there.
  enum class Contact { kNone, kHeard, kSilent };

  void hear(const VehicleMotion& motion);
  void begin_flight(Time now);
  void place(Time now);
  SensorView view(const Surroundings& world, Time now) const;
  void sense(const Surroundings& world, Time now);

  FlightModelVehicleParts parts_;
  MotionPredictor motion_;
  FaultSchedule faults_;
  Contact contact_ = Contact::kNone;
  bool begins_ = false;  // the autopilot's flight, with the next step
  std::optional<Vec3> region_of_interest_;
  std::optional<AutopilotCommand> commanded_;
  Actuators actuators_;  // what they do now
  std::vector<SensorSample> samples_;
  std::vector<VehicleReport> reports_;
  std::optional<Time> received_;  // the step, last
  std::vector<VehicleEvent> events_;
  std::uint32_t commands_ = 0;
  int refusals_before_ = 0;  // when the last command was given
  bool answered_ = false;
};

}  // namespace skein::mixed
