// SPDX-License-Identifier: Apache-2.0
#include "skein/link/vehicle_services/vehicle_parameters.h"

#include <cmath>
#include <string>
#include <string_view>
#include <utility>

namespace skein::vehicle_services {
namespace {

using enum ParameterType;

// What a change of a parameter does.
enum class Effect : std::uint8_t {
  kNone,
  kAirspeed,
  kLoiterRadius,
  kTakeOffHeight,
  kArmingChecks,
  kFence,
};

struct Row {
  Parameter parameter;
  Effect effect = Effect::kNone;
  double unit = 1;  // SI units in one of the parameter's
};

Row fact(std::string name, ParameterType type, double value) {
  return {{std::move(name), type, value, value, value, true}};
}

std::vector<Row> plane_rows(const VehicleServerOptions& o, const VehicleSettings& s) {
  const FlightLimits& limits = o.limits;
  return {
      {{"AIRSPEED_CRUISE", kReal32, limits.airspeed, limits.slowest, limits.fastest},
       Effect::kAirspeed},
      fact("AIRSPEED_MIN", kReal32, limits.slowest),
      fact("AIRSPEED_MAX", kReal32, limits.fastest),
      {{"WP_LOITER_RAD", kInt16, s.loiter_radius, -32'767, 32'767},
       Effect::kLoiterRadius},
      {{"TKOFF_ALT", kReal32, s.take_off_height, 1, 10'000}, Effect::kTakeOffHeight},
  };
}

std::vector<Row> copter_rows(const VehicleServerOptions& o) {
  const FlightLimits& limits = o.limits;
  constexpr double kCentimetre = 0.01;
  return {
      fact("FRAME_CLASS", kInt8, 1),
      {{"WPNAV_SPEED", kReal32, limits.airspeed / kCentimetre, 20,
        limits.fastest / kCentimetre},
       Effect::kAirspeed,
       kCentimetre},
      fact("WPNAV_SPEED_UP", kReal32, limits.climb_rate / kCentimetre),
      fact("WPNAV_SPEED_DN", kReal32, limits.sink_rate / kCentimetre),
  };
}

std::vector<Row> ardupilot_rows(const VehicleServerOptions& o, const VehicleSettings& s) {
  std::vector<Row> rows = {
      fact("SYSID_THISMAV", kInt16, o.system),
      {{"ARMING_CHECK", kInt32, 1, 0, 1}, Effect::kArmingChecks},
      {{"FENCE_ENABLE", kInt8, 0, 0, 1}, Effect::kFence},
      fact("RCMAP_ROLL", kInt8, 1),
      fact("RCMAP_PITCH", kInt8, 2),
      fact("RCMAP_THROTTLE", kInt8, 3),
      fact("RCMAP_YAW", kInt8, 4),
  };
  for (Row& row : o.hovers ? copter_rows(o) : plane_rows(o, s))
    rows.push_back(std::move(row));
  return rows;
}

std::vector<Row> px4_rows(const VehicleServerOptions& o, const VehicleSettings& s) {
  const FlightLimits& limits = o.limits;
  std::vector<Row> rows = {
      fact("MAV_SYS_ID", kInt32, o.system),
      {{"GF_ACTION", kInt32, 0, 0, 1}, Effect::kFence},
      {{"MIS_TAKEOFF_ALT", kReal32, s.take_off_height, 1, 10'000},
       Effect::kTakeOffHeight},
      fact("RC_MAP_ROLL", kInt32, 1),
      fact("RC_MAP_PITCH", kInt32, 2),
      fact("RC_MAP_THROTTLE", kInt32, 3),
      fact("RC_MAP_YAW", kInt32, 4),
  };
  if (o.hovers) {
    rows.push_back({{"MPC_XY_CRUISE", kReal32, limits.airspeed, 0.2, limits.fastest},
                    Effect::kAirspeed});
    rows.push_back(fact("MPC_XY_VEL_MAX", kReal32, limits.fastest));
    rows.push_back(fact("MPC_Z_VEL_MAX_UP", kReal32, limits.climb_rate));
    rows.push_back(fact("MPC_Z_VEL_MAX_DN", kReal32, limits.sink_rate));
  } else {
    rows.push_back(
        {{"FW_AIRSPD_TRIM", kReal32, limits.airspeed, limits.slowest, limits.fastest},
         Effect::kAirspeed});
    rows.push_back(fact("FW_AIRSPD_MIN", kReal32, limits.slowest));
    rows.push_back(fact("FW_AIRSPD_MAX", kReal32, limits.fastest));
    rows.push_back({{"NAV_LOITER_RAD", kReal32, s.loiter_radius, -32'767, 32'767},
                    Effect::kLoiterRadius});
  }
  return rows;
}

void apply(Effect effect, double value, ServedVehicle& vehicle) {
  switch (effect) {
    case Effect::kNone:
      break;
    case Effect::kAirspeed:
      if (vehicle.request(SpeedRequest{value})) vehicle.guided.airspeed = value;
      break;
    case Effect::kLoiterRadius:
      // 0 would be a circle that nobody can fly; below 0 it turns left.
      vehicle.settings.loiter_radius =
          std::abs(value) > 0 ? std::abs(value) : vehicle.options.limits.turn_radius;
      vehicle.settings.clockwise = value >= 0;
      break;
    case Effect::kTakeOffHeight:
      vehicle.settings.take_off_height = value;
      break;
    case Effect::kArmingChecks:
      vehicle.settings.arming_checks = value != 0;
      break;
    case Effect::kFence:
      vehicle.fence.enabled = value != 0;
      ++vehicle.fence.version;
      break;
  }
}

}  // namespace

const char* fence_parameter(Make make) {
  return make == Make::kPx4 ? "GF_ACTION" : "FENCE_ENABLE";
}

ParameterService make_parameters(ServedVehicle& vehicle) {
  const VehicleServerOptions& options = vehicle.options;
  VehicleSettings& settings = vehicle.settings;
  settings.loiter_radius =
      options.loiter_radius > 0 ? options.loiter_radius : options.limits.turn_radius;
  settings.take_off_height = options.take_off_height;
  const bool px4 = options.make == Make::kPx4;
  const std::vector<Row> rows =
      px4 ? px4_rows(options, settings) : ardupilot_rows(options, settings);
  std::vector<Parameter> parameters;
  std::vector<std::pair<std::string, std::pair<Effect, double>>> effects;
  for (const Row& row : rows) {
    parameters.push_back(row.parameter);
    if (row.effect != Effect::kNone)
      effects.emplace_back(row.parameter.name, std::pair(row.effect, row.unit));
  }
  parameters.insert(parameters.end(), options.parameters.begin(),
                    options.parameters.end());
  return ParameterService(
      std::move(parameters), px4 ? ParameterEncoding::kBytes : ParameterEncoding::kCast,
      [&vehicle, effects = std::move(effects)](const Parameter& changed) {
        for (const auto& [name, effect] : effects)
          if (name == changed.name)
            apply(effect.first, changed.value * effect.second, vehicle);
      });
}

}  // namespace skein::vehicle_services
