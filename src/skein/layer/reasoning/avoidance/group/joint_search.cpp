// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/group/joint_search.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <optional>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "skein/layer/reasoning/avoidance/encounter/plan_encounter.h"
#include "skein/layer/reasoning/avoidance/manoeuvre/replanned_flight.h"
#include "skein/model/path/flight_plan.h"
#include "skein/solve/path/repair.h"

namespace skein::reasoning {
namespace {

constexpr std::array kJointStrengths = {1.0, 1.7, 3.0};
constexpr std::size_t kRoundsPerMember = 6;
constexpr double kMinGain = 1e-6;  // [s]

class JointSearch {
 public:
  JointSearch(const JointProblem& problem, std::size_t max_encounters)
      : problem_(problem), left_(max_encounters), pools_(problem.members.size()) {
    for (std::size_t i = 0; i < pools_.size(); ++i) {
      const FlightPlan& plan = problem.members[i].flight.plan;
      JointChoice going_on;
      going_on.flight = solve::part_of(plan, problem.begin, model::end_time_of(plan));
      pools_[i].push_back(std::move(going_on));
    }
    chosen_.assign(pools_.size(), 0);
    best_ = chosen_;
  }

  JointSolution run() {
    note();
    for (std::size_t k = 0; k < kRoundsPerMember * pools_.size() && best_conflicts_ > 0;
         ++k)
      if (!solve_earliest()) break;
    if (best_conflicts_ == 0) improve();
    JointSolution solution;
    for (std::size_t i = 0; i < pools_.size(); ++i) {
      solution.choices.push_back(pools_[i][best_[i]]);
      solution.cost += solution.choices.back().cost;
    }
    solution.conflicts = best_conflicts_;
    return solution;
  }

 private:
  struct Found {
    std::size_t i = 0, j = 0;
    PlanEncounter encounter;
  };

  std::size_t size() const { return pools_.size(); }
  const Separation& kept(std::size_t i, std::size_t j) const {
    return problem_.kept[i * size() + j];
  }

  // The encounter of two choices; looked at once.
  const std::optional<PlanEncounter>& encounter(std::size_t i, std::size_t a,
                                                std::size_t j, std::size_t b) {
    if (i > j) return encounter(j, b, i, a);
    const std::uint64_t key = ((i * size() + j) << 40) | (a << 20) | b;
    const auto [at, first] = encounters_.try_emplace(key);
    if (first) {
      left_ -= std::min<std::size_t>(left_, 1);
      at->second = first_encounter(pools_[i][a].flight, pools_[j][b].flight, kept(i, j),
                                   problem_.begin, problem_.look_until);
    }
    return at->second;
  }

  // Keeps the present choices if they are the best so far. @returns the earliest
  // conflict.
  std::optional<Found> note() {
    std::optional<Found> earliest;
    std::size_t conflicts = 0;
    double cost = 0;
    for (std::size_t i = 0; i < size(); ++i) {
      cost += pools_[i][chosen_[i]].cost;
      for (std::size_t j = i + 1; j < size(); ++j) {
        const auto& met = encounter(i, chosen_[i], j, chosen_[j]);
        if (!met) continue;
        ++conflicts;
        if (!earliest || met->begin < earliest->encounter.begin) earliest = {i, j, *met};
      }
    }
    if (std::tuple(conflicts, cost) < std::tuple(best_conflicts_, best_cost_)) {
      best_ = chosen_;
      best_conflicts_ = conflicts;
      best_cost_ = cost;
    }
    return earliest;
  }

  // What a member can do about a conflict, added to its pool.
  void make(std::size_t who, const NegotiatedConflict& conflict, double strength) {
    const JointProblem::Member& member = problem_.members[who];
    const FlightPlan part = solve::part_of(
        member.flight.plan, model::start_of(member.flight.plan), member.flight.rejoins);
    const ConflictOfFlight about{part,
                                 member.flight.limits,
                                 conflict.begin,
                                 conflict.meets,
                                 conflict.closest,
                                 conflict.apart,
                                 conflict.separation};
    std::vector<JointChoice>& pool = pools_[who];
    std::vector<Candidate> all = candidates(about, strength);
    const std::size_t near =
        add_encounters(all, about, member.others, problem_.look_until);
    for (Candidate& each : all) {
      left_ -= std::min(left_, near);
      if (each.manoeuvre.kind == ManoeuvreKind::kGoOn) {
        if (pool.size() == 1) pool.front().cost = each.cost;
        continue;
      }
      append_rest(each.flight, member.flight.plan, member.flight.rejoins);
      if (problem_.is_free && !problem_.is_free(each.flight)) continue;
      pool.push_back({conflict, each.manoeuvre, std::move(each.flight), each.cost});
    }
  }

  // What a choice costs with what all but two members have chosen.
  double cost_among(std::size_t who, std::size_t choice, std::size_t other,
                    const NegotiatedConflict& conflict) {
    double cost = pools_[who][choice].cost;
    for (std::size_t k = 0; k < size(); ++k) {
      if (k == who || k == other) continue;
      if (const auto& met = encounter(who, choice, k, chosen_[k]))
        cost += cost_of_encounter(*met, conflict.meets);
    }
    return cost;
  }

