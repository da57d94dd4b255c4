// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "skein/assemble/kinds/vehicle_context.h"
#include "skein/base/result.h"
#include "skein/mixed/driven_plant.h"
#include "skein/role/vehicle_port.h"
#include "skein/scenario/fields.h"

namespace skein::assemble {

/// Keys of a vehicle whose autopilot is elsewhere and whose plant may be here.
struct PhysicsChoice {
  enum class Kind { kNone, kArduPilotJson, kPx4Hil, kHilSerial };
  Kind kind = Kind::kNone;
  int instance = 0;
  std::optional<int> port;
  std::string at;
  std::vector<std::string> program;
  std::vector<std::string> environment;
  std::string parameters;
  std::string folder = "runs/autopilots/{name}";
  std::string log = "runs/autopilots/{name}.log";
  bool restart = false;
  std::vector<std::string> outputs;
  Time contact = Time::from_seconds(30);
  Time patience = Time::from_seconds(1);
  std::optional<double> declination;  // [rad]
};

scenario::Fields<PhysicsChoice> physics_fields();

/// The port of a vehicle whose plant is elsewhere too: with its program, if the choice
/// has one.
/// @param link  where the program finds the link to here, asked for when it starts.
std::unique_ptr<VehiclePort> started_port(std::unique_ptr<VehiclePort> port,
                                          const PhysicsChoice& choice, int system,
                                          std::function<std::string()> link,
                                          const VehicleContext& context);

/// A plant here with its autopilot elsewhere.
struct DrivenBody {
  std::unique_ptr<mixed::DrivenPlant> plant;
  /// The run's clock by the steps of the plant; null: it goes by the wall clock.
  std::shared_ptr<const std::atomic<std::int64_t>> clock_ns;
};

/// @param system     MAVLink system id of the vehicle.
/// Fails: kBadInput for a plant without actuators, for steps that do not fit, outputs
///        that move nothing, and faults of sensors that are not here.
Result<DrivenBody> driven_body(const PhysicsChoice& choice, int system,
                               const VehicleContext& context);

}  // namespace skein::assemble
