// SPDX-License-Identifier: Apache-2.0
#include "app/study/mixed_rates.h"

#include <utility>
#include <vector>

#include "app/study/mixed_network/mixed_network.h"
#include "skein/base/random.h"

namespace skein::app {
namespace {

constexpr double kRatesWarmUp = 1;     // before it counts [s]: queues are still empty
constexpr double kTriangleSide = 200;  // of the triangle [m]

// When an entity speaks: at even intervals, each up to a half shorter or longer.
class Speaker {
 public:
  Speaker(std::uint64_t seed, std::uint32_t entity, double rate)
      : random_(seed, entity, Purpose::kStudy), period_(8.0 * kMixedBytes / rate) {
    next_ = period_ * random_.uniform();
  }
  bool speaks(double now) {
    if (now < next_) return false;
    next_ += period_ * random_.uniform(0.5, 1.5);
    return true;
  }

 private:
  RandomStream random_;
  double period_, next_;
};

// Entity 0 is real in any case. 100 m up, at the corners of a triangle of equal sides;
// the ground station's modem is at one of these.
mixed_network::MixedNetworkOptions triangle_of(const MixedRatesCase& given) {
  mixed_network::MixedNetworkOptions options;
  options.radio = given.radio;
  options.places = {{0, 0, -100},
                    {kTriangleSide, 0, -100},
                    {kTriangleSide / 2, kTriangleSide * 0.8660254037844386, -100}};
  const bool all = given.set_up == MixedSetUp::kAllReal;
  options.real = {true, all, all};
  options.station = options.places[1];
  if (given.set_up == MixedSetUp::kWithoutModel)
    options.simulated = mixed_network::SimulatedAir::kIdeal;
  options.seed = given.seed;
  return options;
}

}  // namespace

Result<MixedRates> measure_mixed_rates(const MixedRatesCase& given,
                                       const std::atomic<bool>& stop) {
  mixed_network::MixedNetwork network(triangle_of(given));
  if (auto started = network.start(stop); !started) return started.error();
  std::vector<Speaker> speakers;
  for (std::uint32_t k = 0; k < kMixedEntities; ++k)
    speakers.emplace_back(given.seed, k, given.rate);
  MixedRates rates;
  std::vector<mixed_network::MixedNetwork::Arrival> arrivals;
  const Time began = network.now();
  for (double now = 0; now < kRatesWarmUp + given.duration;
       now = (network.now() - began).seconds()) {
    if (stop) return Error{ErrorCode::kInterrupted, "", "interrupted.", ""};
    for (std::uint32_t k = 0; k < kMixedEntities; ++k)
      if (speakers[k].speaks(now)) network.say(EntityId{k}, kMixedBytes);
    arrivals.clear();
    network.step(arrivals);
    if (now < kRatesWarmUp) continue;
    for (const auto& [from, to] : arrivals)
      rates.received.at(from.value).at(to.value) +=
          static_cast<double>(kMixedBytes) / given.duration;
  }
  rates.station = network.station();
  return rates;
}

}  // namespace skein::app
