// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/world/build.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "skein/assemble/kinds/aircraft_fit.h"
#include "skein/assemble/kinds/interface_version.h"
#include "skein/assemble/kinds/kinds_of.h"
#include "skein/assemble/kinds/remote_kind.h"
#include "skein/assemble/kinds/sampling.h"
#include "skein/assemble/kinds/team_setup.h"
#include "skein/assemble/world/aircraft_builder.h"
#include "skein/assemble/world/common_ground.h"
#include "skein/assemble/world/read_command.h"
#include "skein/assemble/world/run_radio.h"
#include "skein/assemble/world/server_memory.h"
#include "skein/assemble/world/traffic.h"
#include "skein/exchange/plan/plan_reading.h"
#include "skein/geo/polygon.h"
#include "skein/layer/environment/terrain/synthetic_terrain.h"
#include "skein/layer/environment/wind/uniform_wind.h"
#include "skein/layer/reasoning/station/ground_station.h"
#include "skein/layer/reasoning/station/nearest_allocator.h"
#include "skein/link/mavlink/signing_key_file.h"
#include "skein/link/modem/modem_parts.h"
#include "skein/link/vehicle_links/vehicle_feed.h"
#include "skein/link/world_link/agent_parts.h"
#include "skein/link/world_link/entity_links.h"
#include "skein/role/moving_object.h"
#include "skein/role/radio.h"
#include "skein/role/traffic_aircraft.h"
#include "skein/role/world_memory.h"
#include "skein/scenario/named_files.h"
#include "skein/scenario/utc.h"
#include "skein/scenario/zones.h"
#include "skein/simulation/commanded_wind.h"
#include "skein/simulation/simulated_vehicle.h"
#include "skein/solve/path/aa_star.h"

namespace skein::assemble {
namespace {

using scenario::AircraftGroup;
using scenario::Scenario;

// Wraps a shared terrain as the world's own: agents carry it as their map.
class SharedTerrain : public Terrain {
 public:
  explicit SharedTerrain(std::shared_ptr<const Terrain> terrain)
      : terrain_(std::move(terrain)) {}
  double elevation_msl(const Vec2& p) const override {
    return terrain_->elevation_msl(p);
  }
  Vec2 gradient(const Vec2& p) const override { return terrain_->gradient(p); }
  double highest_msl() const override { return terrain_->highest_msl(); }

 private:
  std::shared_ptr<const Terrain> terrain_;
};

// Stands for the agents of others where only one is at home.
class AbsentAgent final : public Agent {
 public:
  void step(const AgentInput&, AgentOutput&) override {}
};

std::string software() {
  return fmt::format("Skein {}", kInterfaceVersion);
}

simulation::RunOptions run_options(const Scenario& scenario,
                                   const scenario::KindTable& kinds) {
  simulation::RunOptions options;
  options.step = scenario.step;
  options.duration = scenario.duration;
  options.environment_period = truth_period(scenario, kinds);
  const double steps_per_row = 1 / (scenario.record.rate_hz * options.step.seconds());
  options.record_period = options.step * std::llround(steps_per_row);
  options.perimeter_period = scenario.record.metrics_period;
  options.radio_period =
      options.step *
      std::max<std::int64_t>(1, std::llround(scenario.record.radio_period.seconds() /
                                             options.step.seconds()));
  return options;
}

// All errors as one.
Error together(const std::vector<Error>& errors) {
  if (errors.size() == 1) return errors.front();
  Error all{errors.front().code, "", fmt::format("{} problems:", errors.size()), ""};
  for (const Error& error : errors) all.message += "\n  " + error.text();
  return all;
}

// Builds the parts of a world one after the other. What fails is replaced by something
// plain until the end, so that all errors are found at once.
class Builder {
 public:
  Builder(const Scenario& scenario, const KindRegistry& kinds, geo::LocalFrame frame,
          RecordedReports* recorded)
      : scenario_(scenario),
        kinds_(kinds),
        frame_(std::move(frame)),
        recorded_(recorded) {
    build_.links = std::make_unique<vehicle_links::VehicleLinks>(frame_);
    build_.entity_links =
        std::make_unique<world_link::EntityLinks>(software(), common_ground(scenario));
    const scenario::Environment& environment = scenario.environment;
    for (std::size_t i = 0; i < environment.zone_rings.size(); ++i)
      zones_.push_back(scenario::ring_zone(environment.zone_rings[i], i));
    for (const scenario::NoFlightZone& zone : environment.zones)
      if (zone.active) zones_.push_back(scenario::to_zone(zone));
  }

