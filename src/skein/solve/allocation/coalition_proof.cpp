// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/allocation/coalition_proof.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "skein/base/math.h"
#include "skein/solve/allocation/coalition_annealing.h"
#include "skein/solve/allocation/coalition_pricing.h"
#include "skein/solve/allocation/group_master.h"

namespace skein::solve {
namespace {

constexpr double kPenalty = -1e3;   // for what is not allowed: no group is worth that
constexpr double kReduced = 1e-11;  // groups that are worth no more are not added
constexpr double kSmooth = 0.5;     // of the best prices that go into the next
constexpr std::int64_t kMaxSteps = 20'000;
constexpr int kMaxRounds = 2'000;
constexpr int kNodesWithoutProof = 30;

using Memberships = std::vector<std::vector<Membership>>;  // by task, by aircraft

// A part of all allocations.
struct Node {
  Memberships membership;
  double bound = 0;      // of its parent
  std::size_t part = 0;  // of the proof
};

class GroupPricing {
 public:
  GroupPricing(const CoalitionProblem& problem, const Effort& effort,
               CoalitionAnswer& answer, CoalitionProof* proof)
      : problem_(problem),
        effort_(effort),
        answer_(answer),
        proof_(proof),
        master_(problem.aircraft, problem.tasks.size()) {
    for (const CoalitionTask& task : problem.tasks)
      for (const double cost : task.cost) scale_ = std::max(scale_, std::abs(cost));
    if (proof_) proof_->parts.assign(1, {});
  }

  void run() {
    Node root;
    root.membership.assign(problem_.tasks.size(),
                           std::vector<Membership>(problem_.aircraft, Membership::kFree));
    root.bound = bound_under(std::vector<double>(problem_.aircraft, 0), root.membership);
    add_answer();
    const double bound = solve(root);
    if (root.bound <= bound) price_.assign(problem_.aircraft, 0);
    note_prices(root, -math::kInfinity);
    root.bound = std::min(root.bound, bound);
    answer_.quality.bound = std::max(root.bound, answer_.quality.value);
    if (!is_closed(root.bound)) {
      strike_out(root);
      branch(root);
    }
    answer_.quality.proven = is_closed(answer_.quality.bound);
    // What was left out on the way may be above the answer by the tolerance.
    if (answer_.quality.proven)
      answer_.quality.bound = answer_.quality.value + tolerance();
  }

 private:
  double tolerance() const {
    return kProofTolerance * std::max(scale_, std::abs(answer_.quality.value));
  }
  bool is_closed(double bound) const {
    return bound <= answer_.quality.value + tolerance();
  }

  // What a task adds to the bound at the most: nothing, unless it must have members.
  static double bound_of(const PricedGroup& group,
                         const std::vector<Membership>& membership) {
    return has_must(membership) ? group.bound : std::max(group.bound, 0.0);
  }

  // The bound that prices give, rounded upwards; groups that better the master are added
  // on request.
  double bound_under(const std::vector<double>& price, const Memberships& membership,
                     bool adds = false) {
    double bound = 0, size = 0;
    const auto add = [&](double x) {
      bound += x;
      size += std::abs(x);
    };
    for (const double p : price) add(p);
    for (std::size_t k = 0; k < problem_.tasks.size(); ++k) {
      const PricedGroup group = best_group(problem_.tasks[k], price, membership[k]);
      add(bound_of(group, membership[k]));
      if (adds && !group.members.empty()) add_if_better(k, group);
    }
    const auto numbers = static_cast<double>(price.size() + problem_.tasks.size() + 4);
    return bound + numbers * std::numeric_limits<double>::epsilon() * size;
  }

  static bool has_must(const std::vector<Membership>& membership) {
    return std::find(membership.begin(), membership.end(), Membership::kMust) !=
           membership.end();
  }

  // Prices that were smoothed find groups that are nothing under the master's own.
  void add_if_better(std::size_t k, const PricedGroup& group) {
    GroupColumn column = column_of(k, group);
    double reduced = column.utility - master_.prices()[problem_.aircraft + k];
    for (const std::uint32_t i : column.members) reduced -= master_.prices()[i];
    if (reduced <= kReduced) return;
    master_.add(std::move(column));
    added_ = true;
  }

  GroupColumn column_of(std::size_t k, const PricedGroup& group) const {
    GroupColumn column;
    column.task = static_cast<std::uint32_t>(k);
    column.members = group.members;
    std::vector<std::size_t> members(group.members.begin(), group.members.end());
    column.utility = satisfaction_of(problem_.tasks[k], members);
    for (const std::size_t i : members) column.utility -= problem_.tasks[k].cost[i];
    return column;
  }

