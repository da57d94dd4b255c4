#include "skein/layer/reasoning/team/allocation/coalition_pricing.h"

#include <algorithm>
#include <cmath>

#include "skein/base/math.h"
#include "skein/layer/reasoning/team/allocation/satisfaction_form.h"

namespace skein::allocation {
namespace {

constexpr std::int64_t kMaxNodes = 200'000;

struct Candidate {
  double brings, cost;
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
  double bound() const { return std::max(best_, cut_off_); }
  const std::vector<std::uint32_t>& members() const { return best_members_; }

 private:
  // What candidates from k on can make of it when parts of them may join.
  double relaxed(std::size_t k, double brought, double cost) const {
    for (; k < candidates_.size(); ++k) {
      const Candidate& c = candidates_[k];
      const double rate = c.cost / c.brings;
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
    return satisfaction_of_sum(form_, brought) - cost;
  }

  void look(std::size_t k, double brought, double cost) {
    const double worth = satisfaction_of_sum(form_, brought) - cost;
    if (worth > best_) {
      best_ = worth;
      best_members_ = members_;
    }
    // Each pass leaves candidate k out; what is below takes it.
    for (; k < candidates_.size(); ++k) {
      const double bound = relaxed(k, brought, cost);
      if (bound <= best_ + 1e-13) return;
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
  std::vector<Candidate> candidates;  // the others
};

Base base_of(const CoalitionTask& task, const std::vector<double>& price,
             const std::vector<Membership>& membership) {
  Base base;
  const bool best = task.form == Satisfaction::kBest;
  for (std::uint32_t i = 0; i < price.size(); ++i) {
    if (membership[i] == Membership::kNever) continue;
    const double cost = task.cost[i] + price[i], brings = task.brings[i];
    if (membership[i] == Membership::kMust || cost <= 0) {
      base.group.members.push_back(i);
      base.brought = best ? std::max(base.brought, brings) : base.brought + brings;
      base.cost += cost;
    } else if (brings > 0) {
      base.candidates.push_back({brings, cost, i});
    }
  }
  return base;
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
                const double left = a.cost * b.brings, right = b.cost * a.brings;
                return left != right ? left < right : a.who < b.who;
              });
    GroupSearch search(task.form, base.candidates);
    search.run(base.brought, base.cost, group.worth);
    group.worth = search.best();
    group.bound = search.bound();
    group.members.insert(group.members.end(), search.members().begin(),
                         search.members().end());
  }
  std::sort(group.members.begin(), group.members.end());
  return group;
}

}  // namespace skein::allocation
