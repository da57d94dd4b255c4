// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/station/mission_control.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace skein::reasoning {
namespace {

constexpr double kAllocationPeriod = 1;  // [s]

using Member = OrderServer::Member;
using Holder = OrderServer::Holder;

// By its name, as commands have it.
std::optional<std::size_t> find_member(const OrderServer& orders,
                                       const std::string& name) {
  const auto& members = orders.members();
  for (std::size_t k = 0; k < members.size(); ++k)
    if (members[k].who.name == name) return k;
  return std::nullopt;
}

bool is_silent(const Member& member, Time now) {
  return member.heard && (now - *member.heard).seconds() > member.silence_allowed;
}

}  // namespace

MissionControl::MissionControl(std::vector<PlannedMission> missions,
                               std::unique_ptr<const Allocator> allocator)
    : allocator_(std::move(allocator)) {
  for (PlannedMission& each : missions)
    slots_.push_back({std::move(each), {}, {}, {}, {}});
}

void MissionControl::begin(OrderServer& orders) {
  for (Slot& slot : slots_)
    if (must_begin(slot, Time())) slot.state = State::kRunning;
  AgentOutput unsaid;  // nobody has reported: there is nobody to tell
  allocate(Time(), orders, unsaid);
}

void MissionControl::step(const AgentInput& in, OrderServer& orders, AgentOutput& out) {
  for (const Command& command : in.commands) obey(command, in.now, orders, out);
  schedule(in.now, orders, out);
  if (in.now >= next_allocation_) {
    next_allocation_ = in.now + Time::from_seconds(kAllocationPeriod);
    allocate(in.now, orders, out);
  }
  record_states(out);
  for (std::size_t k = 0; k < slots_.size(); ++k)
    if (slots_[k].state == State::kRunning || slots_[k].state == State::kPaused)
      run(k, in, orders, out);
}

void MissionControl::route_readings() {
  std::vector<ReadingRouter::Watch> watches;
  for (std::size_t k = 0; k < slots_.size(); ++k) {
    const Slot& slot = slots_[k];
    if (slot.state != State::kRunning && slot.state != State::kPaused) continue;
    const MissionGoal goal = slot.plan.mission->goal();
    if (const auto* perimeter = std::get_if<PerimeterGoal>(&goal))
      watches.push_back({k, perimeter->phenomenon,
                         slot.plan.mission->demand().place.value_or(Vec2::Zero())});
  }
  readings_.set(std::move(watches));
}

void MissionControl::run(std::size_t index, const AgentInput& in, OrderServer& orders,
                         AgentOutput& out) {
  const std::size_t before = out.records.size();
  orders.run(index, *slots_[index].plan.mission, readings_, in, out);
  for (std::size_t k = before; k < out.records.size(); ++k)
    std::visit(
        [&](auto& record) {
          if constexpr (requires { record.mission; })
            record.mission = slots_[index].plan.name;
        },
        out.records[k]);
}

void MissionControl::record_states(AgentOutput& out) {
  bool changed = false;
  for (Slot& slot : slots_) {
    const std::uint32_t goal_number = slot.plan.mission->goal_number();
    const bool other_goal = slot.state == State::kRunning &&
                            slot.recorded == State::kRunning &&
                            goal_number != slot.goal_number;
    if (slot.state == slot.recorded && !other_goal) continue;
    MissionState state = MissionState::kBegun;
    if (slot.state == State::kPaused) state = MissionState::kPaused;
    if (slot.state == State::kOver) state = MissionState::kOver;
    if (slot.state == State::kRunning && slot.recorded == State::kPaused)
      state = MissionState::kResumed;
    if (other_goal) state = MissionState::kChanged;
    slot.recorded = slot.state;
    slot.goal_number = goal_number;
    out.records.emplace_back(
        MissionChange{slot.plan.name, state, slot.plan.mission->goal()});
    changed = true;
  }
  if (changed) route_readings();
}

