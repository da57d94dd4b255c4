// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/test/independent_coalitions.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace independent {
namespace {

using Real = long double;
constexpr Real kNever = -std::numeric_limits<Real>::infinity();
// Three thirds are a whole: the definition's own tolerance.
constexpr Real kOne = 1 - 1e-12L;

Real satisfaction(Form form, Real brought) {
  if (form == Form::kRootFromOne) return brought >= kOne ? std::sqrt(brought) : 0;
  return form == Form::kLargest ? brought : std::min<Real>(1, brought);
}

Real gathered(Form form, Real brought, double more) {
  return form == Form::kLargest ? std::max<Real>(brought, more) : brought + more;
}

enum class May : std::uint8_t { kBe, kNotBe, kMustBe };
using Row = std::vector<May>;

// The group worth most under prices: members in the order of their prices, the dearest
// first, each in or out; a part of the search is left where what it holds, were all the
// others to join for nothing but what they are paid, is worth no more.
class Richest {
 public:
  Richest(const Task& task, const std::vector<double>& price, const Row& row)
      : task_(task) {
    for (std::size_t i = 0; i < price.size(); ++i) {
      const Real cost = Real(task.cost[i]) + price[i];
      if (row[i] == May::kNotBe) continue;
      if (row[i] == May::kMustBe || cost <= 0) {
        brought_ = gathered(task.form, brought_, task.brings[i]);
        paid_ += cost;
      } else if (task.brings[i] > 0) {
        others_.push_back({cost, task.brings[i]});
      }
    }
    std::sort(others_.begin(), others_.end(), [](const Other& a, const Other& b) {
      return a.brings > b.brings || (a.brings == b.brings && a.cost < b.cost);
    });
  }

  Real worth() {
    if (task_.form == Form::kLargest) {
      best_ = brought_ - paid_;
      for (const Other& o : others_)
        best_ = std::max(best_, std::max<Real>(brought_, o.brings) - paid_ - o.cost);
      return best_;
    }
    best_ = satisfaction(task_.form, brought_) - paid_;
    look(0, brought_, paid_);
    return best_;
  }

 private:
  struct Other {
    Real cost;
    double brings;
  };

  // A line above the satisfaction makes the worth a sum over members, of which those
  // that add are taken: for any t > 0, sqrt(x) <= x / (2 t) + t / 2; min(1, x) <= s x +
  // 1 - s for s in [0, 1]. A few t and s: each bounds, the least counts. Below 1 the
  // satisfaction is nothing, so that s x with s = 1 bounds from there too.
  Real ceiling(std::size_t from, Real brought, Real paid) const {
    Real least = std::numeric_limits<Real>::infinity();
    const auto line = [&](Real slope, Real at_zero) {
      Real sum = at_zero + slope * brought - paid;
      for (std::size_t k = from; k < others_.size(); ++k)
        sum += std::max<Real>(0, slope * others_[k].brings - others_[k].cost);
      least = std::min(least, sum);
    };
    if (task_.form == Form::kSumUpToOne) {
      for (int k = 0; k <= 8; ++k) line(k / Real(8), 1 - k / Real(8));
      return least;
    }
    // sqrt(x) for x >= 1, 0 below: also below x, and below s (x - 1) + 1 for s >= 1/2.
    for (int k = 4; k <= 12; ++k) line(k / Real(8), 1 - k / Real(8));
    for (const Real t : {1.15L, 1.35L, 1.6L, 2.0L, 2.6L, 4.0L}) line(1 / (2 * t), t / 2);
    return least;
  }

  void look(std::size_t k, Real brought, Real paid) {
    best_ = std::max(best_, satisfaction(task_.form, brought) - paid);
    if (k == others_.size()) return;
    // Nothing that is left may end below the whole and be worth more than what is paid.
    if (ceiling(k, brought, paid) <= best_) return;
    look(k + 1, brought + others_[k].brings, paid + others_[k].cost);
    look(k + 1, brought, paid);
  }

  const Task& task_;
  std::vector<Other> others_;
  Real brought_ = 0, paid_ = 0, best_ = kNever;
};

class Proof {
 public:
  Proof(const Coalitions& problem, const std::vector<ProofPart>& parts, Real limit)
      : problem_(problem), parts_(parts), limit_(limit) {}

  bool holds() {
    if (parts_.empty()) return false;
    return closed(
        0, std::vector<Row>(problem_.tasks.size(), Row(problem_.aircraft, May::kBe)));
  }

