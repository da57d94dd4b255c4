// SPDX-License-Identifier: Apache-2.0
#include "skein/role/contract/checks.h"

#include <cmath>

namespace skein::contract {
namespace {

using Numbers = std::vector<double>;

void add(Numbers& all, double value) {
  all.push_back(value);
}
void add(Numbers& all, const Vec2& v) {
  all.insert(all.end(), v.begin(), v.end());
}
void add(Numbers& all, const Vec3& v) {
  all.insert(all.end(), v.begin(), v.end());
}

template <class... Values>
Numbers listed(const Values&... values) {
  Numbers all;
  (add(all, values), ...);
  return all;
}

// One function for each kind of sample.
struct NumbersOf {
  Numbers operator()(const GnssFix& s) const {
    return listed(s.p_N, s.v_N, s.position_sd, s.altitude_sd, s.velocity_sd);
  }
  Numbers operator()(const FireSample& s) const {
    return listed(s.look_ahead, s.inside ? 1.0 : 0.0);
  }
  Numbers operator()(const EdgeSample& s) const { return listed(s.offset, s.tangent); }
  Numbers operator()(const AirDataSample& s) const {
    return listed(s.airspeed, s.heading);
  }
  Numbers operator()(const ImuSample& s) const {
    return listed(s.interval, s.w_NB_B, s.f_B);
  }
  Numbers operator()(const BarometerSample& s) const { return listed(s.altitude_msl); }
  Numbers operator()(const MagnetometerSample& s) const { return listed(s.m_B); }
  Numbers operator()(const AirspeedSample& s) const { return listed(s.airspeed); }
  Numbers operator()(const RangeSample& s) const { return listed(s.beam_B, s.range); }
  Numbers operator()(const HeightSample& s) const { return listed(s.height_agl); }
  Numbers operator()(const AnemometerSample& s) const { return listed(s.v_AB_B); }
  Numbers operator()(const PowerSample& s) const {
    return listed(s.voltage, s.current, s.charge);
  }
  Numbers operator()(const FootprintSample& s) const {
    return listed(s.corners[0], s.corners[1], s.corners[2], s.corners[3]);
  }
  Numbers operator()(const DetectionSample& s) const {
    return listed(s.position, s.position_sd);
  }
  Numbers operator()(const TruthSample& s) const {
    return listed(s.p_N, s.v_N, s.w_NB_B, s.wind_N, s.q_NB.w(), s.q_NB.x(), s.q_NB.y(),
                  s.q_NB.z());
  }
  Numbers operator()(const LinkSample&) const { return {}; }
  Numbers operator()(const TrafficBroadcast& s) const {
    return listed(s.p_N, s.v_N, s.position_sd, s.altitude_sd, s.velocity_sd, s.address);
  }
  Numbers operator()(const RadarPlot& s) const {
    return listed(s.range, s.range_sd, s.bearing, s.bearing_sd, s.elevation,
                  s.elevation_sd);
  }
  Numbers operator()(const TransponderContact& s) const {
    return listed(s.range, s.range_sd, s.bearing, s.bearing_sd, s.height.value_or(0),
                  s.height_sd);
  }
  Numbers operator()(const PilotInput& s) const {
    return listed(s.roll, s.pitch, s.yaw, s.throttle);
  }
};

constexpr double kWave = 1500;  // length of the hills over 2 pi [m]
constexpr double kHeight = 40;  // [m]

}  // namespace

std::vector<double> numbers_of(const SensorSample& sample) {
  return std::visit(NumbersOf{}, sample);
}

Time time_of(const SensorSample& sample) {
  return std::visit([](const auto& each) { return each.time; }, sample);
}

bool all_finite(const std::vector<double>& numbers) {
  return std::all_of(numbers.begin(), numbers.end(),
                     [](double value) { return std::isfinite(value); });
}

bool is_finite(const VehicleState& s) {
  return s.p_N.allFinite() && s.v_N.allFinite() && s.q_NB.coeffs().allFinite() &&
         s.w_NB_B.allFinite() && std::isfinite(s.airspeed) &&
         std::isfinite(s.energy.charge) && std::isfinite(s.energy.power);
}

double RollingTerrain::elevation_msl(const Vec2& p) const {
  return kHeight * math::sin(p.x() / kWave) * math::cos(p.y() / kWave);
}

Vec2 RollingTerrain::gradient(const Vec2& p) const {
  return kHeight / kWave *
         Vec2(math::cos(p.x() / kWave) * math::cos(p.y() / kWave),
              -math::sin(p.x() / kWave) * math::sin(p.y() / kWave));
}

GrowingDisc::GrowingDisc(double radius, double rate)
    : start_(radius), rate_(rate), radius_(radius) {
  advance(Time());
}

void GrowingDisc::advance(Time time) {
  constexpr int kPoints = 90;
  radius_ = start_ + rate_ * time.seconds();
  geo::Ring ring;
  for (int k = 0; k < kPoints; ++k)
    ring.push_back(radius_ * geo::unit(2 * geo::kPi * k / kPoints));
  region_ = {ring};
}

bool GrowingDisc::inside(const Vec2& p) const {
  ++looks_;
  return p.norm() < radius_;
}

const geo::Region& GrowingDisc::region() const {
  ++looks_;
  return region_;
}

}  // namespace skein::contract
