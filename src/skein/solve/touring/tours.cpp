// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/touring/tours.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "skein/base/check.h"
#include "skein/base/math.h"
#include "skein/solve/allocation/search_random.h"
#include "skein/solve/touring/tour_bound.h"
#include "skein/solve/touring/tour_state.h"

namespace skein::solve {
namespace {

constexpr double kMeanRemoved = 10;  // places taken out in an iteration
constexpr double kMaxString = 10;    // of one tour
constexpr double kBlink = 0.01;      // share of positions that are passed over
constexpr int kMinSquarings = 2;     // of the powers of lengths that recreating sums
constexpr std::size_t kSquarings = 4;
constexpr std::size_t kNear = 12;  // neighbours beside which a place is put
constexpr double kHot = 0.01;      // temperatures, as shares of the longest tour
constexpr double kCold = 0.00005;
constexpr double kTotalWeight = 0.02;           // of the mean length beside the longest
constexpr std::int64_t kAnnealing = 2'500'000;  // iterations from hot to cold
constexpr int kClockEvery = 256;
constexpr double kProven = 1e-10;  // a tour that is above its bound by less is the best

// x to the power of 2^squarings.
double raised(double x, int squarings) {
  for (int k = 0; k < squarings; ++k) x *= x;
  return x;
}

// Ruin and recreate under simulated annealing.
class TourSearch {
 public:
  TourSearch(const TourCosts& costs, std::size_t tours, double bound, std::uint64_t seed)
      : costs_(costs),
        state_(costs, tours),
        best_(state_),
        bound_(bound),
        random_(seed, 0),
        ruined_(tours, 0) {
    removed_.resize(costs.places() - 1);
    std::iota(removed_.begin(), removed_.end(), 1U);
    scale_ = std::max(bound, std::numeric_limits<double>::min());
    recreate();
    keep_if_better();
  }

  std::int64_t run(const Effort& effort, std::int64_t iterations) {
    std::int64_t made = 0;
    while (made < iterations && !effort.ended() && !is_optimal())
      made += anneal(effort, std::min(iterations - made, kAnnealing));
    return made;
  }

  bool is_optimal() const { return best_.longest() <= bound_ * (1 + kProven); }
  const TourState& best() const { return best_; }

 private:
  double cost_now() const {
    double total = 0;
    for (std::uint32_t t = 0; t < state_.tours(); ++t) total += state_.length(t);
    return state_.longest() + kTotalWeight * total / state_.tours();
  }
  // From hot to cold in so many iterations, or in the time that is left if that is less.
  std::int64_t anneal(const Effort& effort, std::int64_t iterations) {
    const double begun = effort.share_used();
    double cost = cost_now(), temperature = 0;
    std::int64_t k = 0;
    for (; k < iterations && !is_optimal(); ++k) {
      if (k % kClockEvery == 0) {
        const double time = effort.share_used();
        if (time >= 1) break;
        const double share =
            std::max(static_cast<double>(k) / static_cast<double>(iterations),
                     (time - begun) / (1 - begun));
        temperature = kHot * best_.longest() * math::pow(kCold / kHot, share);
        scale_ = state_.longest();
      }
      if (!ruin_and_recreate(cost - temperature * math::log(random_.uniform()))) continue;
      cost = cost_now();
      keep_if_better();
    }
    return k;
  }

  bool ruin_and_recreate(double limit) {
    ruin();
    recreate();
    if (cost_now() < limit) return true;
    take_back();
    return false;
  }

  void keep_if_better() {
    if (ever_ && !(state_.longest() < best_.longest() * (1 - 1e-12))) return;
    ever_ = true;
    state_.measure();
    best_ = state_;
  }

  void take_out(std::uint32_t place) {
    undo_.push_back({place, state_.previous(place)});
    state_.remove(place);
    removed_.push_back(place);
  }

  // A string of `length` places that holds `place`.
  void take_string(std::uint32_t place, std::uint32_t length) {
    const std::uint32_t tour = state_.tour_of(place);
    std::uint32_t node = place;
    for (std::size_t back = random_.below(length); back > 0; --back) {
      if (state_.is_depot(state_.previous(node))) break;
      node = state_.previous(node);
    }
    for (std::uint32_t k = 0; k < length; ++k) {
      if (state_.is_depot(node)) {  // the end came first: go on before the string
        node = state_.previous(node);
        if (state_.is_depot(node)) return;
        take_out(node);
        node = state_.next(state_.depot(tour));
        if (!state_.is_depot(node)) node = state_.depot(tour);
        continue;
      }
      const std::uint32_t after = state_.next(node);
      take_out(node);
      node = after;
    }
  }