  // The cheapest pair of choices of the two of a conflict that is apart.
  bool choose_pair(const Found& found, const NegotiatedConflict& conflict) {
    std::vector<double> of_i, of_j;
    for (std::size_t a = 0; a < pools_[found.i].size(); ++a)
      of_i.push_back(cost_among(found.i, a, found.j, conflict));
    for (std::size_t b = 0; b < pools_[found.j].size(); ++b)
      of_j.push_back(cost_among(found.j, b, found.i, conflict));
    using Ranked = std::tuple<double, std::size_t, std::size_t>;
    std::vector<Ranked> pairs;
    for (std::size_t a = 0; a < of_i.size(); ++a)
      for (std::size_t b = 0; b < of_j.size(); ++b)
        pairs.emplace_back(of_i[a] + of_j[b], a, b);
    std::ranges::sort(pairs);
    for (const auto& [cost, a, b] : pairs) {
      if (left_ == 0) return false;
      if (encounter(found.i, a, found.j, b)) continue;
      chosen_[found.i] = a;
      chosen_[found.j] = b;
      return true;
    }
    return false;
  }

  // @returns whether something else was chosen.
  bool solve_earliest() {
    const auto found = note();
    if (!found || left_ == 0) return false;
    NegotiatedConflict conflict;
    conflict.begin = problem_.begin;
    conflict.meets = static_cast<float>(found->encounter.begin);
    conflict.closest = static_cast<float>(found->encounter.closest_time);
    conflict.apart = static_cast<float>(found->encounter.end);
    conflict.separation = kept(found->i, found->j);
    for (const double strength : kJointStrengths) {
      make(found->i, conflict, strength);
      make(found->j, conflict, strength);
      if (choose_pair(*found, conflict)) {
        note();
        return true;
      }
    }
    return false;
  }

  // Whether a choice is apart from what all others have chosen, but one.
  bool is_apart(std::size_t who, std::size_t choice, std::size_t but) {
    for (std::size_t k = 0; k < size(); ++k)
      if (k != who && k != but && encounter(who, choice, k, chosen_[k])) return false;
    return true;
  }

  double cost(std::size_t who, std::size_t choice) const {
    return pools_[who][choice].cost;
  }

  // The choices of a member that cost less than a limit, the cheapest first.
  std::vector<std::size_t> cheaper(std::size_t who, double limit) const {
    std::vector<std::size_t> all(pools_[who].size());
    std::iota(all.begin(), all.end(), 0U);
    std::erase_if(all, [&](std::size_t a) { return cost(who, a) >= limit; });
    std::ranges::stable_sort(all, {}, [&](std::size_t a) { return cost(who, a); });
    return all;
  }

  // A member takes what is cheapest as the others fly.
  bool improve_one(std::size_t who) {
    for (const std::size_t a : cheaper(who, cost(who, chosen_[who]) - kMinGain)) {
      if (left_ == 0) return false;
      if (!is_apart(who, a, who)) continue;
      chosen_[who] = a;
      return true;
    }
    return false;
  }

  // Two take together what is cheapest as the others fly.
  bool improve_two(std::size_t i, std::size_t j) {
    const double limit = cost(i, chosen_[i]) + cost(j, chosen_[j]) - kMinGain;
    std::vector<std::size_t> of_i = cheaper(i, limit), of_j = cheaper(j, limit);
    std::erase_if(of_i, [&](std::size_t a) { return !is_apart(i, a, j); });
    std::erase_if(of_j, [&](std::size_t b) { return !is_apart(j, b, i); });
    std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;
    for (const std::size_t a : of_i)
      for (const std::size_t b : of_j)
        if (cost(i, a) + cost(j, b) < limit)
          pairs.emplace_back(cost(i, a) + cost(j, b), a, b);
    std::ranges::sort(pairs);
    for (const auto& [sum, a, b] : pairs) {
      if (left_ == 0) return false;
      if (encounter(i, a, j, b)) continue;
      chosen_[i] = a;
      chosen_[j] = b;
      return true;
    }
    return false;
  }

  bool improve_any() {
    bool changed = false;
    for (std::size_t i = 0; i < size() && left_ > 0; ++i) changed |= improve_one(i);
    if (changed) return true;
    for (std::size_t i = 0; i < size() && left_ > 0; ++i)
      for (std::size_t j = i + 1; j < size() && left_ > 0; ++j)
        if (improve_two(i, j)) return true;
    return false;
  }

  // One member, else two, take what is cheaper as the others fly, until nothing changes.
  void improve() {
    chosen_ = best_;
    while (left_ > 0 && improve_any()) {
    }
    note();
  }

  const JointProblem& problem_;
  std::size_t left_;  // encounters that may still be looked at
  std::vector<std::vector<JointChoice>> pools_;
  std::unordered_map<std::uint64_t, std::optional<PlanEncounter>> encounters_;
  std::vector<std::size_t> chosen_, best_;
  std::size_t best_conflicts_ = SIZE_MAX;
  double best_cost_ = 0;
};

}  // namespace

JointSolution solve_jointly(const JointProblem& problem, std::size_t max_encounters) {
  return JointSearch(problem, max_encounters).run();
}

}  // namespace skein::reasoning
