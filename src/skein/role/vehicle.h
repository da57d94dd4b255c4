// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "skein/base/result.h"
#include "skein/base/time.h"
#include "skein/data/airspace/zone.h"
#include "skein/data/event/event_kind.h"
#include "skein/data/perimeter/object.h"
#include "skein/data/traffic/traffic.h"
#include "skein/data/vehicle/autopilot.h"
#include "skein/data/vehicle/payload.h"
#include "skein/data/vehicle/pilot.h"
#include "skein/data/vehicle/sensing.h"
#include "skein/data/vehicle/vehicle.h"
#include "skein/data/vehicle/vehicle_report.h"
#include "skein/role/phenomenon.h"
#include "skein/role/terrain.h"
#include "skein/role/wind_field.h"

namespace skein {

/// The world that a vehicle is in. During a phase of a step any thread may read it.
struct Surroundings {
  const Terrain& terrain;
  const WindField& wind;
  Phenomena phenomena = {};
  std::span<const VisibleObject> objects = {};
  std::span<const VisibleAircraft> aircraft = {};
};

/// Something that happened to a vehicle, for the records.
struct VehicleEvent {
  EventLabel kind;
  std::string text;  ///< for people
};

/// What the payload has measured: samples of one sensor follow one another.
struct PayloadSamples {
  std::vector<SensorSample> samples;
  std::vector<std::size_t> ends;  ///< where those of each sensor end
};

/// A vehicle with its autopilot, as the simulation and its agent see it: simulated,
/// behind a link, or in another process; nobody above knows which.
///
/// Threads: one at a time; vehicles move in parallel, and each writes only itself.
class Vehicle {
 public:
  virtual ~Vehicle() = default;

  /// Opens what it needs outside of the run: ports, programs. Called once, before the
  /// run, by the thread that runs it; not for a run that is done again. Fails: what
  /// cannot be opened.
  virtual Result<void> open() { return {}; }

  /// It moves by the wall clock, and so must the run.
  virtual bool real_time() const { return false; }

  /// It takes part from `now` on, or again.
  virtual void begin(const Surroundings& world, Time now) = 0;

  /// A step of the run begins: what is due at `now` happens to its parts.
  virtual void begin_step(Time /*now*/) {}

  /// Appends what its payload measures at `now`, or has measured since the last call.
  virtual void look(const Surroundings& world, Time now, PayloadSamples& out) = 0;

  /// Moves on from `now` to `until`.
  /// @param next  the vehicle that moves after this one, see prefetch(); may be null.
  virtual void advance(const Surroundings& world, Time now, Time until,
                       const Vehicle* next) = 0;

  /// Has the processor load part of what the next advance() needs, without waiting. Only
  /// speed depends on it.
  /// @param part  from 0 to parts - 1.
  virtual void prefetch(std::int64_t /*part*/, std::int64_t /*parts*/) const {}

  /// What its autopilot believes. Its age is the time since `time`, its quality
  /// `position_sd`.
  virtual NavEstimate estimate() const = 0;
  virtual AutopilotStatus status() const = 0;

  /// Replaces what to do next.
  virtual void command(const AutopilotCommand& command) = 0;
  /// What has become of the last of them.
  virtual CommandFate command_fate() const = 0;
  /// Replaces where returns lead from now on.
  virtual void set_return(const ReturnRoute& route) = 0;
  /// Replaces where its gimbals look from now on; nothing for what has none.
  virtual void set_region_of_interest(const RegionOfInterest& /*region*/) {}

  /// Replaces the no-fly zones in force, for autopilots that keep a fence of their own;
  /// nothing for others.
  virtual void set_zones(std::span<const Zone> /*zones*/) {}

  /// What a safety pilot's sticks say; nothing for what has no receiver here.
  virtual void pilot(const PilotInput& /*sticks*/) {}

  /// A message of the ground station has arrived on board.
  virtual void ground_received(Time now) = 0;
  /// Whether messages go in and out.
  virtual bool link_works() const { return true; }

  /// The true state; null where nobody knows it.
  virtual const VehicleState* truth() const { return nullptr; }

  /// It takes no further part: it is broken, or its motion is no longer finite.
  virtual bool lost() const { return false; }

  /// Appends what has happened since the last call.
  virtual void take_events(std::vector<VehicleEvent>& out) = 0;

  /// Appends what it was told from outside of the run since the last call, for the
  /// records: with it a run can be done again. Nothing for what is simulated.
  virtual void take_reports(std::vector<VehicleReport>& /*out*/) {}

  /// Its agent shall command it again, which somebody else had taken, or its own
  /// failsafe. Fails: kBadInput when its agent commands it, or a pilot's sticks fly it.
  virtual Result<void> hand_back(Time /*now*/) {
    return Error{ErrorCode::kBadInput, "", "it is commanded by its agent.",
                 "Only what was taken from its agent can be handed back."};
  }

  /// Makes a part fail from `now` on, or work again.
  /// Fails: kBadInput when there is no such part, or it cannot be made to fail.
  virtual Result<void> set_fault(const std::string& part, bool fails, Time now) = 0;
};

}  // namespace skein