  void add_answer() {
    for (std::size_t k = 0; k < problem_.tasks.size(); ++k) {
      PricedGroup group;
      for (std::uint32_t i = 0; i < problem_.aircraft; ++i)
        if (answer_.task[i] == k) group.members.push_back(i);
      if (!group.members.empty()) master_.add(column_of(k, group));
    }
  }

  static bool is_allowed(const GroupColumn& column, const Memberships& membership) {
    const auto& allowed = membership[column.task];
    std::size_t next = 0;
    for (std::uint32_t i = 0; i < allowed.size(); ++i) {
      const bool in = next < column.members.size() && column.members[next] == i;
      if (in) ++next;
      if (allowed[i] == (in ? Membership::kNever : Membership::kMust)) return false;
    }
    return true;
  }

  // The master for a part: what is not allowed there costs a penalty.
  void set_up(const Memberships& membership) {
    for (std::size_t i = 0; i < problem_.aircraft; ++i)
      master_.set_idle(i, problem_.idle_allowed ? 0 : kPenalty);
    for (std::size_t k = 0; k < problem_.tasks.size(); ++k) {
      master_.set_empty(k, has_must(membership[k]) ? kPenalty : 0);
      for (std::size_t i = 0; i < problem_.aircraft; ++i)
        if (membership[k][i] == Membership::kMust) master_.set_idle(i, kPenalty);
    }
    for (std::size_t j = master_.first_group(); j < master_.columns(); ++j) {
      const GroupColumn& column = master_.column(j);
      const bool allowed = is_allowed(column, membership);
      master_.set_utility(j, allowed ? column.utility : kPenalty, allowed);
    }
  }

  // The bound of a part, by column generation; ends early where it cannot matter.
  double solve(const Node& node) {
    set_up(node.membership);
    double bound = math::kInfinity;
    std::vector<double> best_price;
    for (int round = 0; round < kMaxRounds; ++round) {
      if (effort_.ended()) break;
      if (!master_.solve(kMaxSteps)) break;
      ++answer_.quality.iterations;
      std::vector<double> price(
          master_.prices().begin(),
          master_.prices().begin() + static_cast<std::ptrdiff_t>(problem_.aircraft));
      if (problem_.idle_allowed)
        for (double& p : price) p = std::max(p, 0.0);
      const double before = bound;
      added_ = false;
      for (const double smooth : {best_price.empty() ? 0 : kSmooth, 0.0}) {
        std::vector<double> tried = price;
        for (std::size_t i = 0; smooth > 0 && i < tried.size(); ++i)
          tried[i] += smooth * (best_price[i] - tried[i]);
        const double found = bound_under(tried, node.membership, true);
        if (found < bound) {
          bound = found;
          best_price = tried;
        }
        if (added_ || smooth == 0) break;
      }
      if (!added_ || is_closed(bound)) break;
      if (bound - master_.value() < 1e-9 && before - bound < 1e-9) break;
    }
    price_ = best_price;
    take_whole();
    return bound;
  }

  // Takes the solution of the master where it is whole, or nearly so after rounding.
  void take_whole() {
    std::vector<std::size_t> order;
    for (std::size_t j = master_.first_group(); j < master_.columns(); ++j)
      if (master_.amount(j) > 1e-5) order.push_back(j);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return master_.amount(a) > master_.amount(b);
    });
    std::vector<std::size_t> task(problem_.aircraft, CoalitionAnswer::kIdle);
    std::vector<bool> taken(problem_.tasks.size(), false);
    for (const std::size_t j : order) {
      const GroupColumn& column = master_.column(j);
      if (taken[column.task]) continue;
      taken[column.task] = true;
      for (const std::uint32_t i : column.members)
        if (task[i] == CoalitionAnswer::kIdle) task[i] = column.task;
    }
    if (!problem_.idle_allowed)
      for (std::size_t i = 0; i < task.size(); ++i)
        if (task[i] == CoalitionAnswer::kIdle) task[i] = answer_.task[i];
    polish_coalitions(problem_, task);
    const double utility = utility_of(problem_, task);
    if (utility <= answer_.quality.value) return;
    answer_.quality.value = utility;
    answer_.task = std::move(task);
  }