  Result<Build> build() {
    outside_code();
    build_.options = run_options(scenario_, kinds_.table());
    build_.options.commands = commands();
    build_.warnings = sampling_warnings(scenario_, kinds_.table());
    for (std::string& warning : memory_warnings(scenario_))
      build_.warnings.push_back(std::move(warning));
    for (std::string& warning : scenario::zone_warnings(scenario_.environment))
      build_.warnings.push_back(std::move(warning));
    if (std::all_of(scenario_.aircraft.begin(), scenario_.aircraft.end(),
                    [](const AircraftGroup& group) { return group.count == 0; }))
      build_.warnings.emplace_back(
          "no aircraft: nothing is flown, and nobody watches the fire. Give aircraft a "
          "group with a count above 0.");
    build_.world.zones = zones_;
    environment();
    radio_modem();
    aircraft();
    stations();
    objects();
    other_traffic();
    note(radio());
    ground_station_links();
    if (!errors_.empty()) return together(errors_);
    return std::move(build_);
  }

  // One aircraft only.
  Result<Build> build_agent(const AgentOrder& order) {
    outside_code();
    build_.options = run_options(scenario_, kinds_.table());
    // The world is told of every step.
    build_.options.record_period = build_.options.step;
    build_.mixed = true;
    if (auto joined = join_world(order); !joined) return joined.error();
    surroundings();
    only_aircraft();
    agent_radio(order);
    if (!errors_.empty()) return together(errors_);
    return std::move(build_);
  }

 private:
  // What is started with the links, and who is asked.
  void outside_code() {
    build_.commands = scenario::named_commands(scenario_, kinds_.table());
    build_.consent = kinds_.consent();
    build_.source = scenario_.source;
  }

  template <class T>
  bool note(const Result<T>& made) {
    if (!made) errors_.push_back(made.error());
    return made.ok();
  }

  void radio_modem() {
    if (!modem_of(scenario_.radio)) return;
    auto made = make_world_modem(scenario_);
    if (note(made)) build_.modem = std::move(made).value();
  }

  void agent_radio(const AgentOrder& order) {
    if (!order.modem) {
      build_.world.radio = std::make_unique<world_link::WorldRadio>(*build_.world_client);
      return;
    }
    auto made = make_agent_modem(scenario_, self_, *order.modem);
    if (!note(made)) return;
    build_.modem = std::move(made).value();
    std::vector<std::string> names;
    for (const simulation::Entity& entity : build_.world.entities)
      names.push_back(entity.name);
    build_.world.radio =
        std::make_unique<modem::AgentModemRadio>(*build_.modem, self_, std::move(names));
  }

  Result<void> join_world(const AgentOrder& order) {
    world_link::WorldClientOptions options;
    options.entity = order.entity;
    options.software = software();
    options.scenario = common_ground(scenario_);
    options.world = order.world;
    options.team = order.team;
    std::size_t entity = scenario_.stations.size();
    std::string all;
    bool found = false;
    for (const auto& group : aircraft_names(scenario_))
      for (const std::string& name : group) {
        all += (all.empty() ? "" : ", ") + name;
        found |= name == order.entity;
        if (name == order.entity)
          options.self = EntityId{static_cast<std::uint32_t>(entity)};
        ++entity;
      }
    if (!found)
      return Error{ErrorCode::kBadInput, order.entity,
                   fmt::format("is no aircraft of the scenario; it has: {}.", all), ""};
    options.entities = entity;
    self_ = options.self;
    build_.world_client = std::make_unique<world_link::WorldClient>(std::move(options));
    build_.world_feed =
        std::make_unique<world_link::WorldFeed>(*build_.world_client, self_);
    return {};
  }