 private:
  static bool has_members(const Row& row) {
    return std::find(row.begin(), row.end(), May::kMustBe) != row.end();
  }
  Real added(std::size_t k, const ProofPart& part, const Row& row) const {
    const Real worth = Richest(problem_.tasks[k], part.price, row).worth();
    return has_members(row) ? worth : std::max<Real>(worth, 0);
  }

  bool closed(std::size_t at, std::vector<Row> may) const {
    const ProofPart& part = parts_[at];
    if (part.price.empty()) return halves_closed(at, std::move(may));
    if (part.price.size() != problem_.aircraft) return false;
    Real bound = 0;
    for (const double p : part.price) {
      if (problem_.idle_allowed && p < 0) return false;
      bound += p;
    }
    std::vector<Real> of_task;
    for (std::size_t k = 0; k < may.size(); ++k) {
      of_task.push_back(added(k, part, may[k]));
      bound += of_task.back();
    }
    if (bound <= limit_) return true;
    leave_out(part, bound, of_task, may);
    return halves_closed(at, std::move(may));
  }

  bool halves_closed(std::size_t at, std::vector<Row> may) const {
    const ProofPart& part = parts_[at];
    if (part.with <= at || part.without <= at || part.with >= parts_.size() ||
        part.without >= parts_.size() || part.task >= may.size() ||
        part.aircraft >= problem_.aircraft)
      return false;
    std::vector<Row> without = may;
    without[part.task][part.aircraft] = May::kNotBe;
    if (!closed(part.without, std::move(without))) return false;
    for (std::size_t k = 0; k < may.size(); ++k)
      may[k][part.aircraft] = k == part.task ? May::kMustBe : May::kNotBe;
    return closed(part.with, std::move(may));
  }

  // Memberships that no allocation above the limit has.
  void leave_out(const ProofPart& part, Real bound, const std::vector<Real>& of_task,
                 std::vector<Row>& may) const {
    for (std::size_t k = 0; k < may.size(); ++k) {
      const Row row = may[k];
      for (std::size_t i = 0; i < row.size(); ++i) {
        if (row[i] != May::kBe) continue;
        Row with = row;
        with[i] = May::kMustBe;
        if (bound - of_task[k] + added(k, part, with) <= limit_) may[k][i] = May::kNotBe;
      }
    }
  }

  const Coalitions& problem_;
  const std::vector<ProofPart>& parts_;
  Real limit_;
};

}  // namespace

long double utility(const Coalitions& problem, const std::vector<int>& task_of) {
  std::vector<Real> brought(problem.tasks.size(), 0);
  Real costs = 0;
  for (std::size_t i = 0; i < problem.aircraft; ++i) {
    if (task_of[i] < 0) {
      if (!problem.idle_allowed) return kNever;
      continue;
    }
    const auto k = static_cast<std::size_t>(task_of[i]);
    const Task& task = problem.tasks[k];
    brought[k] = gathered(task.form, brought[k], task.brings[i]);
    costs += task.cost[i];
  }
  Real sum = -costs;
  for (std::size_t k = 0; k < brought.size(); ++k)
    sum += satisfaction(problem.tasks[k].form, brought[k]);
  return sum;
}

long double best_utility(const Coalitions& problem) {
  const std::size_t sets = std::size_t{1} << problem.aircraft;
  // Of every set of aircraft the best with the tasks so far: none yet.
  std::vector<double> best(sets, problem.idle_allowed ? 0 : double(kNever));
  best[0] = 0;
  std::vector<double> group(sets), next(sets);
  for (const Task& task : problem.tasks) {
    for (std::size_t set = 0; set < sets; ++set) {
      Real brought = 0, cost = 0;
      for (std::size_t i = 0; i < problem.aircraft; ++i) {
        if (((set >> i) & 1) == 0) continue;
        brought = gathered(task.form, brought, task.brings[i]);
        cost += task.cost[i];
      }
      group[set] = double(satisfaction(task.form, brought) - cost);
    }
    for (std::size_t set = 0; set < sets; ++set) {
      double most = best[set] + group[0];
      for (std::size_t part = set; part != 0; part = (part - 1) & set)
        most = std::max(most, best[set ^ part] + group[part]);
      next[set] = most;
    }
    std::swap(best, next);
  }
  return best[sets - 1];
}

bool is_proof(const Coalitions& problem, const std::vector<ProofPart>& parts,
              long double claimed, long double tolerance) {
  return Proof(problem, parts, claimed + tolerance).holds();
}

}  // namespace independent
