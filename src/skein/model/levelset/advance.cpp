// SPDX-License-Identifier: Apache-2.0
#include "skein/model/levelset/advance.h"

#include <algorithm>
#include <cmath>

#include "skein/base/check.h"

namespace skein::model {
namespace {

inline float minmod(float a, float b) {
  // Without branches: these are half of the time of a step.
  const float smaller = std::min(std::abs(a), std::abs(b));
  return a * b > 0 ? std::copysign(smaller, a) : 0.0F;
}

// Upwind differences along one axis, in units of phi per cell: squared Godunov part for
// an outward front, and the central difference.
struct AxisSlope {
  float upwind_squared;
  float central;
};

inline AxisSlope axis_slope(const float* p, std::ptrdiff_t step) {
  const float c = p[0], m = p[-step], q = p[step];
  const float bend_m = c - 2 * m + p[-2 * step];
  const float bend = q - 2 * c + m;
  const float bend_p = p[2 * step] - 2 * q + c;
  const float minus = (c - m) + 0.5F * minmod(bend_m, bend);
  const float plus = (q - c) - 0.5F * minmod(bend, bend_p);
  const float a = std::max(minus, 0.0F);
  const float b = std::min(plus, 0.0F);
  return {std::max(a * a, b * b), 0.5F * (q - m)};
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
    for (const std::size_t i : active_) largest = std::max(largest, speed_.local[i]);
    return static_cast<double>(largest) + speed_.drift.norm();
  }

  // One step of Heun's method.
  void step(float dt) {
    const std::size_t n = active_.size();
    first_.resize(n);
    before_.resize(n);
    for (std::size_t k = 0; k < n; ++k) first_[k] = dt * decrease(active_[k]);
    for (std::size_t k = 0; k < n; ++k) {
      float& value = phi_.values[active_[k]];
      before_[k] = value;
      value -= first_[k];
    }
    for (std::size_t k = 0; k < n; ++k)
      first_[k] = 0.5F * (first_[k] + dt * decrease(active_[k]));
    for (std::size_t k = 0; k < n; ++k) phi_.values[active_[k]] = before_[k] - first_[k];
  }

 private:
  void collect() {
    const Grid& grid = phi_.grid;
    for (int row = 2; row < grid.rows - 2; ++row)
      for (int column = 2; column < grid.columns - 2; ++column) {
        const std::size_t i = grid.index(row, column);
        if (std::abs(phi_.values[i]) < band_) active_.push_back(i);
      }
  }

  // R |grad phi| at one node.
  float decrease(std::size_t i) const {
    const float* p = phi_.values.data() + i;
    const AxisSlope x = axis_slope(p, phi_.grid.columns);
    const AxisSlope y = axis_slope(p, 1);
    const float slope = std::sqrt(x.upwind_squared + y.upwind_squared) * inverse_cell_;
    const float norm = std::sqrt(x.central * x.central + y.central * y.central);
    float rate = speed_.local[i];
    if (norm > 0) rate += (drift_x_ * x.central + drift_y_ * y.central) / norm;
    return std::max(rate, 0.0F) * slope;
  }

  Field& phi_;
  const FrontSpeed& speed_;
  float band_;
  float inverse_cell_ = 1, drift_x_ = 0, drift_y_ = 0;
  std::vector<std::size_t> active_;
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
