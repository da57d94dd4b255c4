// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/touring/tours.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "skein/solve/allocation/search_random.h"
#include "skein/solve/touring/tour_bound.h"
#include "skein/solve/touring/tour_state.h"

namespace skein::solve::tours_test {
namespace {

TourProblem random_tours(std::uint64_t seed, std::size_t places, std::size_t tours,
                         double wind = 0) {
  SearchRandom random(seed, 3);
  std::vector<std::pair<double, double>> at;
  for (std::size_t k = 0; k < places; ++k)
    at.emplace_back(1000 * random.uniform(), 1000 * random.uniform());
  TourProblem problem;
  problem.places = places;
  problem.tours = tours;
  problem.cost = [at, wind](std::size_t a, std::size_t b) {
    const double x = at[b].first - at[a].first, y = at[b].second - at[a].second;
    return std::sqrt(x * x + y * y) + wind * (std::sqrt(x * x + y * y) - x);
  };
  return problem;
}

double length_of(const TourProblem& problem, const std::vector<std::size_t>& tour) {
  double length = 0;
  std::size_t at = 0;
  for (const std::size_t next : tour) {
    length += problem.cost(at, next);
    at = next;
  }
  return length + (at ? problem.cost(at, 0) : 0);
}

double min_of_all(const TourProblem& problem,
                  std::vector<std::vector<std::size_t>>& tours, std::size_t place) {
  if (place == problem.places) {
    double longest = 0;
    for (const auto& tour : tours) longest = std::max(longest, length_of(problem, tour));
    return longest;
  }
  double least = INFINITY;
  for (auto& tour : tours)
    for (std::size_t k = 0; k <= tour.size(); ++k) {
      tour.insert(tour.begin() + static_cast<std::ptrdiff_t>(k), place);
      least = std::min(least, min_of_all(problem, tours, place + 1));
      tour.erase(tour.begin() + static_cast<std::ptrdiff_t>(k));
    }
  return least;
}

Effort moves(std::int64_t count) {
  Effort effort;
  effort.iterations = count;
  return effort;
}

void expect_whole(const TourProblem& problem, const TourAnswer& answer) {
  std::set<std::size_t> seen;
  double longest = 0;
  for (const auto& tour : answer.tours) {
    for (const std::size_t place : tour) EXPECT_TRUE(seen.insert(place).second);
    longest = std::max(longest, length_of(problem, tour));
  }
  EXPECT_EQ(seen.size(), problem.places - 1);
  EXPECT_FALSE(seen.contains(0));
  EXPECT_EQ(answer.tours.size(), problem.tours);
  EXPECT_NEAR(answer.quality.value, longest, 1e-9 * longest);
  EXPECT_LE(answer.quality.bound, answer.quality.value * (1 + 1e-12));
}

TEST(Tours, OverFewPlacesAreTheShortestOfAll) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    for (const double wind : {0.0, 0.3}) {
      const auto problem = random_tours(seed, 2 + seed % 6, 1 + seed % 3, wind);
      const TourAnswer answer = shortest_tours(problem, moves(20'000));
      std::vector<std::vector<std::size_t>> tours(problem.tours);
      EXPECT_NEAR(answer.quality.value, min_of_all(problem, tours, 1), 1e-9) << seed;
      expect_whole(problem, answer);
    }
}

TEST(Tours, OverOnePlaceAreEmpty) {
  const auto problem = random_tours(1, 1, 2);
  const TourAnswer answer = shortest_tours(problem, moves(10));
  EXPECT_EQ(answer.quality.value, 0);
  EXPECT_TRUE(answer.quality.proven);
}

TEST(Tours, OfManyAircraftReachTheFarthestPlaceAndBack) {
  const auto problem = random_tours(2, 60, 20);
  const TourAnswer answer = shortest_tours(problem, moves(300'000));
  EXPECT_TRUE(answer.quality.proven);
  expect_whole(problem, answer);
}

TEST(Tours, AreTheSameForTheSameSeed) {
  const auto problem = random_tours(3, 80, 3);
  const TourAnswer one = shortest_tours(problem, moves(20'000));
  const TourAnswer other = shortest_tours(problem, moves(20'000));
  EXPECT_EQ(one.tours, other.tours);
  expect_whole(problem, one);
}

TEST(Tours, EndWhenTimeIsUp) {
  const auto problem = random_tours(4, 50, 3);
  Effort effort;
  effort.used = [] { return 1.0; };
  expect_whole(problem, shortest_tours(problem, effort));
}

// Lengths that are kept are those that are there.
TEST(TourState, KeepsLengthsThroughAllChanges) {
  const auto problem = random_tours(5, 30, 3);
  const TourCosts costs(problem);
  TourState state(costs, 3);
  SearchRandom random(5, 4);
  for (std::uint32_t p = 1; p < 30; ++p)
    state.insert(p, state.depot(static_cast<std::uint32_t>(random.below(3))));
  for (int k = 0; k < 2000; ++k) {
    const auto a = static_cast<std::uint32_t>(1 + random.below(29));
    const auto b = static_cast<std::uint32_t>(1 + random.below(29));
    if (a == b) continue;
    state.remove(a);
    state.insert(a, b);
    TourState measured = state;
    measured.measure();
    std::size_t places = 0;
    for (std::uint32_t t = 0; t < 3; ++t) {
      ASSERT_NEAR(state.length(t), measured.length(t), 1e-6);
      ASSERT_EQ(state.count(t), state.lists()[t].size());
      places += state.count(t);
    }
    ASSERT_EQ(places, 29U);
  }
}

// One tour over places on a circle is known; so is what its bound must not exceed.
TEST(TourBound, IsNearTheShortestTour) {
  TourProblem problem;
  problem.places = 24;
  problem.cost = [](std::size_t a, std::size_t b) {
    const double angle = (static_cast<double>(a) - static_cast<double>(b)) * M_PI / 24;
    return std::abs(2 * std::sin(angle));
  };
  const double around = 24 * problem.cost(0, 1);
  const double bound = tour_bound(TourCosts(problem), 1);
  EXPECT_LE(bound, around * (1 + 1e-9));
  EXPECT_GE(bound, 0.99 * around);
}

}  // namespace
}  // namespace skein::solve::tours_test
