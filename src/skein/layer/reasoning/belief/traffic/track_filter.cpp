// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/belief/traffic/track_filter.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace skein::reasoning {
namespace {

constexpr double kUnknownSpeed = 50;  // standard deviation of each axis [m/s],
constexpr double kUnknownClimb = 5;   // up and down [m/s]
const Vec3 kDensity(1.5 * 1.5, 1.5 * 1.5, 0.7 * 0.7);  // [m^2/s^3]

Mat3 diagonal(double horizontal, double vertical) {
  return Vec3(horizontal, horizontal, vertical).asDiagonal();
}

TrafficState carried_on(const TrafficState& from, double t) {
  const Mat3 q = kDensity.asDiagonal();
  TrafficState to = from;
  to.p_N += t * from.v_N;
  to.pp += t * (from.pv + from.pv.transpose()) + t * t * from.vv + t * t * t / 3 * q;
  to.pv += t * from.vv + t * t / 2 * q;
  to.vv += t * q;
  return to;
}

void make_symmetric(Mat3& m) {
  m = (m + m.transpose().eval()) / 2;
}

// Takes in a measurement of the position.
void measure_position(TrafficState& x, const Vec3& p_N, const Mat3& r) {
  const Mat3 inverse = (x.pp + r).inverse();
  const Mat3 gain_p = x.pp * inverse, gain_v = x.pv.transpose() * inverse;
  const Vec3 innovation = p_N - x.p_N;
  x.p_N += gain_p * innovation;
  x.v_N += gain_v * innovation;
  // (I - K H) P (I - K H)' + K R K'
  const Mat3 left = Mat3::Identity() - gain_p;
  const Mat3 pp = x.pp, pv = x.pv;
  x.pp = left * pp * left.transpose() + gain_p * r * gain_p.transpose();
  x.pv = left * (pv - pp * gain_v.transpose()) + gain_p * r * gain_v.transpose();
  x.vv += gain_v * (pp + r) * gain_v.transpose() - gain_v * pv -
          pv.transpose() * gain_v.transpose();
  make_symmetric(x.pp);
  make_symmetric(x.vv);
}

TrafficState swapped(const TrafficState& x) {
  return {x.v_N, x.p_N, x.vv, x.pv.transpose(), x.pp};
}

// Of the velocity: the same, with position and velocity changed over.
void measure_velocity(TrafficState& x, const Vec3& v_N, const Mat3& r) {
  TrafficState other = swapped(x);
  measure_position(other, v_N, r);
  x = swapped(other);
}

// What a measurement says of the filter's time, if it is an older one's.
TrafficMeasurement brought_to(Time time, const TrafficState& state,
                              const TrafficMeasurement& m) {
  const double late = (time - m.time).seconds();
  if (late <= 0) return m;
  TrafficMeasurement now = m;
  now.time = time;
  now.p_N += late * state.v_N;
  now.p_covariance += late * late * state.vv;
  return now;
}

Mat3 of_velocity(const TrafficMeasurement& m) {
  return m.v_sd * m.v_sd * Mat3::Identity();
}

}  // namespace

double TrafficState::horizontal_sd() const {
  // The larger eigenvalue of two.
  const double mean = (pp(0, 0) + pp(1, 1)) / 2, half = (pp(0, 0) - pp(1, 1)) / 2;
  return std::sqrt(mean + Vec2(half, pp(0, 1)).norm());
}

double TrafficState::vertical_sd() const {
  return std::sqrt(std::max(0.0, pp(2, 2)));
}

TrackFilter::TrackFilter(const TrafficMeasurement& first) : time_(first.time) {
  state_.p_N = first.p_N;
  state_.pp = first.p_covariance;
  state_.v_N = first.v_N.value_or(Vec3::Zero());
  state_.vv =
      first.v_N ? of_velocity(first)
                : diagonal(kUnknownSpeed * kUnknownSpeed, kUnknownClimb * kUnknownClimb);
}

TrafficState TrackFilter::at(Time time) const {
  return carried_on(state_, std::max(0.0, (time - time_).seconds()));
}

double TrackFilter::distance2(const TrafficMeasurement& measurement) const {
  const TrafficMeasurement m = brought_to(time_, state_, measurement);
  const TrafficState expected = at(m.time);
  const Vec3 innovation = m.p_N - expected.p_N;
  const Mat3 covariance = expected.pp + m.p_covariance;
  return innovation.dot(covariance.inverse() * innovation);
}

void TrackFilter::update(const TrafficMeasurement& measurement) {
  const TrafficMeasurement m = brought_to(time_, state_, measurement);
  state_ = at(m.time);
  time_ = m.time;
  measure_position(state_, m.p_N, m.p_covariance);
  if (m.v_N) measure_velocity(state_, *m.v_N, of_velocity(m));
}

}  // namespace skein::reasoning