bool MissionControl::must_begin(const Slot& slot, Time now) const {
  if (slot.state != State::kWaiting) return false;
  if (!slot.plan.after.empty())
    return std::any_of(slots_.begin(), slots_.end(), [&](const Slot& other) {
      return other.plan.name == slot.plan.after && other.state == State::kOver;
    });
  return slot.plan.start && now >= *slot.plan.start;
}

void MissionControl::schedule(Time now, OrderServer& orders, AgentOutput& out) {
  for (std::size_t k = 0; k < slots_.size(); ++k) {
    Slot& slot = slots_[k];
    if (must_begin(slot, now)) act(k, MissionAction::kStart, now, orders, out);
    const bool runs = slot.state == State::kRunning || slot.state == State::kPaused;
    const bool over = slot.plan.length && now - slot.begun >= *slot.plan.length;
    if (runs && (over || slot.plan.mission->done())) end(k, now, orders, out);
  }
}

void MissionControl::end(std::size_t index, Time now, OrderServer& orders,
                         AgentOutput& out) {
  Slot& slot = slots_[index];
  slot.state = State::kOver;
  next_allocation_ = now;
  out.events.push_back(
      {now, EntityId{}, EventKind::kMission, slot.plan.name + " is over"});
  const auto& members = orders.members();
  for (std::size_t k = 0; k < members.size(); ++k)
    if (members[k].holder == Holder::kMission && members[k].mission == index)
      orders.order(k, slot.plan.then, Holder::kNobody, now, out);
}

void MissionControl::allocate(Time now, OrderServer& orders, AgentOutput& out) {
  std::vector<AllocatedAircraft> aircraft;
  std::vector<std::size_t> index;  // of each in the members
  const auto& members = orders.members();
  for (std::size_t k = 0; k < members.size(); ++k) {
    const Member& member = members[k];
    if (member.holder == Holder::kOperator || is_silent(member, now)) continue;
    if (member.heard && !member.obeys && member.holder == Holder::kNobody) continue;
    AllocatedAircraft& each = aircraft.emplace_back();
    each.id = member.who.id;
    each.place = member.place;
    if (member.holder == Holder::kMission) each.owner = member.mission;
    index.push_back(k);
  }
  std::vector<WantingMission> missions;
  for (const Slot& slot : slots_) {
    WantingMission& each = missions.emplace_back();
    const bool runs = slot.state == State::kRunning || slot.state == State::kPaused;
    each.demand = runs ? slot.plan.mission->demand() : MissionDemand{0, 0, {}};
    if (runs && slot.plan.max)
      each.demand.max = std::min(each.demand.max, *slot.plan.max);
    if (runs && slot.plan.min) each.demand.min = *slot.plan.min;
    each.demand.min = std::min(each.demand.min, each.demand.max);
    each.priority = slot.plan.priority;
    each.candidates = slot.plan.candidates;
  }
  const auto owners = allocator_->allocate(aircraft, missions);
  for (std::size_t k = 0; k < aircraft.size(); ++k) {
    if (owners[k] == aircraft[k].owner) continue;
    const Member& member = members[index[k]];
    out.events.push_back({now, member.who.id, EventKind::kAllocated,
                          owners[k] ? "to " + slots_[*owners[k]].plan.name
                                    : std::string("to no mission")});
    if (!owners[k] && member.heard)
      orders.order(index[k], Hold{}, Holder::kNobody, now, out);
    orders.give(index[k], owners[k]);
  }
}

void MissionControl::refuse(Time now, const std::string& why, AgentOutput& out) {
  out.events.push_back({now, EntityId{}, EventKind::kCommandRefused, why});
}

void MissionControl::obey(const Command& command, Time now, OrderServer& orders,
                          AgentOutput& out) {
  if (const auto* task = std::get_if<TaskCommand>(&command))
    obey(*task, now, orders, out);
  else if (const auto* change = std::get_if<TaskChangeCommand>(&command))
    obey(*change, now, orders, out);
  else if (const auto* flight = std::get_if<FlightChangeCommand>(&command))
    obey(*flight, now, orders, out);
  else if (const auto* mission = std::get_if<MissionCommand>(&command))
    obey(*mission, now, orders, out);
}

