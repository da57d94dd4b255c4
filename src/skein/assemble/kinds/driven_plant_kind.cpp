// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/kinds/driven_plant_kind.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include "skein/assemble/kinds/program_places.h"
#include "skein/geo/local_frame.h"
#include "skein/link/physics/ardupilot_drive.h"
#include "skein/link/physics/channel_map.h"
#include "skein/link/physics/hil_drive.h"
#include "skein/link/physics/started_port.h"
#include "skein/mixed/recorded_drive.h"
#include "skein/scenario/numbers.h"
#include "skein/scenario/utc.h"

namespace skein::assemble {
namespace {

using Kind = PhysicsChoice::Kind;
using physics::ChannelMap;

constexpr Time kArduPilotStep = Time::from_ns(2'500'000);
constexpr Time kHilStep = Time::from_ns(4'000'000);

int port_of(const PhysicsChoice& choice, int index) {
  const bool ardupilot = choice.kind == Kind::kArduPilotJson;
  const int usual = ardupilot ? physics::ardupilot_port(choice.instance)
                              : physics::px4_port(choice.instance);
  return choice.port.value_or(usual) + (ardupilot ? 10 : 1) * index;
}

std::string at_error(const PhysicsChoice& choice) {
  if (choice.at.empty())
    return choice.kind == Kind::kHilSerial
               ? "is needed: the line of the autopilot, as in serial:/dev/ttyACM0:921600."
               : "";
  const auto address = transport::parse_endpoint(choice.at);
  return address ? std::string() : address.error().message;
}

std::string program_error(const PhysicsChoice& choice) {
  return choice.kind == Kind::kHilSerial && !choice.program.empty()
             ? "autopilot hardware has no program here."
             : "";
}

using Places = ProgramPlaces;

// Of the program that runs this.
std::string own_program() {
  std::error_code error;
  const auto path = std::filesystem::read_symlink("/proc/self/exe", error);
  return error ? "skein" : path.string();
}

physics::SitlHome home_of(const VehicleContext& c, const geo::LocalFrame& frame) {
  const VehicleState& start = c.parts.state;
  const Vec2 place = geo::horizontal(start.p_N);
  const geo::Geodetic at = frame.from_plane(place);
  return {at.latitude_deg, at.longitude_deg,
          start.on_ground ? -start.p_N.z() : c.aircraft.map->elevation_msl(place)};
}

Places places_of(const PhysicsChoice& choice, int system, const VehicleContext& c,
                 const physics::SitlHome& home) {
  const double heading =
      geo::degrees(geo::wrap_2pi(geo::to_euler(c.parts.state.q_NB).yaw));
  const double ground = c.aircraft.map->elevation_msl(geo::horizontal(c.parts.state.p_N));
  const Vec2 wind = geo::horizontal(c.parts.air.wind_N);
  return {{{"name", c.parts.name},
           {"index", std::to_string(c.index)},
           {"instance", std::to_string(choice.instance + c.index)},
           {"port", std::to_string(port_of(choice, c.index))},
           {"system", std::to_string(system)},
           {"home", fmt::format("{:.8f},{:.8f},{:.3f},{:.2f}", home.latitude_deg,
                                home.longitude_deg, home.alt_msl, heading)},
           {"latitude", fmt::format("{:.8f}", c.scenario.origin.latitude_deg)},
           {"longitude", fmt::format("{:.8f}", c.scenario.origin.longitude_deg)},
           {"north", fmt::format("{:.3f}", c.parts.state.p_N.x())},
           {"east", fmt::format("{:.3f}", c.parts.state.p_N.y())},
           {"heading", fmt::format("{:.2f}", heading)},
           {"altitude", fmt::format("{:.2f}", -c.parts.state.p_N.z() - ground)},
           {"wind_speed", fmt::format("{:.3f}", wind.norm())},
           {"wind_from", fmt::format("{:.2f}", geo::degrees(geo::bearing(-wind)))},
           {"skein", own_program()},
           {"seed", std::to_string(c.aircraft.seed + c.aircraft.self.value)},
           {"parameters", choice.parameters}}};
}

process::Program program_of(const PhysicsChoice& choice, const Places& places) {
  process::Program program;
  for (const std::string& each : choice.program)
    program.arguments.push_back(places.filled(each));
  for (const std::string& each : choice.environment)
    program.environment.push_back(places.filled(each));
  program.folder = places.filled(choice.folder);
  program.log = places.filled(choice.log);
  return program;
}

physics::DrivingProgram driving_program(const PhysicsChoice& choice,
                                        const Places& places) {
  if (choice.program.empty()) return {};
  return physics::DrivingProgram(
      process::KeptProgram(program_of(choice, places), choice.restart));
}

std::chrono::milliseconds whole_ms(Time time) {
  return std::chrono::milliseconds(time.ns() / 1'000'000);
}

Result<Time> step_of(const PhysicsChoice& choice, const VehicleContext& c) {
  if (c.group.flight_step) return *c.group.flight_step;
  const Time step = choice.kind == Kind::kArduPilotJson ? kArduPilotStep : kHilStep;
  if (c.scenario.step.ns() % step.ns() == 0) return step;
  return Error{
      ErrorCode::kBadInput, c.parts.name,
      fmt::format("steps of {} s, as its autopilot wants them, do not divide "
                  "step_s, {} s.",
                  scenario::seconds_text(step), scenario::seconds_text(c.scenario.step)),
      "Give flight_step_s, or another step_s."};
}

Result<ChannelMap> channels_of(const PhysicsChoice& choice, const Airframe& airframe) {
  if (!choice.outputs.empty()) return ChannelMap::of_words(choice.outputs, airframe);
  return ChannelMap::usual(choice.kind == Kind::kArduPilotJson
                               ? ChannelMap::Make::kArduPilot
                               : ChannelMap::Make::kPx4,
                           airframe);
}

Result<std::unique_ptr<AutopilotDrive>> drive_of(const PhysicsChoice& choice, int system,
                                                 const VehicleContext& c,
                                                 ChannelMap channels,
                                                 physics::DriveClock clock) {
  using Drive = std::unique_ptr<AutopilotDrive>;
  if (c.recorded) return Drive(std::make_unique<mixed::RecordedDrive>(*c.recorded));
  auto frame = geo::LocalFrame::at(c.scenario.origin);
  if (!frame) return frame.error();
  const physics::SitlHome home = home_of(c, frame.value());
  const Places places = places_of(choice, system, c, home);
  const physics::Patience patience{whole_ms(choice.contact), whole_ms(choice.patience)};
  const int port = port_of(choice, c.index);
  if (port > 65'535)
    return Error{ErrorCode::kBadInput, "vehicle.physics.port",
                 fmt::format("{} would be at port {}.", c.parts.name, port), ""};
  if (choice.kind == Kind::kArduPilotJson) {
    physics::ArduPilotDriveOptions options{c.parts.name, static_cast<std::uint16_t>(port),
                                           home, patience};
    return Drive(std::make_unique<physics::ArduPilotDrive>(
        std::move(options), frame.value(), std::move(channels),
        driving_program(choice, places), std::move(clock)));
  }
  physics::HilDriveOptions options;
  options.name = c.parts.name;
  options.patience = patience;
  options.link.lock_step = choice.kind == Kind::kPx4Hil;
  const auto at = transport::parse_endpoint(
      choice.at.empty() ? fmt::format("tcpin:{}", port) : places.filled(choice.at));
  if (!at) return at.error();
  options.link.at = at.value();
  const std::int64_t start_s = scenario::parse_utc(c.scenario.start_utc).value_or(0);
  physics::HilSensing sensing(
      frame.value(),
      RandomStream(c.aircraft.seed, c.aircraft.self.value, Purpose::kOutsideSensors),
      start_s * 1'000'000, choice.declination);
  return Drive(std::make_unique<physics::HilDrive>(
      std::move(options), std::move(sensing), std::move(channels),
      driving_program(choice, places), std::move(clock)));
}

bool of_flight_sensor(const VehicleFault& fault) {
  return fault.kind == VehicleFault::Kind::kSensor;
}

}  // namespace

scenario::Fields<PhysicsChoice> physics_fields() {
  using T = PhysicsChoice;
  return scenario::Fields<T>()
      .word("kind", &T::kind, "Who moves its plant.",
            {{"none", Kind::kNone, "nobody here: it is elsewhere"},
             {"ardupilot-json", Kind::kArduPilotJson,
              "the plant is here and moves as ArduPilot's SITL (--model JSON) says, in "
              "lock-step"},
             {"px4-hil", Kind::kPx4Hil,
              "the same with PX4's SITL, which connects by TCP, in lock-step"},
             {"hil-serial", Kind::kHilSerial,
              "the same with autopilot hardware, by HIL messages, in real time"}})
      .integer("instance", &T::instance,
               "Number of the first aircraft's autopilot; the others of the group "
               "follow.",
               {.at_least = 0, .at_most = 999})
      .integer("port", &T::port,
               "Where the first aircraft's autopilot looks for its physics; the others "
               "10 (ArduPilot) or 1 (PX4) further. null: 9002 + 10 instance, 4560 + "
               "instance.",
               {.at_least = 1, .at_most = 65'535})
      .text("at", &T::at,
            "HIL: the endpoint instead of the port, as in serial:/dev/ttyACM0:921600; "
            "see docs/links.md.")
      .program(
          "program", &T::program,
          "The autopilot's program and its arguments, which is started with the run; "
          "without any it is started by somebody else. In braces: {name}, {index}, "
          "{instance}, {port}, {system}, {home} (latitude, longitude, altitude, "
          "heading), {latitude}, {longitude} (of the origin), {north}, {east}, "
          "{heading}, {altitude} (where it begins; above ground), {wind_speed}, "
          "{wind_from} (the wind there), {seed}, {parameters}, {skein} (this program); "
          "with kind none {link}: where it finds the vehicle's endpoint.")
      .text("environment", &T::environment,
            "NAME=value: more variables of the program; braces as there.")
      .file("parameters", &T::parameters,
            "A file for the program, as {parameters}; \"\": none.",
            {.may_be_empty = true})
      .text("folder", &T::folder, "Where the program works; made when missing.")
      .text("log", &T::log, "Gets what the program says.")
      .boolean("restart", &T::restart, "The program is started again when it ends.")
      .text(
          "outputs", &T::outputs,
          "What each output of the autopilot moves, from the first: aileron, elevator, "
          "rudder, throttle, brake, rotor-0, rotor-1..., none; a \"-\" before a surface "
          "turns it round. []: as its make has it.")
      .duration_s("contact_s", &T::contact, "How long it is waited for at first.",
                  {.at_least = 0.1, .at_most = 600})
      .duration_s("patience_s", &T::patience,
                  "How long each step waits for it; then it counts as silent.",
                  {.at_least = 0.01, .at_most = 60})
      .angle_deg("declination_deg", &T::declination,
                 "HIL: between true and magnetic north, east positive; null: that of a "
                 "dipole, which may be wrong by 20.",
                 {.at_least = -180, .at_most = 180})
      .rule("at", at_error)
      .rule("program", program_error);
}

std::unique_ptr<VehiclePort> started_port(std::unique_ptr<VehiclePort> port,
                                          const PhysicsChoice& choice, int system,
                                          std::function<std::string()> link,
                                          const VehicleContext& c) {
  const auto frame = geo::LocalFrame::at(c.scenario.origin);
  if (choice.program.empty() || !frame) return port;
  const Places places = places_of(choice, system, c, home_of(c, frame.value()));
  return std::make_unique<physics::StartedPort>(
      std::move(port), program_of(choice, places), choice.restart, std::move(link));
}

Result<DrivenBody> driven_body(const PhysicsChoice& choice, int system,
                               const VehicleContext& c) {
  auto channels = channels_of(choice, c.aircraft.airframe);
  if (!channels) return channels.error();
  const auto step = step_of(choice, c);
  if (!step) return step.error();
  if (auto done = add_body(c); !done) return done.error();
  if (std::any_of(c.parts.faults.begin(), c.parts.faults.end(), of_flight_sensor))
    return Error{ErrorCode::kBadInput, "failures",
                 "its flight sensors are its autopilot's: they cannot fail here.", ""};
  std::erase_if(c.parts.breakable, of_flight_sensor);
  const auto clock = std::make_shared<std::atomic<std::int64_t>>(0);
  mixed::DrivenPlantParts parts;
  parts.channels = channels.value().channels();
  auto drive = drive_of(choice, system, c, std::move(channels).value(), clock);
  if (!drive) return drive.error();
  parts.name = c.parts.name;
  parts.plant = c.parts.plant;
  parts.turbulence = std::move(c.parts.turbulence);
  parts.drive = std::move(drive).value();
  parts.faults = c.parts.faults;
  parts.breakable = c.parts.breakable;
  parts.step = step.value();
  parts.state = c.parts.state;
  parts.air = c.parts.air;
  DrivenBody body;
  body.plant = std::make_unique<mixed::DrivenPlant>(std::move(parts));
  if (!body.plant->real_time()) body.clock_ns = clock;
  return body;
}

}  // namespace skein::assemble