  void ruin() {
    undo_.clear();
    removed_.clear();
    ++round_;
    const std::size_t places = costs_.places() - 1;
    if (places == 0) return;
    const double mean_count =
        static_cast<double>(places) / static_cast<double>(state_.tours());
    const double longest = std::min(kMaxString, std::max(1.0, mean_count));
    const double max_strings = 4 * kMeanRemoved / (1 + longest) - 1;
    const auto strings = static_cast<std::size_t>(1 + random_.uniform() * max_strings);
    std::uint32_t seed = static_cast<std::uint32_t>(1 + random_.below(places));
    std::size_t taken = 0;
    take_near(seed, longest, taken);
    for (const std::uint32_t place : costs_.near(seed)) {
      if (taken >= strings) break;
      take_near(place, longest, taken);
    }
  }

  void take_near(std::uint32_t place, double longest, std::size_t& taken) {
    if (!state_.is_in_tour(place)) return;
    const std::uint32_t tour = state_.tour_of(place);
    if (ruined_[tour] == round_) return;
    ruined_[tour] = round_;
    const double most = std::min(longest, static_cast<double>(state_.count(tour)));
    take_string(place, static_cast<std::uint32_t>(1 + random_.uniform() * most));
    ++taken;
  }

  void sort_removed() {
    const std::size_t order = random_.below(7);
    if (order < 4) {
      for (std::size_t k = removed_.size(); k > 1; --k)
        std::swap(removed_[k - 1], removed_[random_.below(k)]);
      return;
    }
    const bool far_first = order < 6;
    std::sort(removed_.begin(), removed_.end(), [&](std::uint32_t a, std::uint32_t b) {
      const double da = costs_(0, a) + costs_(a, 0), db = costs_(0, b) + costs_(b, 0);
      if (da != db) return far_first ? da > db : da < db;
      return a < b;
    });
  }

  void look_at(std::uint32_t place, std::uint32_t behind) {
    const std::uint32_t tour = state_.tour_of(behind);
    const double length = state_.length(tour) / scale_;
    const double added = state_.added(place, behind) / scale_;
    const double cost =
        raised(length + added, squarings_) - raised(length, squarings_) + 1e-3 * added;
    if (cost >= min_added_) return;
    if (random_.uniform() < kBlink) return;
    min_added_ = cost;
    where_ = behind;
  }

  void recreate() {
    sort_removed();
    squarings_ = kMinSquarings + static_cast<int>(random_.below(kSquarings));
    for (const std::uint32_t place : removed_) {
      min_added_ = math::kInfinity;
      std::size_t seen = 0;
      for (const std::uint32_t other : costs_.near(place)) {
        if (!state_.is_in_tour(other)) continue;
        look_at(place, other);
        look_at(place, state_.previous(other));
        if (++seen == kNear) break;
      }
      for (std::uint32_t t = 0; t < state_.tours(); ++t) {
        look_at(place, state_.depot(t));
        if (state_.count(t) > 0) look_at(place, state_.previous(state_.depot(t)));
      }
      if (min_added_ == math::kInfinity) where_ = state_.depot(0);
      state_.insert(place, where_);
    }
  }

  void take_back() {
    for (const std::uint32_t place : removed_) state_.remove(place);
    for (std::size_t k = undo_.size(); k-- > 0;)
      state_.insert(undo_[k].place, undo_[k].behind);
  }

  struct Undo {
    std::uint32_t place, behind;
  };

  const TourCosts& costs_;
  TourState state_, best_;
  double bound_;
  SearchRandom random_;
  std::vector<std::uint64_t> ruined_;  // the round in which a tour was
  std::uint64_t round_ = 0;
  std::vector<std::uint32_t> removed_;
  std::vector<Undo> undo_;
  double scale_ = 1, min_added_ = 0;
  std::uint32_t where_ = 0;
  int squarings_ = 3;
  bool ever_ = false;
};

}  // namespace

TourAnswer shortest_tours(const TourProblem& problem, const Effort& effort) {
  const TourCosts costs(problem);
  const double bound = tour_bound(costs, problem.tours);
  TourSearch search(costs, problem.tours, bound, effort.seed);
  const std::int64_t iterations = effort.moves(kAnnealing);
  TourAnswer answer;
  answer.quality.iterations = search.run(effort, iterations);
  answer.tours = search.best().lists();
  answer.quality.value = search.best().longest();
  answer.quality.bound = bound;
  answer.quality.proven = search.is_optimal();
  return answer;
}

}  // namespace skein::solve
