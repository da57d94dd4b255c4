#pragma once

#include <string>

#include "skein/base/result.h"
#include "skein/data/autopilot.h"
#include "skein/data/event.h"
#include "skein/data/fire.h"
#include "skein/data/message.h"
#include "skein/data/object.h"
#include "skein/data/payload.h"
#include "skein/data/vehicle.h"
#include "skein/data/zone_change.h"
#include "skein/geo/polygon.h"

namespace skein {

/// Keeps what happens in a run. Called by the simulation thread only, in a defined order;
/// everything that is given counts for the content hash.
class Recorder {
 public:
  virtual ~Recorder() = default;

  /// An entity exists. Before anything else about it.
  virtual void entity(EntityId id, const std::string& name, const std::string& kind) = 0;
  virtual void truth(Time time, EntityId id, const VehicleState& state) = 0;
  /// What an autopilot believes and does.
  virtual void estimate(EntityId id, const NavEstimate& estimate,
                        const AutopilotStatus& status) = 0;
  virtual void reading(const FireReading& reading) = 0;
  /// A message that arrived at `arrived`, or was lost (`lost`, then `arrived` is when).
  virtual void message(const Message& message, Time arrived, bool lost) = 0;
  /// The true burnt region and what an agent believes about its boundary at that time.
  virtual void perimeter(Time time, const geo::Region& truth, EntityId believer,
                         const BoundaryEstimate& belief) = 0;
  virtual void event(const Event& event) = 0;
  /// An aircraft has passed the boundary, as the agent that keeps the belief found. May
  /// come later than it happened.
  virtual void crossing(const Crossing& crossing) = 0;

  /// A no-flight zone comes into force for those who have heard of it, or is taken back;
  /// number 0: known to all from the start, before the first step. A recorder that has no
  /// use for it passes it over.
  virtual void zone(Time /*time*/, const ZoneChange& /*change*/) {}

  // What cameras and ranging sensors look at and see. A recorder that has no use for it
  // passes it over.
  /// A thing on the ground exists. Before the first step.
  virtual void object(const GroundObject& /*object*/) {}
  virtual void detection(const Detection& /*detection*/) {}
  virtual void footprint(const Footprint& /*footprint*/) {}
  virtual void ranges(const RangeScan& /*scan*/) {}

  /// Called at the end of every step; may write out what has gathered.
  /// Fails: kUnavailable when the records can no longer be written (disk full...).
  virtual Result<void> step_done(Time time) = 0;
};

}  // namespace skein
