#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "skein/data/autopilot.h"
#include "skein/data/event.h"
#include "skein/data/fire.h"
#include "skein/data/message.h"
#include "skein/data/object.h"
#include "skein/data/payload.h"
#include "skein/data/vehicle.h"
#include "skein/geo/polygon.h"

namespace skein::record {

struct EntityRow {
  EntityId id;
  std::string name, kind;
};

struct TruthRow {
  TruthRow(Time at, EntityId who, const VehicleState& s)
      : time(at),
        id(who),
        p_N(s.p_N),
        v_N(s.v_N),
        q_NB(s.q_NB),
        airspeed(s.airspeed),
        charge(s.energy.charge),
        power(s.energy.power) {}
  Time time;
  EntityId id;
  Vec3 p_N, v_N;
  Quat q_NB;
  double airspeed, charge, power;
};

struct EstimateRow {
  EstimateRow(EntityId who, const NavEstimate& e, const AutopilotStatus& s)
      : id(who),
        estimate(e),
        cross_track(s.cross_track),
        time_error(s.time_error),
        follows(s.follows),
        mode(s.mode),
        trigger(s.trigger),
        reaction(s.reaction),
        charge(s.charge),
        reserve(s.reserve),
        endurance(s.endurance) {}
  EntityId id;
  NavEstimate estimate;
  double cross_track, time_error;
  bool follows;
  FlightMode mode;
  FailsafeTrigger trigger;
  FailsafeReaction reaction;
  double charge, reserve;
  std::optional<double> endurance;
};

struct MessageRow {
  EntityId from, to;
  std::uint64_t number = 0;
  Time sent, arrived;
  int size_bytes = 0;
  int content = 0;  ///< index of Message::content
  bool lost = false;
};

/// The order that a message carried.
struct TaskRow {
  Time sent, arrived;
  EntityId from, to;
  Task task;
  bool lost = false;
};

/// A no-flight zone that came into force or was taken back.
struct ZoneRow {
  Time time;
  ZoneChange change;
};

struct PerimeterRow {
  Time time;
  EntityId believer;
  geo::Region truth;
  BoundaryEstimate belief;
};

struct TerrainRow {
  int rows = 0, columns = 0;
  Vec2 low = Vec2::Zero();
  double spacing = 0;
  std::vector<float> heights;
};

/// One thing to be stored. Rare and large kinds are held by pointer: the common ones
/// decide the size.
using Row =
    std::variant<TruthRow, EstimateRow, FireReading, Crossing, MessageRow, EntityRow,
                 Event, Detection, Footprint, RangeScan, std::unique_ptr<GroundObject>,
                 std::unique_ptr<TaskRow>, std::unique_ptr<PerimeterRow>,
                 std::unique_ptr<TerrainRow>, std::unique_ptr<ZoneRow>>;

}  // namespace skein::record