  void environment() {
    EnvironmentContext context = surroundings();
    for (const scenario::Choice& chosen : scenario_.environment.phenomena) {
      auto made = kinds_.kinds().phenomenon.make(chosen, context);
      if (note(made)) build_.world.phenomena.push_back(std::move(made).value());
    }
  }

  // Terrain and wind.
  EnvironmentContext surroundings() {
    EnvironmentContext context{frame_,  scenario_.start_utc, scenario_.seed, nullptr,
                               nullptr, &build_.warnings};
    auto terrain = kinds_.kinds().terrain.make(scenario_.environment.terrain, context);
    // Far below everything where the real one is missing: nothing collides with it.
    if (note(terrain))
      map_ = std::move(terrain).value();
    else
      map_ = std::make_shared<environment::FlatTerrain>(
          environment::FlatTerrainOptions{-1e5});
    build_.world.terrain = std::make_unique<SharedTerrain>(map_);
    context.terrain = map_.get();
    auto wind = kinds_.kinds().wind.make(scenario_.environment.wind, context);
    build_.world.wind = std::make_unique<simulation::CommandedWind>(
        note(wind) ? std::move(wind).value()
                   : std::make_unique<environment::UniformWind>(
                         environment::UniformWindOptions{}));
    context.wind = build_.world.wind.get();
    return context;
  }

  // Entities are the stations, then the aircraft.
  void stations() {
    std::vector<simulation::Entity> all;
    auto wanted = missions();
    build_.map_centre = scenario_.stations.front().position;
    if (!wanted.front().empty())
      build_.map_centre =
          wanted.front().front().mission->demand().place.value_or(build_.map_centre);
    for (std::size_t k = 0; k < scenario_.stations.size(); ++k) {
      const scenario::Station& station = scenario_.stations[k];
      simulation::Entity& entity = all.emplace_back();
      entity.name = station.name;
      entity.kind = "station";
      entity.reality = entity_reality(Reality::kVirtual, Reality::kNone);
      entity.agent = ground_station(teams_[k], std::move(wanted[k]));
      entity.agent_period = station.agent_period;
      entity.active = {{Time(), scenario_.duration + Time::from_ns(1)}};
    }
    for (simulation::Entity& each : build_.world.entities) all.push_back(std::move(each));
    build_.world.entities = std::move(all);
  }

  std::unique_ptr<Agent> ground_station(const StationTeam& station,
                                        std::vector<reasoning::PlannedMission> missions) {
    const scenario::Station& described = scenario_.stations[station.id.value];
    reasoning::GroundStationOptions options;
    options.id = station.id;
    for (const TeamAircraft& each : station.team)
      options.team.push_back({each.id, each.name, each.place});
    options.position.p_N = place_of(described);
    options.heartbeat = heartbeat(scenario_, described);
    options.zones = server_options(station);
    options.name = described.name;
    if (station.desk) options.desk = station.desk();
    return std::make_unique<reasoning::GroundStation>(
        options, std::move(missions), std::make_unique<reasoning::NearestAllocator>());
  }

  // Where its antenna is.
  Vec3 place_of(const scenario::Station& station) const {
    const Vec2& at = station.position;
    return {at.x(), at.y(), -(map_->elevation_msl(at) + station.antenna_agl)};
  }

  // Of each station.
  std::vector<std::vector<reasoning::PlannedMission>> missions() {
    MissionContext context{
        scenario_.seed,
        kinds_.kinds(),
        teams_,
        zones_,
        {},
        std::make_shared<solve::AaStar>(),
        scenario_.record.metrics_period,
        [this](const std::string& file) { return exchange::read_plan(file, frame_); }};
    for (const scenario::PlacedObject& object : scenario_.environment.objects)
      context.objects.push_back(object.name);
    context.phenomena = scenario_.environment.phenomena.size();
    std::vector<std::vector<reasoning::PlannedMission>> all(teams_.size());
    std::set<std::string> names;
    for (std::size_t k = 0; k < scenario_.missions.size(); ++k) {
      auto made = kinds_.kinds().mission.make(scenario_.missions[k], context);
      if (made && !names.insert(made.value()->name).second)
        made = Error{
            ErrorCode::kBadInput, "name",
            fmt::format("another mission is called \"{}\" too.", made.value()->name),
            "Give each a name of its own."};
      if (made) {
        all[made.value()->station.value].push_back(std::move(*made.value()));
        continue;
      }
      Error error = made.error();
      error.place =
          fmt::format("missions[{}]{}{}", k, error.place.empty() ? "" : ".", error.place);
      errors_.push_back(error);
    }
    return all;
  }

