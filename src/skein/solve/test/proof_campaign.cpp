// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/test/proof_campaign.h"

#include <fmt/format.h>

#include <cmath>
#include <random>

#include "skein/solve/allocation/coalition_proof.h"
#include "skein/solve/allocation/coalitions.h"
#include "skein/solve/allocation/sequences.h"
#include "skein/solve/test/independent_coalitions.h"
#include "skein/solve/test/independent_routes.h"
#include "skein/solve/touring/tours.h"

namespace skein::solve::test {
namespace {

// What two computations of the same sums may differ by, relative to 1 and the value.
constexpr double kSums = 1e-11;
constexpr std::size_t kMaxSubsets = 16;

class Draw {
 public:
  explicit Draw(std::uint32_t number) : engine_(number * 2654435761U + 17) {}
  double part() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  std::size_t below(std::size_t n) { return engine_() % n; }
  std::size_t within(std::size_t low, std::size_t high) {
    return low + below(high - low + 1);
  }
  bool chance(double p) { return part() < p; }

 private:
  std::mt19937_64 engine_;
};

// Three ways to draw what aircraft bring and cost: any numbers; as teams of unlike
// aircraft have them; and few different ones, so that much is equal.
CoalitionTask drawn_task(Draw& draw, std::size_t aircraft, std::size_t way) {
  CoalitionTask task;
  task.form = static_cast<Satisfaction>(draw.below(3));
  if (way == 1) task.form = draw.chance(0.65) ? Satisfaction::kRoot : Satisfaction::kBest;
  const double wanted = static_cast<double>(draw.within(1, 5));
  for (std::size_t i = 0; i < aircraft; ++i) {
    const double u = draw.part();
    if (way == 0)
      task.brings.push_back(draw.chance(0.3) ? 0 : 1.2 * u);
    else if (way == 1)
      task.brings.push_back(draw.chance(0.4) ? 0 : 2 * u * u);
    else if (task.form == Satisfaction::kRoot)
      task.brings.push_back(draw.chance(0.3) ? 0 : 1 / wanted);
    else
      task.brings.push_back(0.25 * std::floor(4 * u));
    task.cost.push_back(way == 2 ? 0.1 * static_cast<double>(draw.below(8))
                                 : (way == 1 ? 1 : 0.6) * draw.part());
  }
  return task;
}

CoalitionProblem drawn_coalitions(Draw& draw, std::size_t aircraft) {
  CoalitionProblem problem;
  problem.aircraft = aircraft;
  problem.idle_allowed = draw.chance(0.4);
  const std::size_t way = draw.below(3);
  const std::size_t tasks = aircraft > kMaxSubsets ? aircraft * 2 / 5 : draw.within(2, 8);
  for (std::size_t k = 0; k < tasks; ++k)
    problem.tasks.push_back(drawn_task(draw, aircraft, way));
  return problem;
}

independent::Coalitions as_independent(const CoalitionProblem& problem) {
  independent::Coalitions same;
  same.aircraft = problem.aircraft;
  same.idle_allowed = problem.idle_allowed;
  for (const CoalitionTask& task : problem.tasks) {
    independent::Form form = independent::Form::kSumUpToOne;
    if (task.form == Satisfaction::kRoot) form = independent::Form::kRootFromOne;
    if (task.form == Satisfaction::kBest) form = independent::Form::kLargest;
    same.tasks.push_back({form, task.brings, task.cost});
  }
  return same;
}

double slack(double tolerance, double value) {
  return tolerance * std::max(1.0, std::abs(value));
}

// Notes a claim about something that is maximised.
void judge(const Quality& quality, double best, const std::string& what,
           ProofTally& tally) {
  tally.proven += quality.proven ? 1 : 0;
  const bool false_proof =
      quality.proven && quality.value < best - slack(kProofTolerance + kSums, best);
  const bool false_bound =
      quality.bound < best - slack(kSums, best) ||
      quality.value > best + slack(kSums, best);  // more than there is
  tally.false_proofs += false_proof ? 1 : 0;
  tally.false_bounds += false_bound ? 1 : 0;
  if ((false_proof || false_bound) && tally.first.empty())
    tally.first =
        fmt::format("{}: value {:.12f}, bound {:.12f}, best {:.12f}{}", what,
                    quality.value, quality.bound, best, quality.proven ? ", proven" : "");
}

// The proof of branch and price, begun from a greedy answer, for any number of aircraft.
void judge_branching(const CoalitionProblem& problem, const independent::Coalitions& same,
                     const double* best, const std::string& what, ProofTally& tally) {
  CoalitionAnswer answer;
  answer.task = greedy_coalitions(problem);
  answer.quality.value = utility_of(problem, answer.task);
  Effort effort;
  effort.prove = true;
  CoalitionProof proof;
  bound_coalitions(problem, effort, answer, &proof);
  if (best) judge(answer.quality, *best, what, tally);
  if (!answer.quality.proven) return;
  tally.proven += best ? 0 : 1;
  std::vector<int> task_of;
  for (const std::size_t k : answer.task)
    task_of.push_back(k == CoalitionAnswer::kIdle ? -1 : static_cast<int>(k));
  std::vector<independent::ProofPart> parts;
  for (const CoalitionProof::Part& part : proof.parts) {
    const auto index = [](std::size_t k) { return k == CoalitionProof::kNone ? 0 : k; };
    parts.push_back(
        {part.price, part.task, part.aircraft, index(part.with), index(part.without)});
  }
  const long double value = independent::utility(same, task_of);
  const double tolerance = slack(kProofTolerance + kSums, static_cast<double>(value));
  if (independent::is_proof(same, parts, value, tolerance)) return;
  ++tally.unconfirmed;
  if (tally.first.empty()) tally.first = what + ": the proof is not confirmed";
}

// Routes with everything that ties them.
SequenceProblem drawn_routes(Draw& draw, independent::Routing& same) {
  SequenceProblem problem;
  const std::size_t tasks = draw.within(1, 6);
  problem.aircraft = same.aircraft = draw.within(1, tasks > 5 ? 2 : 3);
  problem.objective = static_cast<SequenceObjective>(draw.below(3));
  same.goal = static_cast<independent::Goal>(problem.objective);
  problem.discount = same.discount = 0.01 * draw.part();
  problem.returns = same.returns = draw.chance(0.4);
  const bool windows = draw.chance(0.4), whole = draw.chance(0.3);
  const auto time = [&](double most) {
    return whole ? std::floor(most / 10 * draw.part()) * 10 : most * draw.part();
  };
  for (std::size_t t = 0; t < tasks; ++t) {
    SequenceTask task;
    task.service = time(60);
    task.value = 10 + 90 * draw.part();
    if (windows && draw.chance(0.5)) task.opens = time(150);
    if (windows && draw.chance(0.4)) task.closes = task.opens + time(300);
    task.eligible.assign(problem.aircraft, true);
    for (std::size_t a = 1; a < problem.aircraft; ++a)
      task.eligible[a] = draw.chance(0.8);
    problem.tasks.push_back(task);
    same.work.push_back(
        {task.service, task.opens, task.closes, task.value, task.eligible});
  }
  const auto row = [&] {
    std::vector<double> times;
    for (std::size_t t = 0; t < tasks; ++t) times.push_back(time(200));
    return times;
  };
  for (std::size_t a = 0; a < problem.aircraft; ++a) {
    same.start.push_back(row());
    same.home.push_back(row());
    same.leg.emplace_back();
    for (std::size_t t = 0; t < tasks; ++t) same.leg.back().push_back(row());
  }
  problem.from_start = [&same](std::size_t a, std::size_t t) { return same.start[a][t]; };
  problem.between = [&same](std::size_t a, std::size_t s, std::size_t t) {
    return same.leg[a][s][t];
  };
  problem.home = [&same](std::size_t a, std::size_t t) { return same.home[a][t]; };
  if (tasks > 1 && draw.chance(0.4)) {
    const double gap = time(50);
    problem.relations.push_back({TaskRelation::Kind::kBefore, 0, 1, gap});
    same.ties.push_back({false, 0, 1, gap});
  }
  if (tasks > 3 && problem.aircraft > 1 && draw.chance(0.3)) {
    problem.relations.push_back({TaskRelation::Kind::kTogether, 2, 3, 0});
    same.ties.push_back({true, 2, 3, 0});
  }
  if (tasks > 4 && draw.chance(0.3)) {
    TaskOrder either{TaskOrder::Kind::kAlternative, 0, {}};
    for (const std::size_t t : {tasks - 2, tasks - 1}) {
      either.parts.push_back({TaskOrder::Kind::kTask, t, {}});
      same.one_of.push_back(t);
    }
    problem.orders.push_back(either);
  }
  return problem;
}

}  // namespace

void ProofTally::add(const ProofTally& other) {
  problems += other.problems;
  proven += other.proven;
  false_proofs += other.false_proofs;
  false_bounds += other.false_bounds;
  unconfirmed += other.unconfirmed;
  if (first.empty()) first = other.first;
}

ProofTally check_coalition_proof(std::uint32_t number, std::size_t max_aircraft) {
  Draw draw(number);
  const double size = draw.part();
  std::size_t aircraft = draw.within(2, 12);
  if (size > 0.75) aircraft = draw.within(13, 14);
  if (size > 0.9) aircraft = draw.within(15, kMaxSubsets);
  if (size > 0.95) aircraft = draw.within(17, std::max<std::size_t>(17, max_aircraft));
  return check_coalition_proof_of(number, std::min(aircraft, max_aircraft));
}

ProofTally check_coalition_proof_of(std::uint32_t number, std::size_t aircraft) {
  Draw draw(number + 0x5bd1e995U);
  const CoalitionProblem problem = drawn_coalitions(draw, aircraft);
  const independent::Coalitions same = as_independent(problem);
  const std::string what =
      fmt::format("coalitions {}, {} aircraft, {} tasks{}", number, aircraft,
                  problem.tasks.size(), problem.idle_allowed ? "" : ", nobody idle");
  ProofTally tally;
  tally.problems = 1;
  if (aircraft > kMaxSubsets) {
    judge_branching(problem, same, nullptr, what, tally);
    return tally;
  }
  const auto best = static_cast<double>(independent::best_utility(same));
  Effort effort;
  effort.prove = draw.chance(0.5);
  judge(best_coalitions(problem, effort).quality, best, what, tally);
  judge_branching(problem, same, &best, what + ", by branching", tally);
  return tally;
}

ProofTally check_route_proof(std::uint32_t number) {
  Draw draw(number);
  independent::Routing same;
  const SequenceProblem problem = drawn_routes(draw, same);
  ProofTally tally;
  tally.problems = 1;
  const std::string what = fmt::format("routes {}, {} aircraft, {} tasks", number,
                                       problem.aircraft, problem.tasks.size());
  const auto found = best_sequences(problem, {});
  if (!found) {
    ++tally.unconfirmed;
    tally.first = what + ": " + found.error().message;
    return tally;
  }
  const auto least = static_cast<double>(independent::least_cost(same));
  Quality quality = found.value().quality;
  if (problem.objective != SequenceObjective::kDiscounted) {
    quality.value = -quality.value;  // as something that is maximised
    quality.bound = -quality.bound;
  }
  if (!found.value().feasible) {
    quality.value = -least;  // nothing is claimed but the bound
    if (std::isfinite(least) && problem.tasks.size() <= 8) {
      ++tally.unconfirmed;
      if (tally.first.empty()) tally.first = what + ": an answer was missed";
    }
  }
  if (!std::isfinite(least)) {
    tally.false_proofs += found.value().feasible || quality.proven ? 1 : 0;
    if (found.value().feasible && tally.first.empty())
      tally.first = what + ": an answer where there is none";
    return tally;
  }
  judge(quality, -least, what, tally);
  return tally;
}

ProofTally check_tour_proof(std::uint32_t number) {
  Draw draw(number);
  const std::size_t places = draw.within(2, 8), tours = draw.within(1, 3);
  const std::size_t way = draw.below(3);
  std::vector<double> north, east;
  for (std::size_t k = 0; k < places; ++k) {
    // Some on a lattice and some in one place: distances that are equal or 0.
    north.push_back(draw.chance(0.5) ? 100 * draw.part()
                                     : 25 * static_cast<double>(draw.below(4)));
    east.push_back(draw.chance(0.7) ? 100 * draw.part() : 0);
  }
  std::vector<std::vector<double>> cost(places, std::vector<double>(places, 0));
  for (std::size_t a = 0; a < places; ++a)
    for (std::size_t b = 0; b < places; ++b) {
      if (a == b) continue;
      const double far = std::hypot(north[a] - north[b], east[a] - east[b]);
      const double tail = 0.3 * (north[b] - north[a]);
      cost[a][b] = way == 0 ? far : way == 1 ? far - tail : 100 * draw.part();
    }
  const auto best = static_cast<double>(independent::shortest_longest_tour(cost, tours));
  Effort effort;
  effort.iterations = 2'000;
  const TourAnswer answer = shortest_tours(
      {places, tours, [&](std::size_t a, std::size_t b) { return cost[a][b]; }}, effort);
  Quality quality = answer.quality;
  quality.value = -quality.value;
  quality.bound = -quality.bound;
  ProofTally tally;
  tally.problems = 1;
  judge(quality, -best,
        fmt::format("tours {}, {} places, {} tours", number, places, tours), tally);
  return tally;
}

}  // namespace skein::solve::test
