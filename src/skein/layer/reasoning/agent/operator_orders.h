#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "skein/role/agent.h"

namespace skein::reasoning {

/// An aircraft of a ground station's team, by its name.
struct NamedAircraft {
  EntityId id;
  std::string name;
};

/// A ground station's agent whose aircraft an operator may order about as well.
///
/// An aircraft that has got a TaskCommand, and every one while the mission is paused, is
/// the operator's: the mission's orders do not reach it, and to the mission its reports
/// say that it does not obey. Resuming the mission gives all of them back. Orders of both
/// are numbered in one row, because an aircraft keeps the order with the highest number;
/// each is sent again until the aircraft says that it has it.
class OperatorOrders final : public Agent {
 public:
  /// @param mission  who orders otherwise.
  OperatorOrders(std::vector<NamedAircraft> team, std::unique_ptr<Agent> mission);

  void step(const AgentInput& in, AgentOutput& out) override;

 private:
  struct Member {
    NamedAircraft who;
    bool taken = false;               // it is the operator's
    Task order;                       // the operator's last
    Time sent;                        // that order
    std::uint32_t confirmed = 0;      // number of the task that it works on
    std::uint32_t mission_order = 0;  // the mission's own last number
    std::uint32_t highest = 0;        // number of all orders so far
    std::uint32_t offset = 0;         // from the mission's numbers to those sent
    Vec2 place = Vec2::Zero();        // as last reported [m]
  };

  Member* find(EntityId id);
  void obey(const Command& command, Time now, AgentOutput& out);
  void order(Member& member, TaskKind what, Time now, AgentOutput& out);
  void send(Member& member, Time now, AgentOutput& out);
  void give_back(Member& member);
  void renumber(Member& member, AircraftReport& report) const;
  bool may_pass(Message& message);

  std::vector<Member> team_;
  std::unique_ptr<Agent> mission_;
};

}  // namespace skein::reasoning
