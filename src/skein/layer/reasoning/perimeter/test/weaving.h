// SPDX-License-Identifier: Apache-2.0
#pragma once

// Flights along the edge of fires, for the tests of estimators.

#include <cmath>
#include <vector>

#include "skein/base/random.h"
#include "skein/geo/polygon.h"
#include "skein/role/perimeter_estimator.h"

namespace skein::perimeter {

// Two aircraft weave along a closed line of corners, 20 m to either side of it, at 15 m/s
// along it, one from its beginning and one from halfway on; the fire is what the line
// surrounds and does not move. A share `false_share` of their readings is wrong.
class Weaving {
 public:
  Weaving(geo::Ring corners, std::uint64_t seed, double false_share = 0)
      : ring_(std::move(corners)),
        length_(geo::length(ring_)),
        random_(seed, 1, Purpose::kEnsemble),
        false_share_(false_share) {}

  void fly(PerimeterEstimator& estimator, int from, int to) {
    for (int second = from; second < to; ++second)
      for (std::uint32_t id = 0; id < 2; ++id) read(estimator, second, id);
  }

 private:
  struct Last {
    Vec2 point = Vec2::Zero();
    bool inside = false;
    bool valid = false;
  };

  // Place at an arc length along the ring, `off` to its right.
  Vec2 place(double arc, double off) const {
    arc = std::fmod(arc, length_);
    for (std::size_t i = 0;; i = (i + 1) % ring_.size()) {
      const Vec2 edge = ring_[(i + 1) % ring_.size()] - ring_[i];
      if (arc <= edge.norm())
        return ring_[i] + edge.normalized() * arc +
               off * geo::turned_right(edge.normalized());
      arc -= edge.norm();
    }
  }

  void read(PerimeterEstimator& estimator, int second, std::uint32_t id) {
    const Time now = Time::from_seconds(second);
    estimator.predict(now);
    const double off = 20 * std::sin(0.55 * second + 2.0 * id);
    const Vec2 here = place(15.0 * second + 0.5 * id * length_, off);
    bool inside = geo::contains(ring_, here);
    if (random_.uniform() < false_share_) inside = !inside;
    Last& last = last_[id];
    if (last.valid && last.inside != inside)
      estimator.observe(
          Crossing{now, {id}, (here + last.point) / 2, here - last.point, 1, inside});
    else
      estimator.observe(FireReading{now, {id}, here, 1, inside});
    last = {here, inside, true};
  }

  geo::Ring ring_;
  double length_;
  RandomStream random_;
  double false_share_;
  Last last_[2];
};

// A round fire with harmonics of random phases that do not decay.
inline geo::Ring wavy(std::uint64_t seed, int harmonics, double amplitude) {
  RandomStream random(seed, 0, Purpose::kEnsemble);
  std::vector<double> phases;
  for (int k = 0; k < harmonics; ++k) phases.push_back(random.uniform(0, 2 * geo::kPi));
  geo::Ring ring;
  for (int i = 0; i < 360; ++i) {
    const double bearing = 2 * geo::kPi * i / 360;
    double radius = 420;
    for (int k = 0; k < harmonics; ++k)
      radius +=
          amplitude * std::cos((k + 2) * bearing + phases[static_cast<std::size_t>(k)]);
    ring.push_back(radius * geo::unit(bearing));
  }
  return ring;
}

}  // namespace skein::perimeter