  // Memberships that no better allocation has: with them the bound of the last prices is
  // not above the answer.
  void strike_out(Node& node) {
    if (price_.empty()) return;
    const double bound = bound_under(price_, node.membership);
    for (std::size_t k = 0; k < problem_.tasks.size(); ++k) {
      auto& membership = node.membership[k];
      // As in `bound`, of which it is taken away.
      const double free =
          bound_of(best_group(problem_.tasks[k], price_, membership), membership);
      for (std::size_t i = 0; i < problem_.aircraft; ++i) {
        if (membership[i] != Membership::kFree) continue;
        membership[i] = Membership::kMust;
        const double with = best_group(problem_.tasks[k], price_, membership).bound;
        membership[i] =
            is_closed(bound - free + with) ? Membership::kNever : Membership::kFree;
      }
    }
  }

  struct Split {
    std::size_t task = 0, aircraft = 0;
    double part = 0;  // of the membership in the master's solution
  };

  // The membership that is most of a half in the master's solution; part 0: all are
  // whole.
  Split split_of() const {
    std::vector<double> part(problem_.tasks.size() * problem_.aircraft, 0.0);
    for (std::size_t j = master_.first_group(); j < master_.columns(); ++j) {
      const double amount = master_.amount(j);
      if (amount < 1e-5) continue;
      const GroupColumn& column = master_.column(j);
      for (const std::uint32_t i : column.members)
        part[column.task * problem_.aircraft + i] += amount;
    }
    Split split;
    double nearest = 0.5 - 1e-4;
    for (std::size_t c = 0; c < part.size(); ++c) {
      if (std::abs(part[c] - 0.5) >= nearest) continue;
      nearest = std::abs(part[c] - 0.5);
      split = {c / problem_.aircraft, c % problem_.aircraft, part[c]};
    }
    return split;
  }

  // The prices that bound a part best: those noted before where its bound was lower.
  void note_prices(const Node& node, double bound) {
    if (!proof_) return;
    std::vector<double>& price = proof_->parts[node.part].price;
    if (price.empty() || bound < node.bound) price = price_;
  }
  // New parts of the proof for the children of a node.
  void note_split(Node& with, Node& without, const Split& split) {
    if (!proof_) return;
    const std::size_t next = proof_->parts.size();
    CoalitionProof::Part& part = proof_->parts[with.part];
    part.task = split.task;
    part.aircraft = split.aircraft;
    part.with = with.part = next;
    part.without = without.part = next + 1;
    proof_->parts.resize(next + 2);
  }

  // Splits parts until none is left that may hold something better, the most promising
  // first.
  void branch(const Node& root) {
    std::vector<Node> open = {root};
    const auto less = [](const Node& a, const Node& b) { return a.bound < b.bound; };
    // What was given up: parts that could not be split.
    double left = -math::kInfinity;
    int nodes = 0;
    while (!open.empty()) {
      std::pop_heap(open.begin(), open.end(), less);
      Node node = std::move(open.back());
      open.pop_back();
      answer_.quality.bound = std::max({node.bound, left, answer_.quality.value});
      if (is_closed(node.bound) || effort_.ended()) return;
      if (!effort_.prove && nodes++ == kNodesWithoutProof) return;
      const double found = solve(node);
      note_prices(node, found);
      const double bound = std::min(node.bound, found);
      if (is_closed(bound)) continue;
      if (effort_.ended()) return;
      const Split split = split_of();
      if (split.part == 0) {
        left = std::max(left, bound);
        continue;
      }
      node.bound = bound;
      strike_out(node);
      Node without = node;
      without.membership[split.task][split.aircraft] = Membership::kNever;
      for (std::size_t k = 0; k < problem_.tasks.size(); ++k)
        node.membership[k][split.aircraft] =
            k == split.task ? Membership::kMust : Membership::kNever;
      note_split(node, without, split);
      for (Node* child : {&node, &without}) {
        open.push_back(std::move(*child));
        std::push_heap(open.begin(), open.end(), less);
      }
    }
    answer_.quality.bound = std::max(answer_.quality.value, left);
  }

  const CoalitionProblem& problem_;
  const Effort& effort_;
  CoalitionAnswer& answer_;
  CoalitionProof* proof_;
  double scale_ = 1;  // of utilities and costs
  GroupMaster master_;
  std::vector<double> price_;  // of the last bound
  bool added_ = false;
};

}  // namespace

void bound_coalitions(const CoalitionProblem& problem, const Effort& effort,
                      CoalitionAnswer& answer, CoalitionProof* proof) {
  if (problem.tasks.empty() || problem.aircraft == 0) {
    answer.quality.bound = answer.quality.value;
    answer.quality.proven = true;
    return;
  }
  GroupPricing(problem, effort, answer, proof).run();
}

}  // namespace skein::solve
