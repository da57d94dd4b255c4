// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/station/order_server.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace skein::reasoning {
namespace {

constexpr double kResendAfter = 3;     // an order not confirmed by now is sent again [s]
constexpr double kSilent = 5;          // an aircraft unheard for so long [s]
constexpr double kPositionPeriod = 1;  // of the station's own, to relays [s]

}  // namespace

OrderServer::OrderServer(const std::vector<NamedAircraft>& team, std::size_t missions,
                         EntityId station, const NavEstimate& position)
    : station_(station), position_(position) {
  for (const NamedAircraft& who : team) {
    Member& member = members_.emplace_back();
    member.who = who;
    member.place = who.place;
    member.numbers.resize(missions);
    places_.emplace_back(who.id, members_.size() - 1);
  }
  std::ranges::sort(places_);
}

std::string OrderServer::bind(TaskKind& what,
                              const std::vector<std::string>& names) const {
  std::vector<EntityId> ids;
  for (const std::string& name : names) {
    const auto member = std::ranges::find(
        members_, name, [](const Member& each) { return each.who.name; });
    if (member == members_.end() && name != "station")
      return fmt::format("there is no aircraft \"{}\".", name);
    ids.push_back(member == members_.end() ? station_ : member->who.id);
  }
  bind_others(what, ids);
  return task_error(what);
}

OrderServer::Member* OrderServer::find(EntityId id) {
  const auto found =
      std::ranges::lower_bound(places_, id, {}, &std::pair<EntityId, std::size_t>::first);
  return found == places_.end() || found->first != id ? nullptr
                                                      : &members_[found->second];
}

void OrderServer::set_task(Member& member, Task task) {
  const auto place = static_cast<std::size_t>(&member - members_.data());
  for (const EntityId subject : others_of(member.task.what))
    std::erase(listeners_[subject], place);
  for (const EntityId subject : others_of(task.what)) {
    std::vector<std::size_t>& listeners = listeners_[subject];
    const auto at = std::ranges::lower_bound(listeners, place);
    if (at == listeners.end() || *at != place) listeners.insert(at, place);
  }
  member.task = std::move(task);
}

void OrderServer::listen(const AgentInput& in, AgentOutput& out) {
  for (const Message& message : in.inbox) {
    Member* member = find(message.from);
    if (!member) continue;
    if (const auto* report = std::get_if<AircraftReport>(&message.content)) {
      member->place = geo::horizontal(report->nav.p_N);
      member->heard = in.now;
      if (report->limits) member->limits = report->limits;
      member->silence_allowed = silence_allowed(*report, kSilent);
      member->obeys = report->obeys;
      member->state = report->task_state;
      member->confirmed = report->task_number;
      forward(report->nav, message.from, out);
      while (!member->open.empty() && std::visit(
                                          [&]<class T>(const T& content) {
                                            if constexpr (std::is_same_v<T, Task> ||
                                                          std::is_same_v<T, TaskChange>)
                                              return content.number <= member->confirmed;
                                            return true;
                                          },
                                          member->open.front().content)) {
        member->open.pop_front();
        send_next(*member, in.now, out);
      }
    } else if (const auto* left = std::get_if<TaskReport>(&message.content)) {
      member->reported = *left;
    } else if (const auto* flies = std::get_if<FlightChange>(&message.content)) {
      flights_.confirm(message.from, *flies);
    }
  }
  if (in.now < next_position_) return;
  next_position_ = in.now + Time::from_seconds(kPositionPeriod);
  position_.time = in.now;
  forward(position_, station_, out);
}

// To those whose task is about the one that has reported.
void OrderServer::forward(const NavEstimate& nav, EntityId of, AgentOutput& out) {
  const auto listeners = listeners_.find(of);
  if (listeners == listeners_.end()) return;
  const Member* leader = find(of);
  for (const std::size_t place : listeners->second) {
    const Member& member = members_[place];
    if (member.who.id == of) continue;
    // A leader may report by itself.
    if (leader)
      if (const auto* route = std::get_if<FlyRoute>(&leader->task.what);
          route &&
          std::count(route->report_to.begin(), route->report_to.end(), member.who.id) > 0)
        continue;
    Message position;
    position.to = member.who.id;
    position.content = TeamPosition{of, nav};
    out.outbox.push_back(std::move(position));
  }
}

void OrderServer::give(std::size_t index, std::optional<std::size_t> mission) {
  Member& member = members_[index];
  const bool same = mission ? has(member, *mission) : member.holder == Holder::kNobody;
  if (same) return;
  member.holder = mission ? Holder::kMission : Holder::kNobody;
  if (!mission) return;
  member.open.clear();
  member.mission = *mission;
  Member::Numbers& numbers = member.numbers[*mission];
  // Whatever order the mission gives next, its last one again included, must be higher.
  if (member.highest > 0 || numbers.order > 0)
    numbers.offset = member.highest + 1 - numbers.order;
  numbers.first = member.highest + 1;
}

