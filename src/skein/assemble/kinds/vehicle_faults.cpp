// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/kinds/vehicle_faults.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>

#include "skein/base/math.h"
#include "skein/base/random.h"
#include "skein/data/vehicle/control.h"

namespace skein::assemble {
namespace {

using FailureKind = scenario::Failure::Kind;
using FaultKind = VehicleFault::Kind;

Error no_such_part(const std::string& part, const std::string& there_are) {
  return {ErrorCode::kBadInput, "",
          fmt::format("part \"{}\" does not exist; there {}.", part, there_are), ""};
}

Result<std::vector<VehicleFault>> motor(const std::string& part,
                                        const Airframe& airframe) {
  std::size_t motors = 0, first = 0;
  if (const auto* wing = std::get_if<FixedWingAirframe>(&airframe)) {
    motors = wing->motor ? 1 : 0;
    first = channel::kThrottle;
  } else if (const auto* rotors = std::get_if<MultirotorAirframe>(&airframe)) {
    motors = rotors->rotors.size();
  }
  if (motors == 0) return no_such_part(part, "is no motor that can fail on this plant");
  std::size_t channel = first;
  if (!part.empty()) {
    const auto read = std::from_chars(part.data(), part.data() + part.size(), channel);
    if (read.ec != std::errc() || read.ptr != part.data() + part.size() ||
        channel < first || channel >= first + motors)
      return no_such_part(part, fmt::format("are motors on channels {} to {}", first,
                                            first + motors - 1));
  }
  return std::vector{
      VehicleFault{FaultKind::kMotor, channel, {}, {}, fmt::format("motor {}", channel)}};
}

Result<std::vector<VehicleFault>> servo(FaultKind kind, const std::string& part,
                                        const Airframe& airframe) {
  const auto* wing = std::get_if<FixedWingAirframe>(&airframe);
  if (!wing) return no_such_part(part, "are no servos on this plant");
  if (part == "aileron")
    return std::vector{VehicleFault{kind, channel::kAileron, {}, {}, part}};
  if (part == "elevator")
    return std::vector{VehicleFault{kind, channel::kElevator, {}, {}, part}};
  if (part == "rudder" && wing->rudder)
    return std::vector{VehicleFault{kind, channel::kRudder, {}, {}, part}};
  return no_such_part(part, wing->rudder ? "are aileron, elevator and rudder"
                                         : "are aileron and elevator");
}

Result<std::vector<VehicleFault>> sensor(const std::string& part, const Parts& parts) {
  std::vector<VehicleFault> all;
  const auto collect = [&](const std::vector<std::string>& kinds, FaultKind kind) {
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      const auto here = kinds.begin() + static_cast<std::ptrdiff_t>(k);
      const auto number = 1 + std::count(kinds.begin(), here, kinds[k]);
      if (part.empty() || kinds[k] == part ||
          part == fmt::format("{}#{}", kinds[k], number))
        all.push_back({kind, k, {}, {}, "sensor " + (part.empty() ? kinds[k] : part)});
    }
  };
  collect(parts.sensors, FaultKind::kSensor);
  collect(parts.payload, FaultKind::kPayload);
  if (!all.empty()) return all;
  std::vector<std::string> kinds = parts.sensors;
  kinds.insert(kinds.end(), parts.payload.begin(), parts.payload.end());
  return no_such_part(part, fmt::format("are {}", fmt::join(kinds, ", ")));
}

// What a failure of the scenario means for this aircraft; nothing when it is the whole.
Result<std::vector<VehicleFault>> meant(FailureKind kind, const std::string& part,
                                        const Parts& parts) {
  switch (kind) {
    case FailureKind::kLost:
    case FailureKind::kLand:
      return std::vector<VehicleFault>{};
    case FailureKind::kMotor:
      return motor(part, parts.airframe);
    case FailureKind::kServoStuck:
      return servo(FaultKind::kServoStuck, part, parts.airframe);
    case FailureKind::kServoLoose:
      return servo(FaultKind::kServoLoose, part, parts.airframe);
    case FailureKind::kSensor:
      return sensor(part, parts);
    case FailureKind::kBattery:
      return std::vector{VehicleFault{FaultKind::kBattery, 0, {}, {}, part}};
    case FailureKind::kLink:
      return std::vector{VehicleFault{FaultKind::kLink, 0, {}, {}, part}};
  }
  return std::vector<VehicleFault>{};
}

}  // namespace

