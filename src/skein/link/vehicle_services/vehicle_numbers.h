// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

namespace skein::vehicle_services {

/// Where a simulated vehicle is found by ground stations.
struct VehicleNumbers {
  std::uint16_t port_offset = 0;  ///< to be added to the first port
  std::uint8_t system = 1;        ///< 1 to 250
  bool operator==(const VehicleNumbers&) const = default;
};

/// So many vehicles share a port: numbers above are those of ground stations.
inline constexpr std::size_t kVehiclesOfAPort = 250;

/// The numbers of the vehicle with this index: 250 on each port, then the next port.
/// @param index  below 250 * 65536.
constexpr VehicleNumbers numbers_of_vehicle(std::size_t index) {
  return {static_cast<std::uint16_t>(index / kVehiclesOfAPort),
          static_cast<std::uint8_t>(index % kVehiclesOfAPort + 1)};
}

}  // namespace skein::vehicle_services