void OrderServer::order(std::size_t index, TaskKind what, Holder holder, Time now,
                        AgentOutput& out) {
  Member& member = members_[index];
  member.holder = holder;
  member.open.clear();  // the newest counts
  set_task(member, {++member.highest, std::move(what)});
  out.events.push_back({now,
                        member.who.id,
                        EventKind::kOrdered,
                        fmt::format("{} by the {}", kind_of(member.task.what),
                                    holder == Holder::kOperator ? "operator" : "station"),
                        {.task = member.task.number}});
  queue(member, {EntityId{}, member.who.id, 0, Time(), member.task}, now, out);
}

void OrderServer::order(std::size_t index, TaskAction action, Time now,
                        AgentOutput& out) {
  Member& member = members_[index];
  member.holder = Holder::kOperator;
  const TaskChange change{++member.highest, action};
  out.events.push_back({now,
                        member.who.id,
                        EventKind::kOrdered,
                        fmt::format("{} by the operator", name_of(action)),
                        {.task = change.number}});
  queue(member, {EntityId{}, member.who.id, 0, Time(), change}, now, out);
}

void OrderServer::order(std::size_t index, const FlightChange& change, Time now,
                        AgentOutput& out) {
  const EntityId aircraft = members_[index].who.id;
  out.events.push_back(
      {now, aircraft, EventKind::kOrdered, "height or speed by the operator"});
  flights_.order(aircraft, change, now, out);
}

// One after the other: an order about a task must not overtake the task.
void OrderServer::queue(Member& member, Message message, Time now, AgentOutput& out) {
  member.open.push_back(std::move(message));
  if (member.open.size() == 1) send_next(member, now, out);
}

void OrderServer::send_next(Member& member, Time now, AgentOutput& out) {
  if (member.open.empty()) return;
  member.sent = now;
  out.outbox.push_back(member.open.front());
}

void OrderServer::resend(Time now, AgentOutput& out) {
  for (Member& member : members_)
    if ((now - member.sent).seconds() >= kResendAfter) send_next(member, now, out);
  flights_.resend(now, out);
}

TaskKind OrderServer::rest_of_task(std::size_t index) const {
  const Member& member = members_[index];
  return member.reported.number == member.task.number && member.task.number > 0
             ? member.reported.rest
             : member.task.what;
}

bool OrderServer::has(const Member& member, std::size_t mission) const {
  return member.holder == Holder::kMission && member.mission == mission;
}

bool OrderServer::concerns(const Message& message, std::size_t mission,
                           const ReadingRouter& readings) {
  if (!readings.divides()) return true;
  std::optional<FireReading> reading;
  if (const auto* one = std::get_if<FireReading>(&message.content)) reading = *one;
  // Those of one message are of one sensor and nearly one place.
  const auto* several = std::get_if<FireReport>(&message.content);
  if (several && !several->readings.empty())
    reading = reading_of(*several, several->readings.back(), message.from);
  if (!reading) return true;
  const Member* member = find(reading->aircraft);
  return readings.belongs(*reading, member ? member->mission : std::nullopt, mission);
}

void OrderServer::run(std::size_t index, Mission& mission, const ReadingRouter& readings,
                      const AgentInput& in, AgentOutput& out) {
  std::vector<Message> inbox;
  inbox.reserve(in.inbox.size());
  for (const Message& message : in.inbox)
    if (concerns(message, index, readings)) inbox.push_back(renumbered(message, index));
  AgentInput own = in;
  own.inbox = inbox;
  const auto before = static_cast<std::ptrdiff_t>(out.outbox.size());
  mission.step(own, out);
  const auto dropped =
      std::remove_if(out.outbox.begin() + before, out.outbox.end(),
                     [&](Message& message) { return !may_pass(message, index); });
  out.outbox.erase(dropped, out.outbox.end());
}

// What a mission is given of an aircraft, in its own numbers.
Message OrderServer::renumbered(const Message& message, std::size_t mission) {
  Message own = message;
  Member* member = find(message.from);
  if (!member) return own;
  const Member::Numbers& numbers = member->numbers[mission];
  const auto to_own = [&](std::uint32_t number) {
    const bool own_order = has(*member, mission) && number >= numbers.first;
    return own_order ? number - numbers.offset : 0;
  };
  if (auto* report = std::get_if<AircraftReport>(&own.content)) {
    report->limits = member->limits;
    if (!has(*member, mission)) report->obeys = false;
    report->task_number = to_own(report->task_number);
    if (report->task_number == 0) report->task_state = TaskState::kNone;
  } else if (auto* left = std::get_if<TaskReport>(&own.content)) {
    left->number = to_own(left->number);
  }
  return own;
}

bool OrderServer::may_pass(Message& message, std::size_t mission) {
  auto* task = std::get_if<Task>(&message.content);
  Member* member = task ? find(message.to) : nullptr;
  if (!member) return true;
  Member::Numbers& numbers = member->numbers[mission];
  numbers.order = std::max(numbers.order, task->number);
  if (!has(*member, mission)) return false;
  task->number += numbers.offset;
  member->highest = std::max(member->highest, task->number);
  if (task->number >= member->task.number) set_task(*member, *task);
  return true;
}

}  // namespace skein::reasoning
