// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "skein/exchange/network/network_tables.h"

// Any bytes: no crash, an error says something, and what is accepted has its nodes in
// order and only finite places.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skein;
  if (size == 0) return 0;
  const std::string_view text(reinterpret_cast<const char*>(data + 1), size - 1);
  NetworkCase network;
  const auto check = [&](const Result<void>& read) {
    if (!read && read.error().message.empty()) std::abort();
    return read.ok();
  };
  if (data[0] % 3 == 0) {
    if (!check(exchange::read_network_nodes(text, "fuzz", network))) return 0;
  } else if (data[0] % 3 == 1) {
    if (!check(exchange::read_ns2_movement(text, "fuzz", network))) return 0;
  } else {
    constexpr const char* kNodes = "node,time_s,x_m,y_m,z_m\n1,0,0,0,0\n2,0,1,0,0\n";
    if (!exchange::read_network_nodes(kNodes, "nodes", network)) std::abort();
    check(exchange::read_network_traffic(text, "fuzz", network));
    const auto flow = exchange::parse_saturated_flow(text, network);
    if (!flow && flow.error().message.empty()) std::abort();
    for (const TrafficItem& item : network.traffic)
      if (item.from >= 2 || item.from == item.to) std::abort();
    return 0;
  }
  if (network.names.size() != network.nodes.size() || network.names.empty()) std::abort();
  for (const NodeTrack& track : network.nodes)
    for (std::size_t i = 0; i < track.points.size(); ++i) {
      if (!track.points[i].place.allFinite()) std::abort();
      if (i > 0 && track.points[i].time <= track.points[i - 1].time) std::abort();
    }
  return 0;
}
