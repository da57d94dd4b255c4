// SPDX-License-Identifier: Apache-2.0
// One simulated aircraft as a MAVLink vehicle of its own.
#include <fmt/format.h>
#include <unistd.h>

#include "app/common/commands.h"
#include "app/common/common.h"
#include "app/common/output.h"
#include "app/common/run_order.h"
#include "skein/assemble/aircraft/aircraft_file.h"
#include "skein/scenario/scenario_file.h"

namespace skein::app {
namespace {

constexpr const char* kPoint = "point";  // an aircraft that is a point in the air
constexpr double kDay = 86400;           // a run without an end takes this long [s]

// The plant, autopilot and sensors of an aircraft, as a scenario has them.
Result<std::string> parts_of(const VehicleArguments& arguments) {
  if (arguments.aircraft == kPoint)
    return std::string("plant: kinematic, autopilot: path, sensors: [gnss, air-data]");
  const auto file = assemble::load_aircraft(arguments.aircraft, {});
  if (!file) return file.error();
  const char* plant = nullptr;
  if (file.value().fixed_wing) plant = "fixed-wing";
  if (file.value().multirotor) plant = "multirotor";
  if (!plant)
    return Error{ErrorCode::kBadInput, arguments.aircraft,
                 fmt::format("has no section fixed_wing or multirotor, only {}.",
                             file.value().plants()),
                 "See skein list aircraft; \"point\" is one without a file."};
  const char* key =
      arguments.aircraft.find('.') == std::string::npos ? "aircraft" : "file";
  return fmt::format("plant: {{kind: {}, {}: '{}'}}, autopilot: skein, sensors: [{}]",
                     plant, key, arguments.aircraft,
                     arguments.true_state ? "ideal-navigation" : "flight");
}

std::string links_of(const VehicleArguments& arguments) {
  std::string endpoints;
  for (const std::string& link : arguments.links)
    endpoints += fmt::format("{}{{endpoint: '{}', signed: {}, unsigned: {}}}",
                             endpoints.empty() ? "" : ", ", link,
                             !arguments.key_file.empty(), arguments.unsigned_frames);
  return fmt::format(
      "links: {{ground_stations: [{}], autopilot: {}, first_system: {}{}}}\n", endpoints,
      arguments.autopilot, arguments.system,
      arguments.key_file.empty() ? ""
                                 : fmt::format(", key_file: '{}'", arguments.key_file));
}

Result<std::string> scenario_of(const VehicleArguments& arguments) {
  const auto parts = parts_of(arguments);
  if (!parts) return parts.error();
  const bool ground = !arguments.flying && arguments.aircraft != kPoint;
  return fmt::format(
      "name: {}\nseed: {}\nduration_s: {}\nstep_s: {}\n"
      "origin: {{latitude_deg: {}, longitude_deg: {}}}\n"
      "environment:\n"
      "  terrain: {{kind: flat, elevation_m: {}}}\n"
      "  wind: {{kind: uniform, speed_mps: {}, from_deg: {}}}\n"
      "  phenomena: []\n"
      "aircraft:\n"
      "  - {{name: {}, agent: commanded, agent_period_s: {}, altitude_agl_m: {}, {},\n"
      "     start: {{placement: list, positions_m: [[{}, {}]], heading_deg: {}, "
      "on_ground: {}}}}}\n"
      "missions: []\n"
      "record: {{rate_hz: {}}}\n{}",
      arguments.name, arguments.seed, arguments.duration > 0 ? arguments.duration : kDay,
      arguments.step, arguments.latitude_deg, arguments.longitude_deg,
      arguments.ground_msl, arguments.wind_speed, arguments.wind_from_deg, arguments.name,
      arguments.step, arguments.altitude, parts.value(), arguments.north, arguments.east,
      arguments.heading_deg, ground, 1 / arguments.step, links_of(arguments));
}

}  // namespace

int vehicle_command(const VehicleArguments& arguments, const std::atomic<bool>& stop) {
  const auto text = scenario_of(arguments);
  if (!text) return say_error(text.error());
  auto kinds = load_kinds({});
  if (!kinds) return kFailed;
  auto read =
      scenario::read_scenario_text(text.value(), "skein vehicle", {}, kinds->table());
  if (!read.ok()) {
    put_err(read.report());
    return kBadUsage;
  }
  RunOrder order{*std::move(kinds), *std::move(read.scenario), std::nullopt};
  if (!arguments.out.empty()) {
    RunArguments run;
    run.out = arguments.out;
    run.speed = "real";
    run.overwrite = arguments.overwrite;
    return run_order(order, run, stop);
  }
  return run_unrecorded(order, stop);
}

}  // namespace skein::app
