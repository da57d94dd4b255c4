// SPDX-License-Identifier: Apache-2.0
#include "skein/link/vehicle_services/command.h"

#include <bit>
#include <cmath>

#include "skein/link/vehicle_services/places.h"

namespace skein::vehicle_services {
namespace {

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}
bool same_bits(const std::array<float, 4>& a, const std::array<float, 4>& b) {
  using Bits = std::array<std::uint32_t, 4>;
  return std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b);
}

}  // namespace

bool Command::is_same(const Command& other) const {
  return id == other.id && in_integers == other.in_integers && frame == other.frame &&
         same_bits(p, other.p) && same_bits(x, other.x) && same_bits(y, other.y) &&
         same_bits(z, other.z);
}

bool Command::has_place() const {
  return std::isfinite(x) && std::isfinite(y) && (x != 0 || y != 0);
}

bool Command::has_altitude() const {
  return std::isfinite(z);
}

Command command_of(const mavlink::CommandLong& m, mavlink::CoordinateFrame frame) {
  Command command;
  command.id = static_cast<mavlink::CommandId>(m.command);
  command.is_repeated = m.confirmation > 0;
  command.frame = static_cast<std::uint8_t>(frame);
  command.p = {m.param1, m.param2, m.param3, m.param4};
  command.x = static_cast<double>(m.param5);
  command.y = static_cast<double>(m.param6);
  command.z = static_cast<double>(m.param7);
  return command;
}

Command command_of(const mavlink::CommandInt& m) {
  Command command;
  command.id = static_cast<mavlink::CommandId>(m.command);
  command.in_integers = true;
  command.frame = m.frame;
  command.p = {m.param1, m.param2, m.param3, m.param4};
  command.x = coordinate(m.frame, m.x);
  command.y = coordinate(m.frame, m.y);
  command.z = static_cast<double>(m.z);
  return command;
}

}  // namespace skein::vehicle_services
