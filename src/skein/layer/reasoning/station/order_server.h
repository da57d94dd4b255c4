// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "skein/layer/reasoning/station/flight_changes.h"
#include "skein/layer/reasoning/station/reading_router.h"
#include "skein/role/mission.h"

namespace skein::reasoning {

/// An aircraft of a ground station's team, by its name.
struct NamedAircraft {
  EntityId id;
  std::string name;
  Vec2 place = Vec2::Zero();  ///< where it begins [m]
};

/// The part of a ground station that sends orders to its aircraft: those of the mission
/// that has an aircraft, and those of the operator.
///
/// An aircraft keeps the order with the highest number, so orders of all are numbered in
/// one row for each aircraft; a mission sees numbers of its own. Orders of the operator
/// are sent again until the aircraft says that it has them; missions repeat theirs. Who
/// follows another, or is a relay, is sent the positions of those that it is about.
class OrderServer {
 public:
  /// Who may order an aircraft about.
  enum class Holder : std::uint8_t { kNobody, kMission, kOperator };

  struct Member {
    NamedAircraft who;
    Holder holder = Holder::kNobody;
    std::optional<std::size_t> mission =
        {};                          ///< that has it, or had it before the operator
    Vec2 place = Vec2::Zero();       ///< as last reported [m]
    std::optional<Time> heard = {};  ///< last
    std::optional<FlightLimits> limits = {};  ///< as last said: not each report has them
    double silence_allowed = 0;               ///< from there on [s]
    bool obeys = false;                       ///< neither a pilot nor a failsafe flies
    TaskState state = TaskState::kNone;

    // How its orders are numbered.
    struct Numbers {
      std::uint32_t order = 0;   // the mission's own last number
      std::uint32_t offset = 0;  // from these to those sent
      std::uint32_t first = 0;   // sent since it has the aircraft
    };
    std::vector<Numbers> numbers;  // of each mission
    std::uint32_t highest = 0;     // of all orders so far
    std::uint32_t confirmed = 0;   // by the aircraft
    // The operator's orders that are not confirmed yet: the first is on its way.
    std::deque<Message> open;
    Time sent;
    Task task;            // the last that was sent, with its number
    TaskReport reported;  // what is left of it, as last said
  };

  /// @param missions  their number.
  /// @param station   itself, and where it is.
  OrderServer(const std::vector<NamedAircraft>& team, std::size_t missions,
              EntityId station, const NavEstimate& position);

  EntityId station() const { return station_; }

  /// Takes in what was received.
  void listen(const AgentInput& in, AgentOutput& out);

  const std::vector<Member>& members() const { return members_; }

  /// Puts the numbers of those that a task is about in place of their names.
  /// @returns  what is wrong; empty: nothing.
  std::string bind(TaskKind& what, const std::vector<std::string>& names) const;

  /// Gives an aircraft to a mission, or to nobody.
  void give(std::size_t member, std::optional<std::size_t> mission);

  /// Orders an aircraft by the operator, who has it from now on, or by the station
  /// itself.
  void order(std::size_t member, TaskKind what, Holder holder, Time now,
             AgentOutput& out);
  void order(std::size_t member, TaskAction action, Time now, AgentOutput& out);
  /// How it flies what it is given, by whomever.
  void order(std::size_t member, const FlightChange& change, Time now, AgentOutput& out);

  /// What the aircraft still has to do.
  TaskKind rest_of_task(std::size_t member) const;

  /// Lets a mission take a step: with the reports of its aircraft in its own numbers, and
  /// with those of others as of aircraft that do not obey; fire readings as far as they
  /// are about its perimeter. Orders to others are dropped.
  void run(std::size_t index, Mission& mission, const ReadingRouter& readings,
           const AgentInput& in, AgentOutput& out);

  /// Sends again what has not been confirmed.
  void resend(Time now, AgentOutput& out);

 private:
  Member* find(EntityId id);
  void send_next(Member& member, Time now, AgentOutput& out);
  void queue(Member& member, Message message, Time now, AgentOutput& out);
  void set_task(Member& member, Task task);
  void forward(const NavEstimate& nav, EntityId of, AgentOutput& out);
  bool has(const Member& member, std::size_t mission) const;
  bool concerns(const Message& message, std::size_t mission,
                const ReadingRouter& readings);
  Message renumbered(const Message& message, std::size_t mission);
  bool may_pass(Message& message, std::size_t mission);

  std::vector<Member> members_;
  std::vector<std::pair<EntityId, std::size_t>> places_;    // of members_, by id
  std::map<EntityId, std::vector<std::size_t>> listeners_;  // whose tasks are about one
  FlightChanges flights_;
  EntityId station_;
  NavEstimate position_;
  Time next_position_;
};

}  // namespace skein::reasoning
