// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/sensory/traffic_receiver.h"

namespace skein::sensory {
namespace {

constexpr std::size_t kUsualSenders = 16;  // senders around

bool sends(const VisibleAircraft& aircraft, Transmitter what) {
  switch (what) {
    case Transmitter::kAdsB:
      return aircraft.sends.ads_b;
    case Transmitter::kFlarm:
      return aircraft.sends.flarm;
    case Transmitter::kTransponder:
      return aircraft.sends.transponder;
  }
  return false;
}

}  // namespace

TrafficReceiver::TrafficReceiver(const TrafficReceiverOptions& options,
                                 std::uint64_t seed, EntityId entity,
                                 std::uint32_t instance)
    : options_(options),
      seed_(seed),
      self_(entity),
      clock_(options.rate_hz),
      delay_(options.latency, clock_.period(), kUsualSenders),
      random_(seed, entity.value, Purpose::kTrafficSensor, instance) {}

void TrafficReceiver::sample(const SensorView& view, std::vector<SensorSample>& out) {
  if (clock_.due(view.now)) hear(view, out);
  delay_.release(view.now, out);
}

void TrafficReceiver::hear(const SensorView& view, std::vector<SensorSample>& out) {
  const double range2 = options_.range * options_.range;
  for (const VisibleAircraft& other : view.aircraft) {
    if (other.entity == self_ || !sends(other, options_.hears) ||
        (other.p_N - view.vehicle.p_N).squaredNorm() > range2)
      continue;
    const double luck = random_.uniform();
    const auto a = random_.normals4(), b = random_.normals4();
    if (luck >= options_.reception) continue;
    TrafficBroadcast heard{view.now, other.address, options_.hears};
    heard.position_sd = position_sd(other.address);
    heard.altitude_sd = options_.altitude_sd;
    heard.velocity_sd = options_.velocity_sd;
    heard.p_N = other.p_N + Vec3(heard.position_sd * a[0], heard.position_sd * a[1],
                                 options_.altitude_sd * a[2]);
    heard.v_N = other.v_N + options_.velocity_sd * Vec3(b[0], b[1], b[2]);
    delay_.put(heard, out);
  }
}

// Of one sender always the same, whoever hears it.
double TrafficReceiver::position_sd(std::uint32_t address) const {
  constexpr std::uint32_t kSenders = 65535;  // the instance of their own streams
  RandomStream sender(seed_, address, Purpose::kTrafficSensor, kSenders);
  return sender.uniform(options_.best_position_sd, options_.worst_position_sd);
}

}  // namespace skein::sensory