  // What the scenario commands by itself.
  std::vector<CommandRecord> commands() {
    std::vector<CommandRecord> all;
    for (const scenario::NoFlightZone& zone : scenario_.environment.zones)
      for (const scenario::ZoneSwitch& change : zone.switches)
        all.push_back(
            {change.at, "scenario", ZoneChange{0, change.on, scenario::to_zone(zone)}});
    for (const scenario::PlannedCommand& planned : scenario_.commands) {
      auto command = read_command(planned.text, frame_, kinds_.table().task_forms());
      if (note(command))
        all.push_back({planned.at, "scenario", std::move(command).value()});
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const auto& a, const auto& b) { return a.time < b.time; });
    return all;
  }

  // Who says which zones are in force.
  reasoning::ZoneServerOptions server_options(const StationTeam& station) const {
    reasoning::ZoneServerOptions options;
    for (const TeamAircraft& each : station.team) options.team.push_back(each.id);
    options.known = options.drawn = zones_;
    for (const scenario::NoFlightZone& described : scenario_.environment.zones) {
      const Zone zone = scenario::to_zone(described);
      if (!described.active) options.drawn.push_back(zone);
    }
    return options;
  }

  void aircraft() {
    AircraftBuilder builder(
        scenario_, kinds_.kinds(), map_, zones_, *build_.world.wind,
        {*build_.links, *build_.entity_links, nullptr, build_.modem.get()}, recorded_);
    const auto first = static_cast<std::uint32_t>(scenario_.stations.size());
    for (std::uint32_t k = 0; k < first; ++k)
      teams_.push_back({EntityId{k},
                        scenario_.stations[k].name,
                        {},
                        team_desk(scenario_, k, place_of(scenario_.stations[k]), zones_,
                                  kinds_.kinds())});
    for (const AircraftGroup& group : scenario_.aircraft) {
      StationTeam& station = teams_[station_of(scenario_, group)];
      for (int i = 0; i < group.count; ++i) {
        const auto next = static_cast<std::uint32_t>(build_.world.entities.size());
        auto made = builder.make(group, i, EntityId{first + next}, station.id);
        if (!note(made)) break;  // the others of its group are alike
        if (!note_fit(group, i, made.value())) break;
        station.team.push_back(builder.last());
        build_.mixed |= made.value().vehicle->real_time();
        build_.world.entities.push_back(std::move(made).value());
      }
    }
    build_.world.finds_aircraft = builder.finds_aircraft();
  }

  // The aircraft of this program; others stand in the list, so that numbers are those of
  // the world, and never take part.
  void only_aircraft() {
    AircraftBuilder builder(
        scenario_, kinds_.kinds(), map_, zones_, *build_.world.wind,
        {*build_.links, *build_.entity_links, build_.world_client.get()}, nullptr);
    for (const scenario::Station& station : scenario_.stations)
      add_absent(station.name, "station");
    const auto names = aircraft_names(scenario_);
    for (std::size_t g = 0; g < names.size(); ++g) {
      const AircraftGroup& group = scenario_.aircraft[g];
      for (std::size_t i = 0; i < names[g].size(); ++i) {
        if (build_.world.entities.size() != self_.value) {
          add_absent(names[g][i], "aircraft");
          continue;
        }
        const int index = static_cast<int>(i);
        if (group.vehicle.kind == kRemoteKind)
          errors_.push_back({ErrorCode::kBadInput, names[g][i] + ": vehicle",
                             "is in another program; this is that program.",
                             "Choose simulated or mavlink."});
        const auto station = static_cast<std::uint32_t>(station_of(scenario_, group));
        auto made = builder.make(group, index, self_, EntityId{station});
        if (!note(made) || !note_fit(group, index, made.value())) return;
        build_.world.entities.push_back(std::move(made).value());
        build_.world.entities.back().active = {
            {Time(), scenario_.duration + Time::from_ns(1)}};
        build_.map_centre = builder.last().place;
      }
    }
  }

