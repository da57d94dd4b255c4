// SPDX-License-Identifier: Apache-2.0
#include "skein/scenario/units.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "skein/geo/vec.h"
#include "skein/scenario/numbers.h"

namespace skein::scenario {
namespace {

constexpr double kMile = 1609.344, kNauticalMile = 1852, kFoot = 0.3048;

// Longer suffixes stand before those that they end in.
constexpr std::array kUnits = {
    Unit{"deg_per_s2", "deg/s^2", "angular acceleration", geo::kPi / 180},
    Unit{"rad_per_s2", "rad/s^2", "angular acceleration", 1},
    Unit{"ns2_per_m", "N s^2/m", "drag factor", 1},
    Unit{"kg_per_j", "kg/J", "consumption", 1},
    Unit{"kg_per_s", "kg/s", "mass flow", 1},
    Unit{"nm_per_a", "N m/A", "torque constant", 1},
    Unit{"rad_per_m", "rad/m", "turn per distance", 1},
    Unit{"per_rad", "1/rad", "derivative", 1},
    Unit{"m_s2", "m/s^2", "acceleration", 1},
    Unit{"mps2", "m/s^2", "acceleration", 1},
    Unit{"deg_per_s", "deg/s", "angular rate", geo::kPi / 180},
    Unit{"rad_per_s", "rad/s", "angular rate", 1},
    Unit{"rad_s", "rad/s", "angular rate", 1},
    Unit{"deg_s", "deg/s", "angular rate", geo::kPi / 180},
    Unit{"m_per_s", "m/s", "speed", 1},
    Unit{"per_s2", "1/s^2", "gain", 1},
    Unit{"per_s", "1/s", "gain", 1},
    Unit{"m_s", "m/s", "speed", 1},
    Unit{"mps", "m/s", "speed", 1},
    Unit{"km_h", "km/h", "speed", 1 / 3.6},
    Unit{"kmh", "km/h", "speed", 1 / 3.6},
    Unit{"kph", "km/h", "speed", 1 / 3.6},
    Unit{"knots", "kn", "speed", kNauticalMile / 3600},
    Unit{"kts", "kn", "speed", kNauticalMile / 3600},
    Unit{"kt", "kn", "speed", kNauticalMile / 3600},
    Unit{"kn", "kn", "speed", kNauticalMile / 3600},
    Unit{"mph", "mph", "speed", kMile / 3600},
    Unit{"fps", "ft/s", "speed", kFoot},
    Unit{"kgm2", "kg m^2", "inertia", 1},
    Unit{"nms2", "N m s^2", "torque factor", 1},
    Unit{"ns2", "N s^2", "thrust factor", 1},
    Unit{"m2", "m^2", "area", 1},
    Unit{"ha", "ha", "area", 1e4},
    Unit{"km2", "km^2", "area", 1e6},
    Unit{"km", "km", "length", 1000},
    Unit{"cm", "cm", "length", 0.01},
    Unit{"mm", "mm", "length", 0.001},
    Unit{"nmi", "nmi", "length", kNauticalMile},
    Unit{"mi", "mi", "length", kMile},
    Unit{"ft", "ft", "length", kFoot},
    Unit{"feet", "ft", "length", kFoot},
    Unit{"meters", "m", "length", 1},
    Unit{"metres", "m", "length", 1},
    Unit{"m", "m", "length", 1},
    Unit{"ms", "ms", "time", 1e-3},
    Unit{"us", "us", "time", 1e-6},
    Unit{"ns", "ns", "time", 1e-9},
    Unit{"seconds", "s", "time", 1},
    Unit{"sec", "s", "time", 1},
    Unit{"minutes", "min", "time", 60},
    Unit{"min", "min", "time", 60},
    Unit{"hours", "h", "time", 3600},
    Unit{"h", "h", "time", 3600},
    Unit{"s", "s", "time", 1},
    Unit{"degrees", "deg", "angle", geo::kPi / 180},
    Unit{"deg", "deg", "angle", geo::kPi / 180},
    Unit{"radians", "rad", "angle", 1},
    Unit{"rad", "rad", "angle", 1},
    Unit{"khz", "kHz", "frequency", 1e3},
    Unit{"hz", "Hz", "frequency", 1},
    Unit{"kg", "kg", "mass", 1},
    Unit{"g", "g", "mass", 1e-3},
    Unit{"bytes", "bytes", "data", 1},
    Unit{"kbps", "kbit/s", "data rate", 1e3},
    Unit{"bps", "bit/s", "data rate", 1},
    Unit{"dbm", "dBm", "level", 1},
    Unit{"db", "dB", "ratio", 1},
    Unit{"n", "N", "force", 1},
    Unit{"w", "W", "power", 1},
    Unit{"j", "J", "energy", 1},
    Unit{"v", "V", "voltage", 1},
    Unit{"a", "A", "current", 1},
    Unit{"wh", "W h", "energy", 3600},
    Unit{"ah", "A h", "electric charge", 3600},
    Unit{"ohm", "ohm", "resistance", 1},
    Unit{"percent", "%", "share", 0.01},
};

}  // namespace

std::optional<Unit> unit_of(std::string_view key) {
  for (const Unit& unit : kUnits) {
    if (!key.ends_with(unit.suffix) || key.size() < unit.suffix.size() + 2) continue;
    if (key[key.size() - unit.suffix.size() - 1] == '_') return unit;
  }
  return std::nullopt;
}

std::string_view stem_of(std::string_view key) {
  const auto unit = unit_of(key);
  return unit ? key.substr(0, key.size() - unit->suffix.size() - 1) : key;
}

std::string unit_advice(std::string_view key, std::string_view value,
                        std::span<const std::string> known) {
  for (const std::string& name : known) {
    if (name == key || stem_of(name) != stem_of(key)) continue;
    const auto given = unit_of(key), requested = unit_of(name);
    if (!requested) return fmt::format("The key is \"{}\", without a unit.", name);
    if (!given) return fmt::format("The key is \"{}\", in {}.", name, requested->symbol);
    const auto number = parse_number(value);
    if (given->quantity != requested->quantity || !number || !std::isfinite(*number)) {
      return fmt::format("The key is \"{}\", in {}, not {}.", name, requested->symbol,
                         given->symbol);
    }
    return fmt::format("The unit here is {}, not {}: write \"{}: {:.6g}\".",
                       requested->symbol, given->symbol, name,
                       *number * given->in_si / requested->in_si);
  }
  return {};
}

}  // namespace skein::scenario
