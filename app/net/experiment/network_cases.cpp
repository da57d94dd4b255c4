// SPDX-License-Identifier: Apache-2.0
#include "app/net/experiment/network_cases.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "skein/base/check.h"
#include "skein/base/random.h"

namespace skein::experiment {
namespace {

constexpr std::uint32_t kBytes = 1000, kDepth = 5;  // of saturated flows
constexpr double kLatestStart = 0.01;               // of saturated flows [s]

void add_node(NetworkCase& network, const Vec3& place) {
  network.names.push_back(static_cast<std::uint32_t>(network.nodes.size()));
  network.nodes.push_back({{{Time(), place}}, std::nullopt});
}

void add_flow(NetworkCase& network, std::uint32_t from, std::uint32_t to,
              std::uint64_t seed) {
  RandomStream random(seed, from, Purpose::kStudy);
  network.flows.push_back(
      {from, to, kBytes, kDepth, Time::from_seconds(random.uniform(0, kLatestStart))});
}

// Those of the four neighbours that are there.
std::vector<std::uint32_t> neighbours_of(std::uint32_t node, std::uint32_t nodes,
                                         std::uint32_t columns) {
  std::vector<std::uint32_t> found;
  const std::uint32_t column = node % columns;
  if (node >= columns) found.push_back(node - columns);
  if (column > 0) found.push_back(node - 1);
  if (column + 1 < columns && node + 1 < nodes) found.push_back(node + 1);
  if (node + columns < nodes) found.push_back(node + columns);
  return found;
}

}  // namespace

NetworkCase grid_network(std::uint32_t nodes, Time duration, std::uint64_t seed,
                         const GridTraffic& traffic) {
  SKEIN_CHECK(nodes >= 2, nodes);
  NetworkCase network;
  network.duration = duration;
  const auto columns =
      static_cast<std::uint32_t>(std::ceil(std::sqrt(static_cast<double>(nodes))));
  for (std::uint32_t node = 0; node < nodes; ++node) {
    const std::uint32_t row = node / columns;
    const std::uint32_t column = node % columns;
    add_node(network, Vec3(traffic.spacing * row, traffic.spacing * column, 0));
    const auto neighbours = neighbours_of(node, nodes, columns);
    const auto count = static_cast<double>(neighbours.size());
    RandomStream random(seed, node, Purpose::kStudy);
    for (std::uint64_t k = 0; static_cast<double>(k) / traffic.rate < duration.seconds();
         ++k) {
      TrafficItem item;
      item.time =
          Time::from_seconds((static_cast<double>(k) + random.uniform()) / traffic.rate);
      item.from = node;
      item.to = neighbours[static_cast<std::size_t>(random.uniform(0, count))];
      item.bytes = traffic.bytes;
      if (item.time < duration) network.traffic.push_back(item);
    }
  }
  std::stable_sort(
      network.traffic.begin(), network.traffic.end(),
      [](const TrafficItem& a, const TrafficItem& b) { return a.time < b.time; });
  for (std::size_t i = 0; i < network.traffic.size(); ++i) network.traffic[i].message = i;
  return network;
}

NetworkCase cell_network(std::uint32_t stations, Time duration, std::uint64_t seed) {
  SKEIN_CHECK(stations >= 2, stations);
  NetworkCase network;
  network.duration = duration;
  for (std::uint32_t station = 0; station < stations; ++station) {
    add_node(network, Vec3::Zero());
    add_flow(network, station, (station + 1) % stations, seed);
  }
  return network;
}

NetworkCase hidden_network(Time duration, std::uint64_t seed) {
  NetworkCase network;
  network.duration = duration;
  for (int node = 0; node < 3; ++node) add_node(network, Vec3(100.0 * node, 0, 0));
  add_flow(network, 0, 1, seed);
  add_flow(network, 2, 1, seed);
  return network;
}

}  // namespace skein::experiment
