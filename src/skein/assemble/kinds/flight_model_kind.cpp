// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/kinds/flight_model_kind.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "skein/assemble/kinds/program_places.h"
#include "skein/assemble/kinds/vehicle_context.h"
#include "skein/link/flight_model/flight_model_link.h"
#include "skein/link/flight_model/flightgear.h"
#include "skein/mixed/flight_model_vehicle.h"
#include "skein/mixed/recorded_flight_model.h"
#include "skein/role/autopilot.h"
#include "skein/role/vehicle.h"
#include "skein/scenario/numbers.h"

namespace skein::assemble {
namespace {

using transport::EndpointAddress;

constexpr double kFoot = 0.3048;           // [m]
constexpr double kKnot = 1852.0 / 3600.0;  // [m/s]
// A fixed wing is not held in its attitude by fewer steps.
constexpr Time kMaxModelStep = Time::from_ns(50'000'000);

struct FlightModelChoice {
  enum class Program { kFlightGear, kXPlane };
  Program program = Program::kFlightGear;
  std::string in = "udpin:7755";
  std::string out = "udpout:127.0.0.1:7756";
  int port_step = 10;
  Time max_age = Time::from_seconds(0.5);
  Time settling;
  bool sends_wind = true;
  std::vector<std::string> command;
  std::vector<std::string> environment;
  std::string folder = "runs/flight-models/{name}";
  std::string log = "runs/flight-models/{name}.log";
  bool restart = false;
  Time contact = Time::from_seconds(60);
};

std::string datagrams_error(const std::string& endpoint, bool waits) {
  const auto address = transport::parse_endpoint(endpoint);
  if (!address) return address.error().message;
  const bool fits = waits ? std::holds_alternative<transport::UdpServer>(address.value())
                          : std::holds_alternative<transport::UdpClient>(address.value());
  return fits ? std::string()
              : fmt::format("must be {}.", waits ? "udpin:PORT" : "udpout:HOST:PORT");
}

scenario::Fields<FlightModelChoice> flight_model_fields() {
  using T = FlightModelChoice;
  return scenario::Fields<T>()
      .word("program", &T::program, "Whose flight model it is.",
            {{"flightgear", T::Program::kFlightGear,
              "FlightGear, by its generic protocol and skein.xml"},
             {"x-plane", T::Program::kXPlane,
              "X-Plane 11 or 12, by its UDP protocol; both ways go by `out`"}})
      .text("in", &T::in,
            "Where the states of FlightGear come in, udpin:PORT; without meaning for "
            "X-Plane.")
      .text("out", &T::out,
            "Where the program takes controls: udpout:HOST:PORT. X-Plane waits at port "
            "49000.")
      .integer("port_step", &T::port_step,
               "Aircraft k of the group has ports this many times k higher.",
               {.at_least = 0, .at_most = 1000})
      .duration_s("max_age_s", &T::max_age,
                  "It counts as silent when its last state is older.",
                  {.at_least = 0.1, .at_most = 60})
      .duration_s("settling_s", &T::settling,
                  "States before this time of the program's clock are passed over: until "
                  "then its engine starts and nobody steers.",
                  {.at_least = 0, .at_most = 600})
      .boolean("sends_wind", &T::sends_wind,
               "FlightGear's air moves as the wind of the scenario; else it has its own.")
      .program(
          "command", &T::command,
          "The program and its arguments, which is started with the run; without any it "
          "is started by somebody else. In braces: {name}, {index}, {folder}, "
          "{in_port}, {out_port}, and where it begins: {latitude_deg}, "
          "{longitude_deg}, {altitude_ft}, {heading_deg}, {airspeed_kt}.")
      .text("environment", &T::environment,
            "NAME=value: more variables of the program; braces as there.")
      .text("folder", &T::folder,
            "Where the program works; made when missing. Protocol/skein.xml is written "
            "there for FlightGear.")
      .text("log", &T::log, "Gets what the program says.")
      .boolean("restart", &T::restart, "The program is started again when it ends.")
      .duration_s("contact_s", &T::contact,
                  "The run begins when the program is there, or after so long.",
                  {.at_least = 0, .at_most = 3600})
      .rule("in",
            [](const T& t) {
              return t.program == T::Program::kXPlane ? std::string()
                                                      : datagrams_error(t.in, true);
            })
      .rule("out", [](const T& t) { return datagrams_error(t.out, false); });
}

int port_in(const EndpointAddress& address) {
  if (const auto* server = std::get_if<transport::UdpServer>(&address))
    return server->at.port;
  if (const auto* client = std::get_if<transport::UdpClient>(&address))
    return client->to.port;
  return 0;
}

// An endpoint of aircraft `index`.
Result<EndpointAddress> endpoint_of(const std::string& text, int ports,
                                    const VehicleContext& c) {
  const auto first = transport::parse_endpoint(text);
  if (!first) return first.error();
  if (port_in(first.value()) + ports > 65'535)
    return Error{ErrorCode::kBadInput, "vehicle.port_step",
                 fmt::format("{} would be at port {}.", c.parts.name,
                             port_in(first.value()) + ports),
                 ""};
  return transport::moved(first.value(), ports);
}

ProgramPlaces model_places(const FlightModelChoice& choice, const VehicleContext& c,
                           const geo::LocalFrame& frame, int in_port, int out_port) {
  const VehicleState& start = c.parts.state;
  const geo::Geodetic at = frame.from_plane(geo::horizontal(start.p_N));
  const double heading = geo::wrap_2pi(geo::to_euler(start.q_NB).yaw);
  ProgramPlaces places{{{"name", c.parts.name},
                        {"index", std::to_string(c.index)},
                        {"in_port", std::to_string(in_port)},
                        {"out_port", std::to_string(out_port)},
                        {"latitude_deg", fmt::format("{:.8f}", at.latitude_deg)},
                        {"longitude_deg", fmt::format("{:.8f}", at.longitude_deg)},
                        {"altitude_ft", fmt::format("{:.1f}", -start.p_N.z() / kFoot)},
                        {"heading_deg", fmt::format("{:.2f}", geo::degrees(heading))},
                        {"airspeed_kt", fmt::format("{:.1f}", start.airspeed / kKnot)}}};
  places.values.emplace_back(
      "folder", std::filesystem::absolute(places.filled(choice.folder)).string());
  return places;
}

std::optional<process::KeptProgram> model_program(const FlightModelChoice& choice,
                                                  const ProgramPlaces& places) {
  if (choice.command.empty()) return std::nullopt;
  process::Program program;
  for (const std::string& each : choice.command)
    program.arguments.push_back(places.filled(each));
  for (const std::string& each : choice.environment)
    program.environment.push_back(places.filled(each));
  program.folder = places.filled(choice.folder);
  program.log = places.filled(choice.log);
  return process::KeptProgram(std::move(program), choice.restart);
}

Result<std::unique_ptr<FlightModel>> model_of(const FlightModelChoice& choice,
                                              const VehicleContext& c) {
  using Model = std::unique_ptr<FlightModel>;
  if (c.recorded) return Model(std::make_unique<mixed::RecordedFlightModel>(*c.recorded));
  auto frame = geo::LocalFrame::at(c.scenario.origin);
  if (!frame) return frame.error();
  const bool flightgear = choice.program == FlightModelChoice::Program::kFlightGear;
  const int ports = choice.port_step * c.index;
  flight_model::FlightModelOptions options;
  options.name = c.parts.name;
  const auto out = endpoint_of(choice.out, ports, c);
  if (!out) return out.error();
  options.out = out.value();
  if (flightgear) {
    const auto in = endpoint_of(choice.in, ports, c);
    if (!in) return in.error();
    options.in = in.value();
    options.sends_wind = choice.sends_wind;
  }
  options.settling = choice.settling.seconds();
  options.contact = std::chrono::milliseconds(choice.contact.ns() / 1'000'000);
  const ProgramPlaces places =
      model_places(choice, c, frame.value(), options.in ? port_in(*options.in) : 0,
                   port_in(options.out));
  if (flightgear)
    options.files.emplace_back(places.filled("{folder}/Protocol/skein.xml"),
                               flight_model::flightgear_protocol());
  return Model(std::make_unique<flight_model::FlightModelLink>(
      std::move(options), frame.value(),
      flightgear ? flight_model::flightgear() : flight_model::x_plane(),
      model_program(choice, places)));
}

// What can fail here: what is not the flight model's.
bool is_of_model(const VehicleFault& fault) {
  return fault.kind != VehicleFault::Kind::kSensor &&
         fault.kind != VehicleFault::Kind::kPayload &&
         fault.kind != VehicleFault::Kind::kLink;
}

Result<std::unique_ptr<Vehicle>> make_flight_model(const FlightModelChoice& choice,
                                                   const VehicleContext& c) {
  if (!std::holds_alternative<FixedWingAirframe>(c.aircraft.airframe))
    return Error{ErrorCode::kBadInput, "plant",
                 "is to be a fixed wing that takes actuators: it stands for the outside "
                 "flight model, which is flown by its controls.",
                 "Choose fixed-wing."};
  if (c.scenario.step > kMaxModelStep)
    return Error{
        ErrorCode::kBadInput, "step_s",
        fmt::format("{} s is too long: an outside flight model is steered once in "
                    "each step, which takes {} s at most.",
                    scenario::seconds_text(c.scenario.step),
                    scenario::seconds_text(kMaxModelStep)),
        "Give step_s: 0.02."};
  if (auto done = add_autopilot(c); !done) return done.error();
  if (auto done = add_body(c); !done) return done.error();
  if (std::any_of(c.parts.faults.begin(), c.parts.faults.end(), is_of_model))
    return Error{ErrorCode::kBadInput, "failures",
                 "its motor and servos are its flight model's: of its parts only sensors "
                 "and \"link\" can fail here.",
                 ""};
  std::erase_if(c.parts.breakable, is_of_model);
  auto model = model_of(choice, c);
  if (!model) return model.error();
  mixed::FlightModelVehicleParts parts;
  parts.name = c.parts.name;
  parts.model = std::move(model).value();
  parts.autopilot = std::move(c.parts.autopilot);
  parts.sensors = std::move(c.parts.sensors);
  parts.payload = std::move(c.parts.payload);
  parts.faults = std::move(c.parts.faults);
  parts.breakable = std::move(c.parts.breakable);
  parts.state = c.parts.state;
  parts.air = c.parts.air;
  parts.max_age = choice.max_age;
  return std::unique_ptr<Vehicle>(
      std::make_unique<mixed::FlightModelVehicle>(std::move(parts)));
}

}  // namespace

void add_flight_model_kind(Kinds<Vehicle, VehicleContext>& kinds) {
  kinds.add(std::string(kFlightModelKind),
            "An aircraft whose flight model is in FlightGear or X-Plane, and whose "
            "autopilot and sensors are here. Its plant says what airframe that is.",
            flight_model_fields(),
            [](const FlightModelChoice& o, const VehicleContext& c) {
              return make_flight_model(o, c);
            });
}

}  // namespace skein::assemble
