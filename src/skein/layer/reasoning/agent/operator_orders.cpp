#include "skein/layer/reasoning/agent/operator_orders.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace skein::reasoning {
namespace {

constexpr double kResendAfter = 3;  // an order not confirmed by now is sent again [s]

}  // namespace

OperatorOrders::OperatorOrders(std::vector<NamedAircraft> team,
                               std::unique_ptr<Agent> mission)
    : mission_(std::move(mission)) {
  for (NamedAircraft& who : team) team_.emplace_back().who = std::move(who);
}

OperatorOrders::Member* OperatorOrders::find(EntityId id) {
  const auto found = std::find_if(team_.begin(), team_.end(),
                                  [&](const Member& m) { return m.who.id == id; });
  return found == team_.end() ? nullptr : &*found;
}

void OperatorOrders::step(const AgentInput& in, AgentOutput& out) {
  std::vector<Message> inbox(in.inbox.begin(), in.inbox.end());
  for (Message& message : inbox) {
    auto* report = std::get_if<AircraftReport>(&message.content);
    Member* member = report ? find(message.from) : nullptr;
    if (!member) continue;
    member->confirmed = report->task_number;
    member->place = geo::horizontal(report->nav.p_N);
    renumber(*member, *report);
  }
  for (const Command& command : in.commands) obey(command, in.now, out);
  for (Member& member : team_)
    if (member.taken && member.order.number != member.confirmed &&
        (in.now - member.sent).seconds() >= kResendAfter)
      send(member, in.now, out);

  AgentInput passed = in;
  passed.inbox = inbox;
  const auto before = static_cast<std::ptrdiff_t>(out.outbox.size());
  mission_->step(passed, out);
  const auto dropped =
      std::remove_if(out.outbox.begin() + before, out.outbox.end(),
                     [this](Message& message) { return !may_pass(message); });
  out.outbox.erase(dropped, out.outbox.end());
}

void OperatorOrders::obey(const Command& command, Time now, AgentOutput& out) {
  if (const auto* task = std::get_if<TaskCommand>(&command)) {
    for (Member& member : team_)
      if (member.who.name == task->aircraft) order(member, task->what, now, out);
  } else if (const auto* mission = std::get_if<MissionCommand>(&command)) {
    for (Member& member : team_)
      if (!mission->paused)
        give_back(member);
      else if (!member.taken)
        order(member, Loiter{member.place}, now, out);
    out.events.push_back(
        {now, EntityId{}, "mission", mission->paused ? "paused" : "resumed"});
  }
}

void OperatorOrders::order(Member& member, TaskKind what, Time now, AgentOutput& out) {
  member.taken = true;
  member.order = {++member.highest, std::move(what)};
  out.events.push_back({now, member.who.id, "ordered",
                        fmt::format("{} by the operator", kind_of(member.order.what))});
  send(member, now, out);
}

void OperatorOrders::send(Member& member, Time now, AgentOutput& out) {
  member.sent = now;
  out.outbox.push_back({EntityId{}, member.who.id, 0, Time(), member.order});
}

void OperatorOrders::give_back(Member& member) {
  if (!member.taken) return;
  member.taken = false;
  // Whatever order the mission gives next, its last one again included, must be higher.
  member.offset = member.highest + 1 - member.mission_order;
}

// What the mission is given of an aircraft, in its own numbers.
void OperatorOrders::renumber(Member& member, AircraftReport& report) const {
  if (member.taken) report.obeys = false;
  const bool missions = !member.taken && report.task_number > member.offset;
  const std::uint32_t number = missions ? report.task_number - member.offset : 0;
  if (number == 0) report.task_state = TaskState::kNone;
  report.task_number = number;
}

bool OperatorOrders::may_pass(Message& message) {
  auto* task = std::get_if<Task>(&message.content);
  Member* member = task ? find(message.to) : nullptr;
  if (!member) return true;
  member->mission_order = std::max(member->mission_order, task->number);
  task->number += member->offset;
  if (member->taken) return false;
  member->highest = std::max(member->highest, task->number);
  return true;
}

}  // namespace skein::reasoning
