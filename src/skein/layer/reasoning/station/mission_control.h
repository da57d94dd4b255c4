// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "skein/layer/reasoning/station/order_server.h"
#include "skein/role/allocator.h"

namespace skein::reasoning {

/// A mission of a ground station, and when it is flown by whom.
struct PlannedMission {
  std::string name;
  EntityId station = {};  ///< that pursues it
  std::unique_ptr<Mission> mission;
  std::vector<EntityId> candidates;  ///< aircraft that may fly it
  int priority = 0;                  ///< larger is more important
  std::optional<int> min, max;       ///< aircraft; none: as the mission says
  std::optional<Time> start;         ///< none: on command, or after `after`
  std::string after;                 ///< begins when the mission of this name is over
  std::optional<Time> length;        ///< is over so long after its begin
  TaskKind then = Hold{};            ///< what its aircraft fly when it is over
};

/// The part of a ground station that pursues its missions: begins and ends them, shares
/// the aircraft among them once a second (Allocator), and obeys the operator, who may
/// take any aircraft until the mission resumes.
///
/// An aircraft that is silent stays with its mission, which gets another if it needs one.
/// Events: "mission" when one begins, is paused, goes on or is over; "allocated" when an
/// aircraft is given to another mission; "command-refused". Records: MissionChange, and
/// what missions record, with their names.
class MissionControl {
 public:
  MissionControl(std::vector<PlannedMission> missions,
                 std::unique_ptr<const Allocator> allocator);

  /// To be called once before the first step: every aircraft has its mission from then
  /// on.
  void begin(OrderServer& orders);

  void step(const AgentInput& in, OrderServer& orders, AgentOutput& out);

 private:
  enum class State { kWaiting, kRunning, kPaused, kOver };
  struct Slot {
    PlannedMission plan;
    State state = State::kWaiting;
    Time begun;
    State recorded = State::kWaiting;  // the state that records know of
    std::uint32_t goal_number = 0;     // of the goal that they know of
  };
  void run(std::size_t index, const AgentInput& in, OrderServer& orders,
           AgentOutput& out);
  void route_readings();
  void record_states(AgentOutput& out);
  void obey(const Command& command, Time now, OrderServer& orders, AgentOutput& out);
  void obey(const TaskCommand& command, Time now, OrderServer& orders, AgentOutput& out);
  void obey(const FlightChangeCommand& command, Time now, OrderServer& orders,
            AgentOutput& out);
  void obey(const TaskChangeCommand& command, Time now, OrderServer& orders,
            AgentOutput& out);
  void obey(const MissionCommand& command, Time now, OrderServer& orders,
            AgentOutput& out);
  void act(std::size_t index, MissionAction action, Time now, OrderServer& orders,
           AgentOutput& out);
  void schedule(Time now, OrderServer& orders, AgentOutput& out);
  bool must_begin(const Slot& slot, Time now) const;
  void end(std::size_t index, Time now, OrderServer& orders, AgentOutput& out);
  void allocate(Time now, OrderServer& orders, AgentOutput& out);
  static void refuse(Time now, const std::string& why, AgentOutput& out);

  std::vector<Slot> slots_;
  std::unique_ptr<const Allocator> allocator_;
  ReadingRouter readings_;  // to the missions that run
  Time next_allocation_;
};

}  // namespace skein::reasoning