  void add_absent(const std::string& name, const char* kind) {
    simulation::Entity& entity = build_.world.entities.emplace_back();
    entity.name = name;
    entity.kind = kind;
    entity.agent = std::make_unique<AbsentAgent>();
    entity.agent_period = scenario_.step;
  }

  bool note_fit(const AircraftGroup& group, int index,
                const simulation::Entity& aircraft) {
    const std::vector<Error> found =
        incompatibilities(scenario_, kinds_, group, aircraft);
    errors_.insert(errors_.end(), found.begin(), found.end());
    if (index == 0)
      for (const std::string& warning : warnings(scenario_, group, aircraft))
        build_.warnings.push_back(warning);
    return found.empty();
  }

  void objects() {
    std::uint32_t id = 0;
    for (const scenario::PlacedObject& object : scenario_.environment.objects) {
      auto movement = kinds_.kinds().movement.make(object.movement,
                                                   {scenario_.seed, id, object.position});
      if (note(movement)) {
        simulation::WorldObject& made = build_.world.objects.emplace_back(
            GroundObject{id, object.name, object.what}, std::move(movement).value());
        if (object.physical) made.body = body_of(object, id);
      }
      ++id;
    }
    build_.world.memory = server_memory(scenario_.environment.memory, build_.world, map_);
  }

  void other_traffic() {
    auto made = make_traffic(scenario_, kinds_.kinds(), frame_, build_.world.entities,
                             build_.warnings);
    if (note(made)) build_.world.traffic = std::move(made).value();
  }

  // Where ground stations are met, and who is shown there: all that is simulated.
  void ground_station_links() {
    const scenario::Links& links = scenario_.links;
    for (const scenario::StationLink& link : links.ground_stations) {
      const auto address = transport::parse_endpoint(link.endpoint);
      if (!note(address)) continue;
      build_.links->add_station(
          {address.value(), link.is_signed, unsigned_frames(link.unsigned_frames)});
      if (!link.is_signed &&
          link.unsigned_frames == scenario::StationLink::Unsigned::kAll &&
          !transport::is_local(address.value()))
        build_.warnings.push_back(
            fmt::format("links.ground_stations: whoever reaches {} may command all "
                        "aircraft that are shown there: frames are not signed.",
                        link.endpoint));
    }
    show_aircraft(!links.ground_stations.empty());
    if (!links.key_file.empty()) {
      const auto key = mavlink::read_signing_key(links.key_file);
      if (note(key)) build_.links->set_key(key.value());
    } else if (build_.links->needs_key()) {
      errors_.push_back({ErrorCode::kBadInput, "links.key_file",
                         "is needed: a link is signed.",
                         "Give a file that only you can read."});
    }
  }

  static std::optional<mavlink::UnsignedFrames> unsigned_frames(
      scenario::StationLink::Unsigned what) {
    using What = scenario::StationLink::Unsigned;
    if (what == What::kAll) return mavlink::UnsignedFrames::kAll;
    if (what == What::kTelemetry) return mavlink::UnsignedFrames::kTelemetry;
    return std::nullopt;
  }

