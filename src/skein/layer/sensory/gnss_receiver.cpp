// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/sensory/gnss_receiver.h"

#include <cmath>
#include <numbers>

namespace skein::sensory {
namespace {

struct Source {
  double GnssReceiverOptions::*sd;
  double correlation_time;
  std::array<double, 3> left;  // by GnssKind
};

constexpr std::array<Source, 6> kSources{{
    {&GnssReceiverOptions::clock_sd, 1800, {1, 0, 0}},
    {&GnssReceiverOptions::orbit_sd, 3600, {1, 0.02, 0.001}},
    {&GnssReceiverOptions::ionosphere_sd, 1800, {1, 0.06, 0.001}},
    {&GnssReceiverOptions::troposphere_sd, 3600, {1, 0.2, 0.005}},
    {&GnssReceiverOptions::multipath_sd, 30, {1, 1, 0.01}},
    {&GnssReceiverOptions::noise_sd, 1, {1, 1, 0.01}},
}};

}  // namespace

std::array<GnssSource, 6> gnss_sources(const GnssReceiverOptions& options) {
  std::array<GnssSource, 6> sources;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const double left = kSources[i].left[static_cast<std::size_t>(options.kind)];
    sources[i] = {left * options.*kSources[i].sd, kSources[i].correlation_time};
  }
  return sources;
}

GnssReceiver::GnssReceiver(const GnssReceiverOptions& options, std::uint64_t seed,
                           EntityId entity, std::uint32_t instance)
    : PeriodicSensor(options.rate_hz, options.latency),
      normal_(RandomStream(seed, entity.value, Purpose::kGnssReceiver, instance)),
      kind_(options.kind),
      horizontal_(options.hdop / std::numbers::sqrt2),
      vertical_(options.vdop),
      velocity_sd_(options.velocity_sd),
      outages_(options.outages,
               RandomStream(seed, entity.value, Purpose::kGnssOutage, instance)),
      reacquisition_(Time::from_seconds(options.reacquisition)),
      blind_until_(Time::from_ns(-1)),
      unit_(static_cast<std::uint8_t>(instance)) {
  double variance = 0;
  for (const GnssSource& source : gnss_sources(options)) {
    if (source.sd <= 0) continue;
    sources_.emplace_back(source.sd, period(), source.correlation_time, normal_);
    variance += source.sd * source.sd;
  }
  position_sd_ = horizontal_ * std::sqrt(variance);
  altitude_sd_ = vertical_ * std::sqrt(variance);
}

bool GnssReceiver::measure(const SensorView& view, GnssFix& fix) {
  Vec3 error = Vec3::Zero();
  for (GaussMarkov3& source : sources_) {
    error += source.value();
    source.step(normal_);
  }
  const Vec3 velocity_error = velocity_sd_ * normal3(normal_);
  if (const auto end = outages_.until(view.now)) blind_until_ = *end + reacquisition_;
  if (view.now < blind_until_) return false;
  fix.p_N =
      view.vehicle.p_N + error.cwiseProduct(Vec3(horizontal_, horizontal_, vertical_));
  fix.v_N = view.vehicle.v_N + velocity_error;
  fix.position_sd = position_sd_;
  fix.altitude_sd = altitude_sd_;
  fix.velocity_sd = velocity_sd_;
  fix.kind = kind_;
  fix.unit = unit_;
  return true;
}

}  // namespace skein::sensory
