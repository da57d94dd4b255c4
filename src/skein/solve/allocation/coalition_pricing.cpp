// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/allocation/coalition_pricing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "skein/base/math.h"
#include "skein/solve/allocation/satisfaction_form.h"

namespace skein::solve {
namespace {

constexpr std::int64_t kMaxNodes = 200'000;
// Groups that are not worth more than the best by this are not searched for; the bound
// has it.
constexpr double kPruned = 1e-13;
// A relaxation that fills a group up to kWhole ends at it up to the rounding of its sum:
// it is taken for whole from a little below.
constexpr double kNearlyWhole = kWhole - 1e-12;

struct Candidate {
  double brings, cost;
  double rate;  // cost for what it brings
  std::uint32_t who;
};

// Members that are bought: those that cost something and bring something.
class GroupSearch {
 public:
  GroupSearch(Satisfaction form, const std::vector<Candidate>& candidates)
      : form_(form), candidates_(candidates) {}

  // The best that can be added to what is there; `best` is what nothing added gives.
  void run(double brought, double cost, double best) {
    best_ = best;
    look(0, brought, cost);
  }

  double best() const { return best_; }
  double bound() const { return std::max(best_ + kPruned, cut_off_); }
  const std::vector<std::uint32_t>& members() const { return best_members_; }

 private:
  // What candidates from k on can make of it when parts of them may join: nothing that
  // they make of it is worth more, whatever the rounding of its sums.
  double relaxed(std::size_t k, double brought, double cost) const {
    for (; k < candidates_.size(); ++k) {
      const Candidate& c = candidates_[k];
      const double rate = c.rate;
      const double needed = form_ == Satisfaction::kRoot ? kWhole - brought : 0;
      double useful = 1 - brought;  // kShare: up to the whole, at any rate below 1
      if (form_ == Satisfaction::kRoot)
        useful = std::max(needed, 0.25 / (rate * rate) - brought);
      else if (rate >= 1)
        useful = 0;
      if (useful <= 0) break;
      const double part = std::min(useful, c.brings);
      brought += part;
      cost += part * rate;
      if (part < c.brings) break;
    }
    if (is_nearly_whole(brought)) brought = 1;
    return satisfaction_of_sum(form_, brought) - cost;
  }

  bool is_nearly_whole(double brought) const {
    return form_ == Satisfaction::kRoot && brought >= kNearlyWhole && brought < 1;
  }

  void look(std::size_t k, double brought, double cost) {
    const double worth = satisfaction_of_sum(form_, brought) - cost;
    if (worth > best_) {
      best_ = worth;
      best_members_ = members_;
    } else if (is_nearly_whole(brought)) {
      cut_off_ = std::max(cut_off_, 1 - cost);  // in another order its sum may be whole
    }
    // Each pass leaves candidate k out; what is below takes it.
    for (; k < candidates_.size(); ++k) {
      const double bound = relaxed(k, brought, cost);
      if (bound <= best_ + kPruned) return;
      if (++nodes_ > kMaxNodes) {
        cut_off_ = std::max(cut_off_, bound);
        return;
      }
      members_.push_back(candidates_[k].who);
      look(k + 1, brought + candidates_[k].brings, cost + candidates_[k].cost);
      members_.pop_back();
    }
  }

  Satisfaction form_;
  const std::vector<Candidate>& candidates_;
  double best_ = 0, cut_off_ = -math::kInfinity;
  std::int64_t nodes_ = 0;
  std::vector<std::uint32_t> members_, best_members_;
};

// What is in any case: those who must, and those who cost less than nothing.
struct Base {
  PricedGroup group;
  double brought = 0, cost = 0;
  double size = 0;  // of all numbers that sums are made of, without signs
  std::vector<Candidate> candidates;  // the others
};

Base base_of(const CoalitionTask& task, const std::vector<double>& price,
             const std::vector<Membership>& membership) {
  Base base;
  const bool best = task.form == Satisfaction::kBest;
  for (std::uint32_t i = 0; i < price.size(); ++i) {
    if (membership[i] == Membership::kNever) continue;
    const double cost = task.cost[i] + price[i], brings = task.brings[i];
    base.size += std::abs(task.cost[i]) + std::abs(price[i]);
    if (membership[i] == Membership::kMust || cost <= 0) {
      base.group.members.push_back(i);
      base.brought = best ? std::max(base.brought, brings) : base.brought + brings;
      base.cost += cost;
    } else if (brings > 0) {
      base.candidates.push_back({brings, cost, cost / brings, i});
    }
  }
  return base;
}

// What sums of numbers of such a size in all may be off by: each addition by half a unit
// of its last place, and as much for each product.
double rounding_of(double size, std::size_t numbers) {
  constexpr double kUnit = std::numeric_limits<double>::epsilon();
  return kUnit * static_cast<double>(numbers + 4) * std::abs(size);
}

void add_leader(const Base& base, PricedGroup& group) {
  for (const Candidate& c : base.candidates) {
    const double worth = std::max(base.brought, c.brings) - base.cost - c.cost;
    if (worth <= group.worth) continue;
    group.worth = worth;
    group.members = base.group.members;
    group.members.push_back(c.who);
  }
  group.bound = group.worth;
}

}  // namespace

PricedGroup best_group(const CoalitionTask& task, const std::vector<double>& price,
                       const std::vector<Membership>& membership) {
  Base base = base_of(task, price, membership);
  PricedGroup group = base.group;
  group.worth = satisfaction_of_sum(task.form, base.brought) - base.cost;
  if (task.form == Satisfaction::kBest) {
    add_leader(base, group);
  } else {
    std::sort(base.candidates.begin(), base.candidates.end(),
              [](const Candidate& a, const Candidate& b) {
                return a.rate != b.rate ? a.rate < b.rate : a.who < b.who;
              });
    GroupSearch search(task.form, base.candidates);
    search.run(base.brought, base.cost, group.worth);
    group.worth = search.best();
    group.bound = search.bound();
    group.members.insert(group.members.end(), search.members().begin(),
                         search.members().end());
  }
  std::sort(group.members.begin(), group.members.end());
  group.bound += rounding_of(base.size + std::abs(group.worth), price.size());
  return group;
}

}  // namespace skein::solve
