// SPDX-License-Identifier: Apache-2.0
#include "skein/model/levelset/advance.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "skein/base/check.h"
#include "skein/model/levelset/four.h"

namespace skein::model {
namespace {

template <class V>
V minmod(V a, V b) {
  const V smaller = minimum(absolute(a), absolute(b));
  return a * b > V{} ? with_sign_of(smaller, a) : V{};
}

// Upwind differences along one axis, in units of phi per cell: squared Godunov part for
// an outward front, and the central difference.
template <class V>
struct AxisSlope {
  V upwind_squared;
  V central;
};

template <class V>
AxisSlope<V> axis_slope(const float* p, std::ptrdiff_t step) {
  const V c = load<V>(p), m = load<V>(p - step), q = load<V>(p + step);
  const V bend_m = c - 2 * m + load<V>(p - 2 * step);
  const V bend = q - 2 * c + m;
  const V bend_p = load<V>(p + 2 * step) - 2 * q + c;
  const V minus = (c - m) + 0.5F * minmod(bend_m, bend);
  const V plus = (q - c) - 0.5F * minmod(bend, bend_p);
  const V a = maximum(minus, V{});
  const V b = minimum(plus, V{});
  return {maximum(V(a * a), V(b * b)), 0.5F * (q - m)};
}

class Advancer {
 public:
  Advancer(Field& phi, const FrontSpeed& speed, double band)
      : phi_(phi), speed_(speed), band_(static_cast<float>(band)) {
    const auto inverse = static_cast<float>(1 / phi.grid.cell);
    inverse_cell_ = inverse;
    drift_x_ = static_cast<float>(speed.drift.x());
    drift_y_ = static_cast<float>(speed.drift.y());
    collect();
  }

  // The largest speed of the band [m/s].
  double largest_speed() const {
    float largest = 0;
    for (const Run& run : runs_)
      for (std::size_t k = 0; k < run.count; ++k)
        largest = std::max(largest, speed_.local[run.node + k]);
    return static_cast<double>(largest) + speed_.drift.norm();
  }

  // One step of Heun's method.
  void step(float dt) {
    first_.resize(active_);
    before_.resize(active_);
    float* phi = phi_.values.data();
    float* first = first_.data();
    float* before = before_.data();
    for_each([&]<class V>(std::size_t i, std::size_t k) {
      store<V>(first + k, dt * decrease<V>(i));
    });
    for_each([&]<class V>(std::size_t i, std::size_t k) {
      const V value = load<V>(phi + i);
      store<V>(before + k, value);
      store<V>(phi + i, value - load<V>(first + k));
    });
    for_each([&]<class V>(std::size_t i, std::size_t k) {
      store<V>(first + k, 0.5F * (load<V>(first + k) + dt * decrease<V>(i)));
    });
    for_each([&]<class V>(std::size_t i, std::size_t k) {
      store<V>(phi + i, load<V>(before + k) - load<V>(first + k));
    });
  }

 private:
  // Nodes of the band that follow each other in a row.
  struct Run {
    std::size_t node, count;
  };

  void collect() {
    const Grid& grid = phi_.grid;
    const float* phi = phi_.values.data();
    for (int row = 2; row < grid.rows - 2; ++row) {
      std::size_t count = 0;
      const auto end = [&](std::size_t node) {
        if (count > 0) runs_.push_back({node - count, count});
        active_ += std::exchange(count, 0);
      };
      const std::size_t last = grid.index(row, grid.columns - 2);
      std::size_t i = grid.index(row, 2);
      const auto look_at = [&](std::size_t until) {
        for (; i < until; ++i) {
          if (std::abs(phi[i]) < band_)
            ++count;
          else
            end(i);
        }
      };
      while (i + kLanes <= last) {
        const FourBits inside = absolute(load<Four>(phi + i)) < four_of(band_);
        if (!any(inside)) {
          end(i);
          i += kLanes;
        } else if (all(inside)) {
          count += kLanes;
          i += kLanes;
        } else {
          look_at(i + kLanes);
        }
      }
      look_at(last);
      end(last);
    }
  }

  // Calls body<V>(node, how many nodes of the band are before it): four nodes at once as
  // long as there are so many, then one.
  template <class Body>
  void for_each(Body body) const {
    std::size_t before = 0;
    for (const Run& run : runs_) {
      std::size_t k = 0;
      for (; k + kLanes <= run.count; k += kLanes)
        body.template operator()<Four>(run.node + k, before + k);
      for (; k < run.count; ++k)
        body.template operator()<float>(run.node + k, before + k);
      before += run.count;
    }
  }

  // R |grad phi| at a node.
  template <class V>
  V decrease(std::size_t i) const {
    const float* p = phi_.values.data() + i;
    const AxisSlope<V> x = axis_slope<V>(p, phi_.grid.columns);
    const AxisSlope<V> y = axis_slope<V>(p, 1);
    const V slope = root(V(x.upwind_squared + y.upwind_squared)) * inverse_cell_;
    const V norm = root(V(x.central * x.central + y.central * y.central));
    const V local = load<V>(speed_.local.data() + i);
    const V drifting = local + (drift_x_ * x.central + drift_y_ * y.central) / norm;
    return maximum(norm > V{} ? drifting : local, V{}) * slope;
  }

  Field& phi_;
  const FrontSpeed& speed_;
  float band_;
  float inverse_cell_ = 1, drift_x_ = 0, drift_y_ = 0;
  std::vector<Run> runs_;
  std::size_t active_ = 0;  // nodes in them
  std::vector<float> first_, before_;
};

}  // namespace

void advance(Field& phi, const FrontSpeed& speed, double dt, double band) {
  SKEIN_CHECK(speed.local.size() == phi.values.size() && dt >= 0, dt);
  double left = dt;
  while (left > 0) {
    Advancer advancer(phi, speed, band);
    const double largest = advancer.largest_speed();
    if (largest <= 0) return;
    const double courant = 0.5 * phi.grid.cell / largest;
    const double now = left <= courant ? left : left / std::ceil(left / courant);
    advancer.step(static_cast<float>(now));
    left -= now;
    if (left < 1e-9 * dt) return;
  }
}

}  // namespace skein::model
