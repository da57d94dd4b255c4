// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "skein/base/time.h"
#include "skein/data/vehicle/air.h"
#include "skein/data/vehicle/control.h"
#include "skein/data/vehicle/vehicle.h"
#include "skein/role/plant.h"
#include "skein/role/terrain.h"
#include "skein/role/turbulence.h"
#include "skein/role/wind_field.h"

namespace skein {

/// A plant on its way from one step of the run to the next, in steps of its own: the air
/// gusts, the plant moves, the ground is met.
///
/// High above the ground its height is taken once, and at the end.
class PlantFlight {
 public:
  /// All references outlive it.
  /// @param name        of the vehicle.
  /// @param turbulence  null: none.
  PlantFlight(const std::string& name, const Plant& plant, Turbulence* turbulence,
              VehicleState& state, Air& air, const Terrain& terrain,
              const WindField& wind);

  /// Moves the plant by `dt` [s] from `now` on.
  /// @param last  of this flight: the ground is looked for at any height.
  /// @returns  the accident that has ended the vehicle; none: it goes on.
  std::optional<std::string> step(Time now, const Control& control, double dt, bool last);

  /// Below the vehicle, above mean sea level [m].
  double ground_msl() const { return ground_; }

 private:
  double ground_below() const;
  bool hits_hillside() const;

  const std::string& name_;
  const Plant& plant_;
  Turbulence* turbulence_;
  VehicleState& state_;
  Air& air_;
  const Terrain& terrain_;
  const WindField& wind_;
  VehicleState before_;  // at the begin
  double ground_;
  bool near_ground_;
};

}  // namespace skein
