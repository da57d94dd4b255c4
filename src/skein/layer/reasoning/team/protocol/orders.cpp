// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/protocol/orders.h"

#include <algorithm>

namespace skein::reasoning {
namespace {

constexpr int kQuickRepeats = 3;

bool contains(const std::vector<std::uint32_t>& list, std::uint32_t task) {
  return std::ranges::find(list, task) != list.end();
}

}  // namespace

void TeamOrders::set(EntityId member, std::vector<std::uint32_t> tasks) {
  lines_[member].aim = std::move(tasks);
}

bool TeamOrders::acknowledge(EntityId member, std::uint32_t number) {
  const auto found = lines_.find(member);
  if (found == lines_.end() || number == 0 || number > found->second.number) return false;
  Line& line = found->second;
  if (number < line.number) return true;  // an older one, repeated meanwhile
  line.acknowledged = line.confirmed = true;
  line.open = {line.order.begin(), line.order.end()};
  // What it said before is over.
  std::erase_if(line.informed,
                [&](std::uint32_t task) { return !contains(line.order, task); });
  return true;
}

void TeamOrders::informed(EntityId member, std::vector<std::uint32_t> tasks) {
  const auto found = lines_.find(member);
  if (found == lines_.end()) return;
  Line& line = found->second;
  line.informed = std::move(tasks);
  // It has dropped or forgotten its order: it gets it again.
  const bool obeys = line.informed == line.order;
  if (line.acknowledged && !obeys) {
    line.acknowledged = line.confirmed = false;
    line.repeats = 0;
    line.first = line.last;
  }
}

void TeamOrders::remind(EntityId member) {
  const auto found = lines_.find(member);
  if (found == lines_.end() || !found->second.acknowledged) return;
  found->second.acknowledged = false;
  found->second.repeats = kQuickRepeats;  // not more often than queries
  found->second.first = found->second.last;
  found->second.reported = true;  // the member is about to be lost: that is reported
}

bool TeamOrders::may_execute(const Line& line, std::uint32_t task) const {
  return line.open.contains(task) || contains(line.informed, task);
}

std::vector<std::uint32_t> TeamOrders::possible(EntityId member, const Line& line) const {
  std::vector<std::uint32_t> tasks;
  for (const std::uint32_t task : line.aim) {
    const bool executes = may_execute(line, task);
    const bool taken = std::ranges::any_of(lines_, [&](const auto& other) {
      return other.first != member && may_execute(other.second, task) &&
             !contains(other.second.aim, task);
    });
    if (!executes && taken) break;  // what follows may come after it
    tasks.push_back(task);
  }
  return tasks;
}

TeamOrders::Outcome TeamOrders::step(double now, double repeat, double period,
                                     double patience) {
  Outcome outcome;
  for (auto& [member, line] : lines_) {
    const auto tasks = possible(member, line);
    if (line.number == 0 || tasks != line.order) {
      line.number = ++counter_;
      line.order = tasks;
      line.open.insert(tasks.begin(), tasks.end());
      line.acknowledged = line.confirmed = line.reported = false;
      line.repeats = 0;
      line.first = now;
    } else if (line.acknowledged ||
               now - line.last <
                   (line.repeats < kQuickRepeats ? repeat : std::max(repeat, period))) {
      continue;
    } else {
      ++line.repeats;
    }
    line.last = now;
    if (member == self_) {
      own_ = tasks;
      line.informed.clear();
      acknowledge(member, line.number);
      continue;
    }
    outcome.sent.push_back({member, line.number, tasks});
    if (!line.reported && now - line.first > patience) {
      line.reported = true;
      outcome.unanswered.push_back(member);
    }
  }
  return outcome;
}

bool TeamOrders::all_acknowledged() const {
  return std::ranges::all_of(lines_,
                             [](const auto& line) { return line.second.confirmed; });
}

}  // namespace skein::reasoning
