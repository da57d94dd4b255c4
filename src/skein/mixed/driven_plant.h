// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "skein/base/result.h"
#include "skein/base/time.h"
#include "skein/data/vehicle/air.h"
#include "skein/data/vehicle/control.h"
#include "skein/data/vehicle/fault.h"
#include "skein/data/vehicle/vehicle.h"
#include "skein/data/vehicle/vehicle_report.h"
#include "skein/role/autopilot_drive.h"
#include "skein/role/fault_schedule.h"
#include "skein/role/plant.h"
#include "skein/role/plant_flight.h"
#include "skein/role/turbulence.h"
#include "skein/role/vehicle.h"

namespace skein::mixed {

/// What a plant that an outside autopilot moves is made of.
struct DrivenPlantParts {
  std::string name;  ///< of the vehicle
  std::shared_ptr<const Plant> plant;
  std::unique_ptr<Turbulence> turbulence;  ///< null: none
  std::unique_ptr<AutopilotDrive> drive;
  std::size_t channels = 0;             ///< that the plant takes
  std::vector<VehicleFault> faults;     ///< that are going to happen
  std::vector<VehicleFault> breakable;  ///< all that can be made to fail, by name
  Time step;           ///< of plant and autopilot; divides the run's step
  VehicleState state;  ///< the truth
  Air air;             ///< that it flies in
};

/// A plant of the simulation whose autopilot is elsewhere.
///
/// Each of its steps: the plant moves under the last known actuator outputs, the
/// autopilot is given what its sensors feel of it and answers with new ones. Its specific
/// force is the mean of the step:
///
///   f_B = R_NB^T ((v(t + dt) - v(t)) / dt - g)      each axis within +-16 g
///
/// What comes from outside, outputs and events, is given out by take_reports(): with that
/// the plant flies the same again (RecordedDrive).
class DrivenPlant {
 public:
  explicit DrivenPlant(DrivenPlantParts parts);

  Result<void> open() { return parts_.drive->open(); }
  bool real_time() const { return parts_.drive->real_time(); }
  void begin(const Surroundings& world, Time now);
  /// A step of the run begins.
  void begin_step(Time now);
  void advance(const Surroundings& world, Time now, Time until);

  const VehicleState& state() const { return parts_.state; }
  const Air& air() const { return parts_.air; }
  const FaultSchedule::InForce& faults() const { return faults_.in_force(); }
  bool lost() const { return lost_; }
  Result<void> set_fault(const std::string& part, bool fails, Time now) {
    return faults_.set(parts_.name, part, fails, now);
  }
  /// Both append what has come up since the last call.
  void take_events(std::vector<VehicleEvent>& out);
  void take_reports(std::vector<VehicleReport>& out);

 private:
  Control control() const;
  void exchange(Time now, const Vec3& v_before_N, double ground_msl);
  void note_outputs();

  DrivenPlantParts parts_;
  FaultSchedule faults_;
  std::array<float, Actuators::kMaxChannels> outputs_{};
  ActuatorOutputs applied_;  // in this step of the run
  std::vector<OutsideEvent> outside_;
  std::vector<VehicleEvent> events_;
  std::vector<VehicleReport> reports_;
  bool lost_ = false;
};

}  // namespace skein::mixed
