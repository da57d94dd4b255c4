// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "skein/data/describe/strict_json.h"
#include "skein/exchange/team/case_lists.h"
#include "skein/exchange/team/team_cases.h"

namespace skein::exchange {
namespace {

using namespace solve;  // NOLINT: what is read is all of there
using strict_json::Fields;
using strict_json::Value;

constexpr double kMaxTime = 1e7;  // [s]
constexpr int kMaxOrderDepth = 30;

// Places and speeds, from which flight times follow.
struct StraightFlights {
  std::vector<Vec2> starts, tasks;
  std::vector<double> speeds;
};

class SequenceCaseReader {
 public:
  explicit SequenceCaseReader(const Value& object) : fields_(object) {}

  SequenceCase read() {
    found_.id = fields_.text("id");
    read_objective();
    found_.problem.returns = fields_.flag("returns", false);
    read_list(fields_, "aircraft", aircraft_, [&](Fields& inner) {
      flights_->starts.push_back(read_point(inner, ""));
      flights_->speeds.push_back(inner.number("speed_mps", 0.01, 1000));
    });
    found_.problem.aircraft = aircraft_.size();
    read_list(fields_, "tasks", found_.tasks, [&](Fields& inner) { read_task(inner); });
    read_relations();
    for (const Value& order : fields_.items("orders", kMaxListed, true))
      found_.problem.orders.push_back(read_order(order, 0));
    if (aircraft_.empty() && !found_.tasks.empty())
      fields_.problem("aircraft", "there must be at least one.");
    set_times();
    return std::move(found_);
  }

 private:
  void read_objective() {
    // A discount says by itself what counts.
    const bool discounted = fields_.has("discount_per_s");
    found_.problem.objective = static_cast<SequenceObjective>(fields_.word(
        "objective", {"last-end", "total", "discounted"}, discounted ? 2U : 0U));
    discounted_ = found_.problem.objective == SequenceObjective::kDiscounted;
    if (discounted != discounted_)
      fields_.problem("objective", "\"discounted\" and discount_per_s need each other.");
    if (discounted) found_.problem.discount = fields_.number("discount_per_s", 0, 1e3);
  }

  void read_task(Fields& fields) {
    SequenceTask task;
    flights_->tasks.push_back(read_point(fields, ""));
    task.service = fields.number("service_s", 0, kMaxTime, 0);
    task.opens = fields.number("opens_s", 0, kMaxTime, 0);
    if (fields.has("closes_s"))
      task.closes = fields.number("closes_s", task.opens, kMaxTime);
    if (discounted_) task.value = fields.number("value", 0, 1e9);
    if (const auto list = fields.value("eligible", true)) {
      task.eligible.assign(aircraft_.size(), false);
      const auto ids = list->items(kMaxListed);
      for (const Value& id : ids) {
        const auto at = index_of(aircraft_, id);
        if (at)
          task.eligible[*at] = true;
        else
          id.report("must be the id of an aircraft.");
      }
      if (ids.empty()) list->report("names no aircraft.");
    }
    found_.problem.tasks.push_back(std::move(task));
  }

  void read_relations() {
    using Kind = TaskRelation::Kind;
    for (const Value& item : fields_.items("relations", kMaxListed, true)) {
      Fields fields(item);
      TaskRelation relation;
      relation.kind =
          static_cast<Kind>(fields.word("kind", {"before", "after", "at", "together"}));
      relation.first = task_in(fields, "first");
      if (relation.kind != Kind::kAt) relation.second = task_in(fields, "second");
      if (relation.kind == Kind::kAt)
        relation.time = fields.number("time_s", 0, kMaxTime);
      else if (relation.kind != Kind::kTogether)
        relation.time = fields.number("time_s", 0, kMaxTime, 0);
      found_.problem.relations.push_back(relation);
    }
  }

  // A task's id, or {"sequence": [...]}, {"alternative": [...]}, {"parallel": [...]}.
  TaskOrder read_order(const Value& value, int depth) {
    using Kind = TaskOrder::Kind;
    TaskOrder order;
    if (const auto task = index_of(found_.tasks, value)) {
      order.task = *task;
      return order;
    }
    static const std::pair<const char*, Kind> kKinds[] = {
        {"sequence", Kind::kSequence},
        {"alternative", Kind::kAlternative},
        {"parallel", Kind::kParallel}};
    for (const auto& [name, kind] : kKinds) {
      const strict_json::Json& json = value.json();
      if (!json.is_object() || json.size() != 1 || !json.contains(name)) continue;
      const Value parts = value.at(name);
      if (!parts.json().is_array() || parts.json().empty() || depth >= kMaxOrderDepth)
        break;
      order.kind = kind;
      for (const Value& part : parts.items(kMaxListed))
        order.parts.push_back(read_order(part, depth + 1));
      return order;
    }
    value.report(
        fmt::format("must be the id of a task, or an object with one key "
                    "(sequence, alternative or parallel) and a list of such "
                    "parts, at most {} deep.",
                    kMaxOrderDepth));
    return order;
  }

  std::size_t task_in(Fields& fields, const char* key) {
    const std::int64_t id = fields.whole(key, 1, kMaxId);
    const auto at = std::find(found_.tasks.begin(), found_.tasks.end(), id);
    if (at != found_.tasks.end())
      return static_cast<std::size_t>(at - found_.tasks.begin());
    fields.problem(key, fmt::format("no task has the id {}.", id));
    return 0;
  }

  static std::optional<std::size_t> index_of(const std::vector<std::int64_t>& ids,
                                             const Value& id) {
    if (!id.json().is_number_integer()) return std::nullopt;
    for (std::size_t k = 0; k < ids.size(); ++k)
      if (id.json() == ids[k]) return k;
    return std::nullopt;
  }

  void set_times() {
    SequenceProblem& problem = found_.problem;
    problem.from_start = [flights = flights_](std::size_t a, std::size_t t) {
      return (flights->starts[a] - flights->tasks[t]).norm() / flights->speeds[a];
    };
    problem.between = [flights = flights_](std::size_t a, std::size_t s, std::size_t t) {
      return (flights->tasks[s] - flights->tasks[t]).norm() / flights->speeds[a];
    };
    problem.home = problem.from_start;
  }

  Fields fields_;
  SequenceCase found_;
  std::vector<std::int64_t> aircraft_;
  std::shared_ptr<StraightFlights> flights_ = std::make_shared<StraightFlights>();
  bool discounted_ = false;
};

}  // namespace

Result<std::vector<SequenceCase>> read_sequence_cases(std::string_view text,
                                                      const std::string& place) {
  return read_cases<SequenceCase>(
      text, place, [](const Value& object) { return SequenceCaseReader(object).read(); });
}

}  // namespace skein::exchange
