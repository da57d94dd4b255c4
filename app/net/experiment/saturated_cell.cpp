// SPDX-License-Identifier: Apache-2.0
#include "app/net/experiment/saturated_cell.h"

#include <algorithm>
#include <cmath>

#include "skein/base/check.h"
#include "skein/base/math.h"
#include "skein/layer/communication/medium/frame.h"

namespace skein::experiment {
namespace {

// The contention window doubles from `least` slots so often.
struct Window {
  double least;
  int doublings;
};

Window window_of(const communication::MacProfile& mac) {
  const double least = mac.cw_min + 1.0;
  return {least, static_cast<int>(std::lround(math::log2((mac.cw_max + 1.0) / least)))};
}

double transmission_probability(double p, const Window& window,
                                std::optional<std::uint32_t> transmissions) {
  const auto [w, m] = window;
  if (!transmissions) {
    double sum = 0;
    for (int i = 0; i < m; ++i) sum += math::pow(2 * p, i);
    return 2 / (1 + w + p * w * sum);
  }
  double sent = 0, slots = 0;
  for (int i = 0; i < static_cast<int>(*transmissions); ++i) {
    const double share = math::pow(p, i);
    sent += share;
    slots += share * (w * math::pow(2, std::min(i, m)) + 1) / 2;
  }
  return sent / slots;
}

}  // namespace

SaturatedCell saturated_cell(std::uint32_t stations,
                             const communication::RadioProfile& radio,
                             std::uint32_t bytes,
                             std::optional<std::uint32_t> transmissions) {
  SKEIN_CHECK(stations >= 2 && transmissions.value_or(1) >= 1, stations);
  const double n = stations;
  const Window window = window_of(radio.mac);

  // The right side falls with p, the left side rises: bisection.
  double low = 0, high = 1;
  constexpr int kHalvings = 60;  // beyond the resolution of a double
  for (int i = 0; i < kHalvings; ++i) {
    const double p = (low + high) / 2;
    const double tau = transmission_probability(p, window, transmissions);
    (1 - math::pow(1 - tau, n - 1) > p ? low : high) = p;
  }
  SaturatedCell cell;
  cell.collision_probability = (low + high) / 2;
  cell.transmission_probability =
      transmission_probability(cell.collision_probability, window, transmissions);

  const communication::MacProfile& mac = radio.mac;
  const auto on_air = [&](std::uint32_t mac_bytes) {
    return radio.phy.airtime(mac_bytes).seconds();
  };
  const double sifs = mac.sifs.seconds(), difs = mac.difs.seconds();
  const double data = on_air(bytes + mac.data_overhead_bytes);
  const double ack = on_air(communication::kAckBytes),
               rts = on_air(communication::kRtsBytes),
               cts = on_air(communication::kCtsBytes);
  double success = data + sifs + ack + difs, collision = data + difs;
  if (bytes + mac.data_overhead_bytes > mac.rts_threshold_bytes) {
    success += rts + sifs + cts + sifs;
    collision = rts + difs;
  }
  const double tau = cell.transmission_probability;
  const double idle = math::pow(1 - tau, n);
  const double succeeds = n * tau * math::pow(1 - tau, n - 1);
  cell.throughput = 8.0 * bytes * succeeds /
                    (idle * mac.slot.seconds() + succeeds * success +
                     (1 - idle - succeeds) * collision);
  return cell;
}

}  // namespace skein::experiment
