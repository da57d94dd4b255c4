// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "skein/solve/touring/tours.h"

namespace skein::solve {

/// Costs of all pairs of places, and who is near whom.
class TourCosts {
 public:
  explicit TourCosts(const TourProblem& problem);

  double operator()(std::uint32_t from, std::uint32_t to) const {
    return cost_[from * places_ + to];
  }
  std::uint32_t places() const { return places_; }
  /// The other places but place 0, the nearest first (there and back).
  const std::vector<std::uint32_t>& near(std::uint32_t place) const {
    return near_[place];
  }
  bool is_symmetric() const;
  /// What is_metric() passes over, of a detour: the rounding of costs.
  static constexpr double kMetricTolerance = 1e-12;
  /// Whether no detour over a third place is shorter than the straight way.
  bool is_metric() const;

 private:
  std::uint32_t places_;
  std::vector<double> cost_;
  std::vector<std::vector<std::uint32_t>> near_;
};

/// Tours as rings of nodes. Node p is place p; the rings begin at nodes of their own, one
/// for each tour, which stand for place 0.
class TourState {
 public:
  TourState(const TourCosts& costs, std::size_t tours);

  std::uint32_t tours() const { return static_cast<std::uint32_t>(length_.size()); }
  std::uint32_t depot(std::uint32_t tour) const { return costs_->places() + tour; }
  bool is_depot(std::uint32_t node) const { return node >= costs_->places(); }
  std::uint32_t next(std::uint32_t node) const { return next_[node]; }
  std::uint32_t previous(std::uint32_t node) const { return previous_[node]; }
  std::uint32_t tour_of(std::uint32_t node) const { return tour_[node]; }
  bool is_in_tour(std::uint32_t node) const { return tour_[node] != kNone; }
  double length(std::uint32_t tour) const { return length_[tour]; }
  std::uint32_t count(std::uint32_t tour) const { return count_[tour]; }
  double longest() const;

  /// What inserting a place behind a node adds to its tour.
  double added(std::uint32_t place, std::uint32_t behind) const {
    const std::uint32_t a = place_of(behind), b = place_of(next_[behind]);
    return (*costs_)(a, place) + (*costs_)(place, b) - (*costs_)(a, b);
  }
  void insert(std::uint32_t place, std::uint32_t behind);
  void remove(std::uint32_t place);

  /// All lengths anew, without the rounding of many changes.
  void measure();
  std::vector<std::vector<std::size_t>> lists() const;

 private:
  static constexpr std::uint32_t kNone = 0xffffffff;
  std::uint32_t place_of(std::uint32_t node) const {
    return node < costs_->places() ? node : 0;
  }

  const TourCosts* costs_;
  std::vector<std::uint32_t> next_, previous_, tour_, count_;
  std::vector<double> length_;
};

}  // namespace skein::solve