std::vector<VehicleFault> breakable_parts(const Parts& parts) {
  std::vector<VehicleFault> all;
  const auto add = [&](FaultKind kind, std::size_t part, std::string name) {
    all.push_back({kind, part, {}, {}, std::move(name)});
  };
  if (const auto* wing = std::get_if<FixedWingAirframe>(&parts.airframe)) {
    if (wing->motor) add(FaultKind::kMotor, channel::kThrottle, "motor");
    add(FaultKind::kServoStuck, channel::kAileron, "aileron");
    add(FaultKind::kServoStuck, channel::kElevator, "elevator");
    if (wing->rudder) add(FaultKind::kServoStuck, channel::kRudder, "rudder");
  } else if (const auto* rotors = std::get_if<MultirotorAirframe>(&parts.airframe)) {
    for (std::size_t k = 0; k < rotors->rotors.size(); ++k)
      add(FaultKind::kMotor, k, fmt::format("motor {}", k));
  }
  const auto add_sensors = [&](const std::vector<std::string>& kinds, FaultKind kind) {
    std::map<std::string, int> count;
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      // Of several sensors of a kind the first has no number.
      const int which = ++count[kinds[k]];
      add(kind, k,
          which == 1 ? "sensor " + kinds[k]
                     : fmt::format("sensor {} {}", kinds[k], which));
    }
  };
  add_sensors(parts.sensors, FaultKind::kSensor);
  add_sensors(parts.payload, FaultKind::kPayload);
  add(FaultKind::kBattery, 0, "battery");
  add(FaultKind::kLink, 0, "link");
  return all;
}

Result<std::vector<VehicleFault>> vehicle_faults(const scenario::AircraftGroup& group,
                                                 int index, const Parts& parts,
                                                 Time duration, std::uint64_t seed,
                                                 EntityId entity) {
  const Time end = duration + Time::from_ns(1);
  std::vector<VehicleFault> all;
  const auto add = [&](std::vector<VehicleFault> faults, Time at, Time until) {
    for (VehicleFault& fault : faults) {
      fault.at = at;
      fault.until = until;
      all.push_back(fault);
    }
  };
  for (std::size_t k = 0; k < group.failures.size(); ++k) {
    const scenario::Failure& failure = group.failures[k];
    if (failure.aircraft != index) continue;
    auto faults = meant(failure.kind, failure.part, parts);
    if (!faults) {
      Error error = faults.error();
      error.place = fmt::format("{}: failures[{}]", group.name, k);
      return error;
    }
    add(std::move(faults).value(), failure.at, failure.until.value_or(end));
  }
  for (std::size_t k = 0; k < group.random_failures.size(); ++k) {
    const scenario::RandomFailure& failure = group.random_failures[k];
    auto faults = meant(failure.kind, failure.part, parts);
    if (!faults) {
      Error error = faults.error();
      error.place = fmt::format("{}: random_failures[{}]", group.name, k);
      return error;
    }
    RandomStream random(seed, entity.value, Purpose::kVehicleFault,
                        static_cast<std::uint32_t>(k));
    double at = 0;
    while (true) {
      at -= failure.mean_between.seconds() * math::log(1 - random.uniform());
      if (at >= duration.seconds()) break;
      const Time from = Time::from_seconds(at);
      add(faults.value(), from, failure.length ? from + *failure.length : end);
      if (!failure.length) break;
      at += failure.length->seconds();
    }
  }
  std::stable_sort(
      all.begin(), all.end(),
      [](const VehicleFault& a, const VehicleFault& b) { return a.at < b.at; });
  return all;
}

}  // namespace skein::assemble
