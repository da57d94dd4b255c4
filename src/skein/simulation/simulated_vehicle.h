// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "skein/data/vehicle/air.h"
#include "skein/data/vehicle/fault.h"
#include "skein/role/autopilot.h"
#include "skein/role/fault_schedule.h"
#include "skein/role/plant.h"
#include "skein/role/sensor.h"
#include "skein/role/turbulence.h"
#include "skein/role/vehicle.h"
#include "skein/simulation/working_set.h"

namespace skein::simulation {

struct Entity;

/// What a simulated vehicle is made of.
struct VehicleParts {
  std::string name;
  std::shared_ptr<const Plant> plant;
  std::unique_ptr<Autopilot> autopilot;
  std::vector<std::unique_ptr<Sensor>> sensors;  ///< of the autopilot
  std::vector<std::unique_ptr<Sensor>> payload;  ///< of the agent
  std::unique_ptr<Turbulence> turbulence;        ///< null: none
  std::vector<VehicleFault> faults;              ///< that are going to happen
  std::vector<VehicleFault> breakable;  ///< all that can be made to fail, by name
  Time step;           ///< of sensors, autopilot and plant; divides the run's step
  VehicleState state;  ///< the truth
  Air air;             ///< that it flies in
};

/// A vehicle whose plant, sensors and autopilot are models.
///
/// Each of its steps: the autopilot turns estimate and command into control, the air
/// gusts, the plant moves, the flight sensors measure the new state.
class SimulatedVehicle final : public Vehicle {
 public:
  explicit SimulatedVehicle(VehicleParts parts);

  void begin(const Surroundings& world, Time now) override;
  void begin_step(Time now) override;
  void look(const Surroundings& world, Time now, PayloadSamples& out) override;
  void advance(const Surroundings& world, Time now, Time until,
               const Vehicle* next) override;
  void prefetch(std::int64_t part, std::int64_t parts) const override {
    working_set_.prefetch(part, parts);
  }
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
  bool lost() const override { return lost_; }
  void take_events(std::vector<VehicleEvent>& out) override;
  Result<void> set_fault(const std::string& part, bool fails, Time now) override;

  const VehicleParts& parts() const { return parts_; }

 private:
  SensorView view(const Surroundings& world, Time now) const;
  void sample_one(Sensor& sensor, bool silent, const SensorView& view,
                  std::vector<SensorSample>& out) const;
  void sense(const Surroundings& world, Time now);

  VehicleParts parts_;
  WorkingSet working_set_;
  std::vector<SensorSample> flight_samples_;  // of one step, kept for its memory
  std::optional<Vec3> region_of_interest_;    // where gimbals look
  FaultSchedule faults_;
  std::vector<VehicleEvent> events_;
  std::uint32_t commands_ = 0;
  int refusals_before_ = 0;  // when the last command was given
  bool lost_ = false, flew_ = false, answered_ = false;
};

/// The parts of an entity whose vehicle is simulated. Fails: Bug for any other.
const VehicleParts& parts_of(const Entity& entity);

}  // namespace skein::simulation
