// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/touring/tour_state.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "skein/base/check.h"

namespace skein::solve {

TourCosts::TourCosts(const TourProblem& problem)
    : places_(static_cast<std::uint32_t>(problem.places)) {
  SKEIN_CHECK(problem.places >= 1 && problem.tours >= 1 && problem.places < 1'000'000,
              problem.places, problem.tours);
  cost_.resize(std::size_t{places_} * places_);
  for (std::uint32_t a = 0; a < places_; ++a)
    for (std::uint32_t b = 0; b < places_; ++b)
      cost_[a * places_ + b] = a == b ? 0 : problem.cost(a, b);
  near_.resize(places_);
  for (std::uint32_t a = 1; a < places_; ++a) {
    for (std::uint32_t b = 1; b < places_; ++b)
      if (b != a) near_[a].push_back(b);
    const auto there_and_back = [&](std::uint32_t b) {
      return (*this)(a, b) + (*this)(b, a);
    };
    std::stable_sort(near_[a].begin(), near_[a].end(),
                     [&](std::uint32_t b, std::uint32_t c) {
                       return there_and_back(b) < there_and_back(c);
                     });
  }
}

bool TourCosts::is_symmetric() const {
  for (std::uint32_t a = 0; a < places_; ++a)
    for (std::uint32_t b = 0; b < a; ++b)
      if ((*this)(a, b) != (*this)(b, a)) return false;
  return true;
}

bool TourCosts::is_metric() const {
  for (std::uint32_t a = 0; a < places_; ++a)
    for (std::uint32_t b = 0; b < places_; ++b)
      for (std::uint32_t c = 0; c < places_; ++c)
        if ((*this)(a, c) > ((*this)(a, b) + (*this)(b, c)) * (1 + kMetricTolerance))
          return false;
  return true;
}

TourState::TourState(const TourCosts& costs, std::size_t tours) : costs_(&costs) {
  const std::size_t nodes = costs.places() + tours;
  next_.resize(nodes);
  std::iota(next_.begin(), next_.end(), 0);
  previous_ = next_;
  tour_.assign(nodes, kNone);
  for (std::size_t k = 0; k < tours; ++k)
    tour_[costs.places() + k] = static_cast<std::uint32_t>(k);
  count_.assign(tours, 0);
  length_.assign(tours, 0);
}

double TourState::longest() const {
  return *std::max_element(length_.begin(), length_.end());
}

void TourState::insert(std::uint32_t place, std::uint32_t behind) {
  const std::uint32_t tour = tour_[behind], after = next_[behind];
  length_[tour] += added(place, behind);
  ++count_[tour];
  tour_[place] = tour;
  next_[behind] = previous_[after] = place;
  previous_[place] = behind;
  next_[place] = after;
}

void TourState::remove(std::uint32_t place) {
  const std::uint32_t tour = tour_[place];
  const std::uint32_t before = previous_[place], after = next_[place];
  next_[before] = after;
  previous_[after] = before;
  --count_[tour];
  length_[tour] -= added(place, before);
  tour_[place] = kNone;
}

void TourState::measure() {
  for (std::uint32_t k = 0; k < tours(); ++k) {
    length_[k] = 0;
    std::uint32_t node = depot(k);
    do {
      length_[k] += (*costs_)(place_of(node), place_of(next_[node]));
      node = next_[node];
    } while (node != depot(k));
  }
}

std::vector<std::vector<std::size_t>> TourState::lists() const {
  std::vector<std::vector<std::size_t>> lists(tours());
  for (std::uint32_t k = 0; k < tours(); ++k)
    for (std::uint32_t node = next_[depot(k)]; node != depot(k); node = next_[node])
      lists[k].push_back(node);
  return lists;
}

}  // namespace skein::solve
