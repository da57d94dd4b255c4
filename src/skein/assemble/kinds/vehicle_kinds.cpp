// SPDX-License-Identifier: Apache-2.0
// Vehicles: one row each.

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "skein/assemble/kinds/driven_plant_kind.h"
#include "skein/assemble/kinds/flight_model_kind.h"
#include "skein/assemble/kinds/kinds_of.h"
#include "skein/assemble/kinds/remote_kind.h"
#include "skein/assemble/kinds/skein_autopilot_kind.h"
#include "skein/assemble/kinds/vehicle_context.h"
#include "skein/base/math.h"
#include "skein/data/vehicle/air.h"
#include "skein/layer/autopilot/skein/setpoint_autopilot.h"
#include "skein/link/vehicle_links/vehicle_links.h"
#include "skein/mixed/real_vehicle.h"

namespace skein::assemble {
namespace {

using scenario::Fields;
using Made = Result<std::unique_ptr<Vehicle>>;

struct NoVehicleOptions {};

// Banks reach an autopilot at the far end of a link, and take effect, this much later.
autopilot::LateralOptions far_lateral() {
  autopilot::LateralOptions options;
  options.roll_lag = 0.8;
  return options;
}

// A position that it is given in place of its satellite receiver's.
struct GpsOptions {
  std::string group;
  double rate_hz = 5;
};

// What it is sent of the virtual world.
struct FeedOptions {
  std::optional<vehicle_links::TrafficOptions> traffic = vehicle_links::TrafficOptions{};
  std::optional<mixed::ObstacleFeed> obstacles;
  bool fence = false;
  std::optional<GpsOptions> gps;
};

// A vehicle at the far end of a MAVLink connection.
struct MavlinkOptions {
  std::string endpoint = "udpin:14551";
  int port_step = 0;
  int system = 1;
  int system_step = 1;
  bool is_signed = false;
  double rate_hz = 10;
  Time silence = Time::from_seconds(3);
  Time max_age = Time::from_seconds(5);
  double max_start_distance = autopilot_client::StartArea().max_distance;
  double max_start_height_error = autopilot_client::StartArea().max_height_error;
  double bank_limit = geo::radians(45);
  autopilot::LateralOptions lateral = far_lateral();
  PhysicsChoice physics;
  FeedOptions feeds;
};

Fields<FeedOptions> feed_fields() {
  using Traffic = vehicle_links::TrafficOptions;
  using Obstacles = mixed::ObstacleFeed;
  return Fields<FeedOptions>()
      .object("traffic", &FeedOptions::traffic,
              Fields<Traffic>()
                  .number("range_m", &Traffic::range, "On the map.",
                          {.above = 0, .at_most = 500'000})
                  .number("rate_hz", &Traffic::rate, "How often, of each, at most.",
                          {.at_least = 0.1, .at_most = 20})
                  .integer("max", &Traffic::max, "So many, the nearest.",
                           {.at_least = 1, .at_most = 250}),
              "Other aircraft, real and simulated, are shown to it (ADSB_VEHICLE); null: "
              "none.")
      .object("obstacles", &FeedOptions::obstacles,
              Fields<Obstacles>()
                  .number("range_m", &Obstacles::range, "So far is looked.",
                          {.at_least = 5, .at_most = 650})
                  .number("rate_hz", &Obstacles::rate, "How often.",
                          {.at_least = 0.1, .at_most = 20})
                  .boolean("zones", &Obstacles::zones, "No-fly zones are walls."),
              "What stands around it at its altitude, from the run's terrain "
              "(OBSTACLE_DISTANCE); null: none.")
      .boolean("fence", &FeedOptions::fence,
               "The no-fly zones in force replace its exclusion fence, again whenever "
               "they change.")
      .object("gps", &FeedOptions::gps,
              Fields<GpsOptions>()
                  .text("group", &GpsOptions::group,
                        "Aircraft k is where aircraft k of this group is, which is "
                        "simulated.")
                  .number("rate_hz", &GpsOptions::rate_hz, "How often.",
                          {.at_least = 1, .at_most = 10}),
              "A position in place of its satellite receiver's (GPS_INPUT); null: none.");
}

std::string endpoint_error(const MavlinkOptions& options) {
  const auto address = transport::parse_endpoint(options.endpoint);
  return address ? std::string() : address.error().message;
}

Fields<MavlinkOptions> mavlink_fields() {
  using T = MavlinkOptions;
  return Fields<T>()
      .text("endpoint", &T::endpoint,
            "Where it is: udpin:PORT, udpout:HOST:PORT, tcp:HOST:PORT, "
            "serial:DEVICE:BAUD...; see docs/links.md.")
      .integer("port_step", &T::port_step,
               "Aircraft k of the group is at a port this many times k higher.",
               {.at_least = 0, .at_most = 1000})
      .integer("system", &T::system, "Its MAVLink system id.",
               {.at_least = 1, .at_most = 255})
      .integer("system_step", &T::system_step,
               "Aircraft k of the group has a system id this many times k higher.",
               {.at_least = 0, .at_most = 255})
      .boolean("signed", &T::is_signed,
               "Frames are signed with the key of links.key_file, others refused.")
      .number("rate_hz", &T::rate_hz, "How often it is asked to say how it moves.",
              {.at_least = 1, .at_most = 100})
      .duration_s("silence_s", &T::silence, "Its link is down when it is silent so long.",
                  {.at_least = 1, .at_most = 60})
      .duration_s("max_age_s", &T::max_age,
                  "Its sensors see nothing, and it is sent no setpoints, when its last "
                  "position is older.",
                  {.at_least = 0.5, .at_most = 60})
      .number(
          "max_start_distance_m", &T::max_start_distance,
          "It is not taken off when it, or its home, is further from its start, on the "
          "map; nor commanded in flight, for the first time, ten times as far.",
          {.above = 0, .at_most = 20'000'000})
      .number(
          "max_start_height_error_m", &T::max_start_height_error,
          "It is not taken off when it stands so much higher or lower than its start.",
          {.above = 0, .at_most = 10'000})
      .angle_deg("bank_limit_deg", &T::bank_limit,
                 "Fixed wings: the largest bank that it is sent. Plans are made for the "
                 "turn radius of its plant; what is more is for corrections.",
                 {.above = 5, .at_most = 70})
      .object("lateral", &T::lateral, lateral_fields(), "Guidance along lines.")
      .object("physics", &T::physics, physics_fields(),
              "Whether its plant is here; see docs/outside-physics.md.")
      .object("feeds", &T::feeds, feed_fields(), "What it is sent of the virtual world.")
      .rule("endpoint", endpoint_error);
}

// Where it is to be before it is commanded first: where it starts, on the ground.
autopilot_client::StartArea start_area(const MavlinkOptions& options,
                                       const VehicleContext& c) {
  autopilot_client::StartArea area;
  area.p_N = c.aircraft.initial.p_N;
  if (!c.parts.state.on_ground)
    area.p_N.z() = -c.aircraft.map->elevation_msl(geo::horizontal(area.p_N));
  area.max_distance = options.max_start_distance;
  area.max_height_error = options.max_start_height_error;
  return area;
}

int system_of(const MavlinkOptions& options, const VehicleContext& c) {
  return options.system + options.system_step * c.index;
}

Result<std::unique_ptr<VehiclePort>> mavlink_port(
    const MavlinkOptions& options, const VehicleContext& c,
    std::shared_ptr<const std::atomic<std::int64_t>> clock_ns) {
  if (c.recorded)
    return std::unique_ptr<VehiclePort>(std::make_unique<mixed::RecordedPort>(
        *c.recorded, options.physics.kind != PhysicsChoice::Kind::kNone));
  const int system = system_of(options, c);
  if (system > 255)
    return Error{ErrorCode::kBadInput, "vehicle.system",
                 fmt::format("{} would have the system id {}; the largest is 255.",
                             c.parts.name, system),
                 ""};
  vehicle_links::LinkedVehicle linked;
  linked.endpoint.address = transport::moved(
      transport::parse_endpoint(options.endpoint).value(), options.port_step * c.index);
  linked.endpoint.is_signed = options.is_signed;
  linked.client.system = static_cast<std::uint8_t>(system);
  linked.client.hovers = c.aircraft.limits.slowest == 0;
  linked.client.rate = options.rate_hz;
  linked.client.silence = options.silence;
  linked.client.start = start_area(options, c);
  linked.clock_ns = std::move(clock_ns);
  linked.name = c.parts.name;
  linked.traffic = options.feeds.traffic;
  const auto number = c.links.add(linked);
  if (!number) return number.error();
  auto port = c.links.port(number.value());
  return options.physics.kind == PhysicsChoice::Kind::kNone
             ? started_port(
                   std::move(port), options.physics, system,
                   [&links = c.links, k = number.value()] { return links.far_end(k); }, c)
             : std::move(port);
}

Result<mixed::VirtualFeedOptions> virtual_feeds(const FeedOptions& options,
                                                const VehicleContext& c) {
  mixed::VirtualFeedOptions feeds;
  feeds.obstacles = options.obstacles;
  feeds.fence = options.fence;
  feeds.zones = c.aircraft.zones;
  if (options.gps) {
    const std::string name = fmt::format("{}-{}", options.gps->group, c.index + 1);
    if (!c.simulated.contains(name))
      return Error{ErrorCode::kBadInput, "vehicle.feeds.gps.group",
                   fmt::format("{} is to be where {} is, but the scenario has no "
                               "simulated aircraft of that name.",
                               c.parts.name, name),
                   "Give a group of simulated aircraft that is as large, or leave gps "
                   "out: nobody knows where a real one truly is."};
    feeds.fix = mixed::FixFeed{[all = c.vehicles, name]() -> const Vehicle* {
                                 const auto found = all->find(name);
                                 return found == all->end() ? nullptr : found->second;
                               },
                               options.gps->rate_hz};
  }
  return feeds;
}

// What guidance may ask for: turns as tight as the bank allows, while corners are rounded
// as planners do it.
FlightLimits guided_limits(const FlightLimits& planned, double bank_limit) {
  FlightLimits limits = planned;
  const double tightest =
      planned.airspeed * planned.airspeed / (kGravity * math::tan(bank_limit));
  limits.turn_radius = std::min(planned.turn_radius, tightest);
  return limits;
}

Made make_mavlink(const MavlinkOptions& options, const VehicleContext& c) {
  auto feeds = virtual_feeds(options.feeds, c);
  if (!feeds) return feeds.error();
  DrivenBody body;
  if (options.physics.kind != PhysicsChoice::Kind::kNone) {
    auto made = driven_body(options.physics, system_of(options, c), c);
    if (!made) return made.error();
    body = std::move(made).value();
  }
  auto port = mavlink_port(options, c, body.clock_ns);
  if (!port) return port.error();
  autopilot::SkeinOptions guidance;
  guidance.wing_guidance.lateral = options.lateral;
  const FlightLimits limits = guided_limits(c.aircraft.limits, options.bank_limit);
  guidance.wing_guidance.radius_margin *=
      c.aircraft.limits.turn_radius / limits.turn_radius;
  mixed::RealVehicleParts parts;
  parts.name = c.parts.name;
  parts.port = std::move(port).value();
  parts.guidance = std::make_unique<autopilot::SetpointAutopilot>(
      autopilot::setpoint_setup(guidance, limits, c.aircraft.airframe),
      c.aircraft.initial);
  parts.payload = std::move(c.parts.payload);
  parts.limits = c.aircraft.limits;
  parts.start = c.aircraft.initial;
  parts.max_age = options.max_age;
  parts.body = std::move(body.plant);
  parts.feeds = std::move(feeds).value();
  return std::unique_ptr<Vehicle>(std::make_unique<mixed::RealVehicle>(std::move(parts)));
}

}  // namespace

bool plant_is_simulated(const scenario::Choice& vehicle) {
  return vehicle.kind == "simulated" || vehicle.kind == kFlightModelKind ||
         (vehicle.kind == "mavlink" &&
          vehicle.as<MavlinkOptions>().physics.kind != PhysicsChoice::Kind::kNone);
}

Kinds<Vehicle, VehicleContext> vehicle_kinds() {
  Kinds<Vehicle, VehicleContext> kinds("vehicle");
  kinds.add("simulated", "Plant, autopilot and sensors are models.",
            Fields<NoVehicleOptions>(),
            [](const NoVehicleOptions&, const VehicleContext& c) -> Made {
              if (auto done = add_autopilot(c); !done) return done.error();
              if (auto done = add_body(c); !done) return done.error();
              return std::unique_ptr<Vehicle>(
                  std::make_unique<simulation::SimulatedVehicle>(std::move(c.parts)));
            });
  kinds.add("mavlink",
            "An aircraft elsewhere, real or in another program, whose autopilot speaks "
            "MAVLink (ArduPilot, PX4, skein vehicle). Its plant here says what it can "
            "do; of its sensors the payload is here and looks at the virtual world. With "
            "physics the plant is here too, and only the autopilot elsewhere.",
            mavlink_fields(), [](const MavlinkOptions& o, const VehicleContext& c) {
              return make_mavlink(o, c);
            });
  add_remote_kind(kinds);
  add_flight_model_kind(kinds);
  return kinds;
}

}  // namespace skein::assemble
