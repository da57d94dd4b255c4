// SPDX-License-Identifier: Apache-2.0
#include "app/study/mixed_delivery.h"

#include <utility>
#include <vector>

#include "app/study/mixed_network/mixed_network.h"

namespace skein::app {
namespace {

constexpr std::size_t kDeliveryBytes = 1000;    // of a message
constexpr double kDeliveryTurn = 0.1;           // between two messages [s]
constexpr double kDeliveryEnd = 1;              // for what is still on its way [s]
constexpr EntityId kOneSide{0}, kOtherSide{1};  // of the house

// 100 m apart with the house between them; the third one beside it, the ground station's
// modem too. All are in reach of each other but for the house.
mixed_network::MixedNetworkOptions around_a_house(const MixedDeliveryCase& given) {
  mixed_network::MixedNetworkOptions options;
  options.radio = given.radio;
  options.radio.propagation.section.obstacles.push_back(
      {geo::Ring{{40, -20}, {60, -20}, {60, 20}, {40, 20}}, -10, 12});
  options.places = {{0, 0, -2}, {100, 0, -2}, {50, 80, -2}};
  options.station = Vec3(50, 100, -2);
  options.real.assign(given.real.begin(), given.real.end());
  options.apart = {{kOneSide, kOtherSide}};
  options.seed = given.seed;
  return options;
}

}  // namespace

std::string name_of(const std::array<bool, kDeliveryEntities>& real) {
  std::string name;
  for (const bool each : real)
    name += std::string(name.empty() ? "" : ", ") + (each ? "real" : "simulated");
  return name;
}

Result<DeliveryMatrix> measure_mixed_delivery(const MixedDeliveryCase& given,
                                              const std::atomic<bool>& stop) {
  mixed_network::MixedNetwork network(around_a_house(given));
  if (auto started = network.start(stop); !started) return started.error();
  constexpr int entities = kDeliveryEntities;
  const int turns = given.messages * entities;
  DeliveryMatrix delivered = {};
  std::vector<mixed_network::MixedNetwork::Arrival> arrivals;
  const Time began = network.now();
  for (int turn = 0;;) {
    if (stop) return Error{ErrorCode::kInterrupted, "", "interrupted.", ""};
    const double now = (network.now() - began).seconds();
    if (turn < turns && now >= kDeliveryTurn * turn)
      network.say(EntityId{static_cast<std::uint32_t>(turn++ % entities)},
                  kDeliveryBytes);
    arrivals.clear();
    network.step(arrivals);
    for (const auto& [from, to] : arrivals)
      delivered.at(from.value).at(to.value) += 1.0 / given.messages;
    if (now > kDeliveryTurn * turns + kDeliveryEnd) return delivered;
  }
}

}  // namespace skein::app