  // Simulated aircraft, to ground stations and to real vehicles.
  void show_aircraft(bool to_stations) {
    std::vector<vehicle_links::ShownAircraft> all;
    std::vector<std::string> traffic;
    std::size_t entity = scenario_.stations.size();
    for (const AircraftGroup& group : scenario_.aircraft)
      for (int i = 0; i < group.count && entity < build_.world.entities.size();
           ++i, ++entity) {
        const simulation::Entity& aircraft = build_.world.entities[entity];
        if (group.vehicle.kind != "simulated") continue;
        if (build_.links->needs_traffic()) traffic.push_back(aircraft.name);
        if (!to_stations) continue;
        const FlightLimits limits = parts_of(aircraft).plant->limits();
        vehicle_services::VehicleServerOptions server;
        server.system = static_cast<std::uint8_t>(scenario_.links.first_system);
        server.make = scenario_.links.autopilot == scenario::ShownAs::kPx4
                          ? vehicle_services::Make::kPx4
                          : vehicle_services::Make::kArduPilot;
        server.hovers = limits.slowest == 0;
        server.limits = limits;
        server.name = aircraft.name;
        server.software = "Skein";
        server.seed = scenario_.seed;
        server.index = static_cast<std::uint32_t>(all.size());
        if (const auto start = scenario::parse_utc(scenario_.start_utc))
          server.start_unix_us = *start * 1'000'000;
        vehicle_links::ShownAircraft shown;
        shown.name = aircraft.name;
        shown.hovers = server.hovers;
        shown.ardupilot = server.make == vehicle_services::Make::kArduPilot;
        shown.commanded = group.agent.kind == "commanded";
        shown.server = build_.links->show(std::move(server));
        all.push_back(std::move(shown));
      }
    if (to_stations || !all.empty() || !traffic.empty())
      build_.feed = std::make_unique<vehicle_links::VehicleFeed>(*build_.links,
                                                                 std::move(all), traffic);
  }

  Result<void> radio() {
    std::vector<Vec3> stations;
    for (const scenario::Station& station : scenario_.stations)
      stations.push_back(place_of(station));
    RadioContext context = radio_context(build_.world, stations);
    context.seed = scenario_.seed;
    context.modem = build_.modem.get();
    context.kinds = &kinds_.kinds();
    auto made = kinds_.kinds().radio.make(scenario_.radio, context);
    if (!made) return made.error();
    build_.world.radio = std::move(made).value();
    return {};
  }

  const Scenario& scenario_;
  const KindRegistry& kinds_;
  geo::LocalFrame frame_;
  std::vector<Zone> zones_;
  std::shared_ptr<const Terrain> map_;
  RecordedReports* recorded_;
  EntityId self_;                   // of the only aircraft
  std::vector<StationTeam> teams_;  // of each station
  Build build_;
  std::vector<Error> errors_;
};

}  // namespace

Result<void> check_phenomenon(std::size_t number, std::size_t phenomena) {
  if (number < phenomena) return {};
  return Error{ErrorCode::kBadInput, "phenomenon",
               fmt::format("environment.phenomena has no number {}: there {} {}.", number,
                           phenomena == 1 ? "is" : "are", phenomena),
               "They are counted from 0."};
}

Build::Build() = default;
Build::Build(Build&&) noexcept = default;
Build& Build::operator=(Build&&) noexcept = default;
Build::~Build() = default;

namespace {

Result<Build> build_from(const Scenario& scenario, const KindRegistry& kinds,
                         RecordedReports* recorded) {
  auto frame = geo::LocalFrame::at(scenario.origin);
  if (!frame) return frame.error();
  return Builder(scenario, kinds, std::move(frame).value(), recorded).build();
}

}  // namespace

Result<Build> build(const Scenario& scenario, const KindRegistry& kinds) {
  return build_from(scenario, kinds, nullptr);
}

Result<Build> build(const Scenario& scenario, const KindRegistry& kinds,
                    std::span<const VehicleReportRecord> recorded) {
  RecordedReports reports;
  for (const VehicleReportRecord& each : recorded)
    reports[each.id].push_back({each.time, each.report});
  return build_from(scenario, kinds, &reports);
}

Result<Build> build_agent(const Scenario& scenario, const KindRegistry& kinds,
                          const AgentOrder& order) {
  auto frame = geo::LocalFrame::at(scenario.origin);
  if (!frame) return frame.error();
  return Builder(scenario, kinds, std::move(frame).value(), nullptr).build_agent(order);
}

TerrainPatch sample_terrain(const Terrain& terrain, const Vec2& centre,
                            double half_size) {
  constexpr int kRows = 161;
  TerrainPatch patch;
  patch.rows = kRows;
  patch.spacing = 2 * half_size / (kRows - 1);
  patch.low = centre - Vec2::Constant(half_size);
  for (int r = 0; r < kRows; ++r)
    for (int c = 0; c < kRows; ++c)
      patch.heights.push_back(static_cast<float>(
          terrain.elevation_msl(patch.low + patch.spacing * Vec2(r, c))));
  return patch;
}

}  // namespace skein::assemble
