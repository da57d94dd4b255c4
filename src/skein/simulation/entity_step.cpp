#include "skein/simulation/entity_step.h"

#include <cmath>

#include "skein/model/atmosphere/atmosphere.h"

namespace skein::simulation {
namespace {

// Above this the ground is looked for once a step of the run only [m].
constexpr double kNearGround = 20;
// Ground that rises towards an aircraft faster than this is no runway [m/s].
constexpr double kHillside = 3;

SensorView view_of(const World& world, Time now, const Vehicle& vehicle) {
  return {now, vehicle.state, vehicle.air, *world.terrain, *world.fire, world.objects};
}

// A sensor that says nothing goes on measuring: its errors wander, its clock runs, and
// when it speaks again it is about now.
void sample_one(Sensor& sensor, bool silent, const SensorView& view,
                std::vector<SensorSample>& out) {
  const auto before = static_cast<std::ptrdiff_t>(out.size());
  sensor.sample(view, out);
  if (silent) out.erase(out.begin() + before, out.end());
}

void sample_all(const std::vector<std::unique_ptr<Sensor>>& sensors, std::uint64_t silent,
                const SensorView& view, std::vector<SensorSample>& out) {
  for (std::size_t k = 0; k < sensors.size(); ++k)
    sample_one(*sensors[k], (silent >> k & 1u) != 0, view, out);
}

void sense_flight(const World& world, Time now, Vehicle& vehicle, EntityState& state) {
  state.flight_samples.clear();
  sample_all(vehicle.sensors, state.silent_sensors, view_of(world, now, vehicle),
             state.flight_samples);
  for (const SensorSample& sample : state.flight_samples)
    vehicle.autopilot->sense(sample);
}

// Adding up is enough: what is not finite stays so. (Overflow would be no flight either.)
bool finite(const VehicleState& s) {
  return std::isfinite(s.p_N.sum() + s.v_N.sum() + s.q_NB.coeffs().sum() +
                       s.w_NB_B.sum() + s.airspeed);
}

void apply(const VehicleFault& fault, Faults& faults, EntityState& state) {
  const auto bit = std::uint64_t{1} << fault.part;
  switch (fault.kind) {
    case VehicleFault::Kind::kMotor:
    case VehicleFault::Kind::kServoLoose:
      faults.dead |= static_cast<std::uint8_t>(bit);
      return;
    case VehicleFault::Kind::kServoStuck:
      faults.stuck |= static_cast<std::uint8_t>(bit);
      return;
    case VehicleFault::Kind::kSensor:
      state.silent_sensors |= bit;
      return;
    case VehicleFault::Kind::kPayload:
      state.silent_payload |= bit;
      return;
    case VehicleFault::Kind::kBattery:
      faults.battery = true;
      return;
    case VehicleFault::Kind::kLink:
      state.link_down = true;
      return;
  }
}

// How fast the ground comes up because of the way over it [m/s].
double rise_of_ground(const World& world, const VehicleState& s) {
  return geo::horizontal(s.v_N).dot(world.terrain->gradient(geo::horizontal(s.p_N)));
}

double ground_below(const World& world, const Vehicle& vehicle) {
  return world.terrain->elevation_msl(geo::horizontal(vehicle.state.p_N));
}

}  // namespace

std::vector<std::size_t> update_faults(Time now, Entity& entity, EntityState& state) {
  std::vector<std::size_t> changed;
  Vehicle& vehicle = *entity.vehicle;
  state.fault_active.resize(vehicle.faults.size(), false);
  for (std::size_t k = 0; k < vehicle.faults.size(); ++k) {
    const bool active = vehicle.faults[k].active(now);
    if (active == state.fault_active[k]) continue;
    state.fault_active[k] = active;
    changed.push_back(k);
  }
  if (changed.empty()) return changed;
  // Anew, because faults of one part may overlap.
  Faults faults;
  state.silent_sensors = state.silent_payload = 0;
  state.link_down = false;
  for (std::size_t k = 0; k < vehicle.faults.size(); ++k)
    if (state.fault_active[k]) apply(vehicle.faults[k], faults, state);
  vehicle.state.faults = faults;
  return changed;
}

void begin(const World& world, Time now, Entity& entity, EntityState& state) {
  Vehicle* vehicle = entity.vehicle.get();
  if (!vehicle) return;
  vehicle->air.wind_N = world.wind->wind(vehicle->state.p_N, now);
  vehicle->autopilot->begin(as_estimate(vehicle->state, now), vehicle->state.on_ground);
  state.told = vehicle->autopilot->status();
  if (state.flew) {
    // What sensors have gathered since the last flight belongs to no flight.
    state.flight_samples.clear();
    constexpr auto kAll = ~std::uint64_t{0};
    sample_all(vehicle->sensors, kAll, view_of(world, now, *vehicle),
               state.flight_samples);
  } else {
    sense_flight(world, now, *vehicle, state);
  }
  state.flew = true;
}

void sense(const World& world, Time now, Entity& entity, EntityState& state) {
  Vehicle* vehicle = entity.vehicle.get();
  if (!state.active || !vehicle) return;
  state.fresh = state.samples.size();
  state.payload_ends.clear();
  for (std::size_t k = 0; k < vehicle->payload.size(); ++k) {
    sample_one(*vehicle->payload[k], (state.silent_payload >> k & 1u) != 0,
               view_of(world, now, *vehicle), state.samples);
    state.payload_ends.push_back(state.samples.size());
  }
}

void think(Time now, Entity& entity, EntityState& state) {
  if (!state.active || now.ns() % entity.agent_period.ns() != 0) return;
  AgentInput in;
  in.now = now;
  NavEstimate nav;
  if (entity.vehicle) {
    nav = entity.vehicle->autopilot->estimate();
    in.nav = &nav;
    in.autopilot = entity.vehicle->autopilot->status();
  }
  in.samples = state.samples;
  in.inbox = state.inbox;
  entity.agent->step(in, state.output);
  if (state.output.command && entity.vehicle)
    entity.vehicle->autopilot->command(*state.output.command);
  if (state.output.return_way && entity.vehicle)
    entity.vehicle->autopilot->set_return(*state.output.return_way);
  state.output.command.reset();
  state.output.return_way.reset();
  state.samples.clear();
  state.inbox.clear();
}

void fly(const World& world, Time now, Time until, Entity& entity, EntityState& state,
         const WorkingSet* next) {
  Vehicle* vehicle = entity.vehicle.get();
  if (!state.active || !vehicle) return;
  const double dt = vehicle->step.seconds();
  state.before = vehicle->state;
  // Within one step of the run no vehicle climbs so far that the density changes.
  vehicle->air.density = model::standard_air(-vehicle->state.p_N.z()).density;
  double ground = ground_below(world, *vehicle);
  const bool near_ground = -vehicle->state.p_N.z() - ground < kNearGround;
  const std::int64_t steps = (until - now).ns() / vehicle->step.ns();
  for (std::int64_t step = 0; now < until; ++step) {
    if (next) next->prefetch(step, steps);
    const Control control = vehicle->autopilot->control(now, dt);
    vehicle->air.wind_N = world.wind->wind(vehicle->state.p_N, now);
    if (vehicle->turbulence) {
      const Gust gust = vehicle->turbulence->advance(
          {now, vehicle->state, -vehicle->state.p_N.z() - ground, vehicle->air.wind_N},
          dt);
      vehicle->air.wind_N += gust.velocity_N;
      vehicle->air.rates_B = gust.rates_B;
    }
    vehicle->plant->step(vehicle->state, control, vehicle->air, dt);
    now += vehicle->step;
    if (!finite(vehicle->state)) {
      state.accident = EntityState::Accident::kNotFinite;
      return;
    }
    if (near_ground || now >= until) ground = ground_below(world, *vehicle);
    if (-vehicle->state.p_N.z() < ground &&
        (rise_of_ground(world, vehicle->state) > kHillside ||
         vehicle->plant->touch(vehicle->state, ground, dt) == Contact::kCrash)) {
      state.accident = EntityState::Accident::kGround;
      return;
    }
    sense_flight(world, now, *vehicle, state);
  }
  state.status = vehicle->autopilot->status();  // as long as it is at hand
}

}  // namespace skein::simulation