void MissionControl::obey(const TaskCommand& command, Time now, OrderServer& orders,
                          AgentOutput& out) {
  const auto who = find_member(orders, command.aircraft);
  if (!who) return;  // another station's
  TaskKind what = command.what;
  if (std::string error = orders.bind(what, command.others); !error.empty())
    return refuse(now, fmt::format("task {}: {}", kind_of(what), error), out);
  orders.order(*who, std::move(what), Holder::kOperator, now, out);
}

void MissionControl::obey(const TaskChangeCommand& command, Time now, OrderServer& orders,
                          AgentOutput& out) {
  const auto who = find_member(orders, command.aircraft);
  if (!who) return;
  if (command.to.empty()) return orders.order(*who, command.action, now, out);
  const auto to = find_member(orders, command.to);
  if (!to)
    return refuse(now, fmt::format("\"{}\" is not of this station.", command.to), out);
  if (orders.members()[*who].task.number == 0)
    return refuse(now, fmt::format("{} has no task to give.", command.aircraft), out);
  TaskKind rest = orders.rest_of_task(*who);
  orders.order(*who, TaskAction::kCancel, now, out);
  orders.order(*to, std::move(rest), Holder::kOperator, now, out);
}

// Whoever has the aircraft keeps it.
void MissionControl::obey(const FlightChangeCommand& command, Time now,
                          OrderServer& orders, AgentOutput& out) {
  if (const auto who = find_member(orders, command.aircraft))
    orders.order(*who, FlightChange{0, command.altitude_agl, command.airspeed}, now, out);
}

void MissionControl::obey(const MissionCommand& command, Time now, OrderServer& orders,
                          AgentOutput& out) {
  bool found = false;
  for (std::size_t k = 0; k < slots_.size(); ++k) {
    if (!command.mission.empty() && slots_[k].plan.name != command.mission) continue;
    found = true;
    act(k, command.action, now, orders, out);
  }
  // Those that no mission has.
  if (command.mission.empty() && command.action == MissionAction::kResume)
    for (std::size_t k = 0; k < orders.members().size(); ++k)
      if (orders.members()[k].holder == Holder::kOperator) orders.give(k, std::nullopt);
  if (!found && !command.mission.empty())
    refuse(now, fmt::format("there is no mission \"{}\".", command.mission), out);
}

void MissionControl::act(std::size_t index, MissionAction action, Time now,
                         OrderServer& orders, AgentOutput& out) {
  Slot& slot = slots_[index];
  const auto say = [&](const char* what) {
    out.events.push_back({now, EntityId{}, EventKind::kMission,
                          fmt::format("{} {}", slot.plan.name, what)});
  };
  const auto& members = orders.members();
  switch (action) {
    case MissionAction::kPause:
      if (slot.state != State::kRunning) return;
      slot.state = State::kPaused;
      for (std::size_t k = 0; k < members.size(); ++k)
        if (members[k].holder == Holder::kMission && members[k].mission == index)
          orders.order(k, Loiter{members[k].place}, Holder::kOperator, now, out);
      return say("is paused");
    case MissionAction::kResume:
      if (slot.state == State::kPaused) slot.state = State::kRunning;
      if (slot.state != State::kRunning) return;
      for (std::size_t k = 0; k < members.size(); ++k)
        if (members[k].holder == Holder::kOperator && members[k].mission == index &&
            members[k].task.number > 0)
          orders.give(k, index);
      return say("goes on");
    case MissionAction::kStart:
      if (slot.state != State::kWaiting && slot.state != State::kOver) return;
      slot.state = State::kRunning;
      slot.begun = now;
      next_allocation_ = now;
      return say("begins");
    case MissionAction::kEnd:
      if (slot.state == State::kRunning || slot.state == State::kPaused)
        end(index, now, orders, out);
      return;
  }
}

}  // namespace skein::reasoning
