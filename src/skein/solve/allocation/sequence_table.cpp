// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/allocation/sequence_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace skein::solve {
namespace {

constexpr std::size_t kMaxSelections = 256;
constexpr std::size_t kMaxDepth = 32;  // of an order
constexpr double kMaxTime = 1e9;       // [s]

using Selection = SequenceSelections::Selection;
using Kind = TaskOrder::Kind;

Error no_problem(std::string place, std::string message) {
  return {ErrorCode::kBadInput, std::move(place), std::move(message), ""};
}

// The tasks of one selection of an order, and their precedences.
struct Part {
  std::vector<std::size_t> tasks;
  std::vector<std::pair<std::size_t, std::size_t>> before;
};

Part joined(const Part& a, const Part& b, bool in_sequence) {
  Part both = a;
  both.tasks.insert(both.tasks.end(), b.tasks.begin(), b.tasks.end());
  both.before.insert(both.before.end(), b.before.begin(), b.before.end());
  if (in_sequence)
    for (const std::size_t first : a.tasks)
      for (const std::size_t second : b.tasks) both.before.emplace_back(first, second);
  return both;
}

// All selections of an order; too many, or none, is an error.
Result<std::vector<Part>> parts_of(const TaskOrder& order, std::vector<bool>& seen,
                                   std::size_t depth) {
  if (order.kind == Kind::kTask) {
    if (order.task >= seen.size())
      return no_problem("order", fmt::format("there is no task {}.", order.task));
    if (seen[order.task])
      return no_problem("order", fmt::format("task {} is in it twice.", order.task));
    seen[order.task] = true;
    return std::vector<Part>{{{order.task}, {}}};
  }
  if (order.parts.empty()) return no_problem("order", "a part of it is empty.");
  if (depth >= kMaxDepth)
    return no_problem("order", fmt::format("it is more than {} deep.", kMaxDepth));
  std::vector<Part> all;
  if (order.kind != Kind::kAlternative) all.emplace_back();
  for (const TaskOrder& inner : order.parts) {
    const auto parts = parts_of(inner, seen, depth + 1);
    if (!parts) return parts.error();
    std::vector<Part> next;
    if (order.kind == Kind::kAlternative) {
      next = std::move(all);
      next.insert(next.end(), parts.value().begin(), parts.value().end());
    } else {
      for (const Part& before : all)
        for (const Part& part : parts.value()) {
          next.push_back(joined(before, part, order.kind == Kind::kSequence));
          if (next.size() > kMaxSelections) break;
        }
    }
    all = std::move(next);
    if (all.size() > kMaxSelections)
      return no_problem(
          "order",
          fmt::format("alternatives allow more than {} selections.", kMaxSelections));
  }
  return all;
}

bool is_time(double x) {
  return x >= 0 && x <= kMaxTime;
}

Result<void> check_tasks(const SequenceProblem& problem) {
  for (std::size_t t = 0; t < problem.tasks.size(); ++t) {
    const SequenceTask& task = problem.tasks[t];
    const std::string place = fmt::format("task {}", t);
    if (!is_time(task.service) || !is_time(task.opens) || !(task.closes >= task.opens))
      return no_problem(place,
                        "service and window must be times from 0 on, and the "
                        "window must not close before it opens.");
    if (!(task.value >= 0) || !std::isfinite(task.value))
      return no_problem(place, "its value must be a number from 0 on.");
    if (!task.eligible.empty() && task.eligible.size() != problem.aircraft)
      return no_problem(place, "it must say of every aircraft whether it is eligible.");
    if (!task.eligible.empty() && std::find(task.eligible.begin(), task.eligible.end(),
                                            true) == task.eligible.end())
      return no_problem(place, "no aircraft is eligible.");
  }
  if (problem.aircraft == 0 && !problem.tasks.empty())
    return no_problem("aircraft", "there must be at least one.");
  if (!(problem.discount >= 0) || !std::isfinite(problem.discount))
    return no_problem("discount", "it must be a number from 0 on.");
  return {};
}

Result<void> check_relations(const SequenceProblem& problem) {
  for (const TaskRelation& relation : problem.relations) {
    const bool alone = relation.kind == TaskRelation::Kind::kAt;
    if (relation.first >= problem.tasks.size() ||
        (!alone && relation.second >= problem.tasks.size()))
      return no_problem("relation", "it names a task that does not exist.");
    if (!alone && relation.first == relation.second)
      return no_problem("relation",
                        fmt::format("task {} is tied to itself.", relation.first));
    if (!is_time(relation.time))
      return no_problem("relation", "its time must be from 0 on.");
  }
  return {};
}

// The precedences that relations say.
std::vector<SequenceTable::Precedence> related(const SequenceProblem& problem) {
  std::vector<SequenceTable::Precedence> all;
  for (const TaskRelation& r : problem.relations) {
    if (r.kind == TaskRelation::Kind::kBefore) all.push_back({r.first, r.second, r.time});
    if (r.kind == TaskRelation::Kind::kAfter) all.push_back({r.second, r.first, r.time});
  }
  return all;
}

// By task: the least of those that begin with it.
std::vector<std::size_t> groups_together(const SequenceProblem& problem,
                                         const std::vector<bool>& done) {
  std::vector<std::size_t> group(problem.tasks.size());
  std::iota(group.begin(), group.end(), std::size_t{0});
  for (std::size_t pass = 0; pass < group.size(); ++pass)
    for (const TaskRelation& r : problem.relations) {
      if (r.kind != TaskRelation::Kind::kTogether) continue;
      if (!done[r.first] || !done[r.second]) continue;
      group[r.first] = group[r.second] = std::min(group[r.first], group[r.second]);
    }
  return group;
}

// Whether no task follows itself; those that begin together count as one.
bool can_be_ordered(const std::vector<SequenceTable::Precedence>& precedences,
                    const std::vector<std::size_t>& group) {
  std::vector<int> waits(group.size(), 0);
  for (const auto& p : precedences) ++waits[group[p.after]];
  std::vector<std::size_t> ready;
  std::size_t ordered = 0, groups = 0;
  for (std::size_t t = 0; t < group.size(); ++t) {
    if (group[t] != t) continue;
    ++groups;
    if (waits[t] == 0) ready.push_back(t);
  }
  while (!ready.empty()) {
    const std::size_t t = ready.back();
    ready.pop_back();
    ++ordered;
    for (const auto& p : precedences)
      if (group[p.before] == t && --waits[group[p.after]] == 0)
        ready.push_back(group[p.after]);
  }
  return ordered == groups;
}

Result<std::vector<Selection>> selections_of(const SequenceProblem& problem) {
  const std::size_t tasks = problem.tasks.size();
  TaskOrder all{Kind::kParallel, 0, problem.orders};
  std::vector<bool> seen(tasks, false);
  std::vector<Part> parts(1);
  if (!all.parts.empty()) {
    const auto found = parts_of(all, seen, 0);
    if (!found) return found.error();
    parts = found.value();
  }
  std::vector<Selection> selections;
  for (const Part& part : parts) {
    Selection selection;
    selection.done.resize(tasks);
    for (std::size_t t = 0; t < tasks; ++t) selection.done[t] = !seen[t];
    for (const std::size_t t : part.tasks) selection.done[t] = true;
    selection.precedences = related(problem);
    for (const auto& [before, after] : part.before)
      selection.precedences.push_back({before, after, 0});
    std::erase_if(selection.precedences, [&](const SequenceTable::Precedence& p) {
      return !selection.done[p.before] || !selection.done[p.after];
    });
    if (!can_be_ordered(selection.precedences, groups_together(problem, selection.done)))
      return no_problem("order", "a task has to follow itself.");
    selections.push_back(std::move(selection));
  }
  return selections;
}

}  // namespace

Result<SequenceSelections> SequenceSelections::of(const SequenceProblem& problem) {
  if (auto good = check_tasks(problem); !good) return good.error();
  if (auto good = check_relations(problem); !good) return good.error();
  auto selections = selections_of(problem);
  if (!selections) return selections.error();
  SequenceSelections all;
  all.problem_ = &problem;
  all.selections_ = std::move(selections).value();
  const std::size_t n = problem.tasks.size();
  bool good = true;
  const auto asked = [&](double time) {
    good = good && is_time(time);
    return time;
  };
  for (std::size_t a = 0; a < problem.aircraft; ++a)
    for (std::size_t from = 0; from < n; ++from) {
      all.start_.push_back(asked(problem.from_start(a, from)));
      if (problem.returns) all.home_.push_back(asked(problem.home(a, from)));
      for (std::size_t to = 0; to < n; ++to)
        all.between_.push_back(from == to ? 0 : asked(problem.between(a, from, to)));
    }
  if (!good)
    return no_problem("flight times",
                      fmt::format("they must be within 0 to {:.0e} s.", kMaxTime));
  return all;
}

SequenceTable SequenceSelections::table(std::size_t selection) const {
  const SequenceProblem& problem = *problem_;
  const Selection& selected = selections_[selection];
  const std::size_t n = problem.tasks.size();
  SequenceTable table;
  table.aircraft = problem.aircraft;
  table.returns = problem.returns;
  table.objective = problem.objective;
  table.discount = problem.discount;
  std::vector<std::size_t> place(n);  // in the table
  for (std::size_t t = 0; t < n; ++t) {
    place[t] = table.name.size();
    if (selected.done[t]) table.name.push_back(t);
  }
  table.tasks = table.name.size();
  const std::vector<std::size_t> group = groups_together(problem, selected.done);
  for (const std::size_t t : table.name) {
    const SequenceTask& task = problem.tasks[t];
    table.service.push_back(task.service);
    table.opens.push_back(task.opens);
    table.closes.push_back(task.closes);
    table.value.push_back(task.value);
    table.together.push_back(place[group[t]]);
  }
  for (const TaskRelation& r : problem.relations) {
    if (r.kind != TaskRelation::Kind::kAt || !selected.done[r.first]) continue;
    double& opens = table.opens[place[r.first]];
    double& closes = table.closes[place[r.first]];
    opens = std::max(opens, r.time);
    closes = std::min(closes, r.time);
  }
  for (const auto& p : selected.precedences)
    table.precedences.push_back({place[p.before], place[p.after], p.gap});
  for (std::size_t a = 0; a < problem.aircraft; ++a)
    for (const std::size_t from : table.name) {
      const auto& eligible = problem.tasks[from].eligible;
      table.eligible.push_back(eligible.empty() || eligible[a]);
      table.start.push_back(start_[a * n + from]);
      if (problem.returns) table.home.push_back(home_[a * n + from]);
      for (const std::size_t to : table.name)
        table.between.push_back(between_[(a * n + from) * n + to]);
    }
  return table;
}

}  // namespace skein::solve
