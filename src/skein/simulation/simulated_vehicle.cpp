#include "skein/simulation/simulated_vehicle.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "skein/base/check.h"
#include "skein/model/atmosphere/atmosphere.h"
#include "skein/simulation/world.h"

namespace skein::simulation {
namespace {

// Above this the ground is looked for once an advance() only [m].
constexpr double kNearGround = 20;
// Ground that rises towards an aircraft faster than this is no runway [m/s].
constexpr double kHillside = 3;

// Adding up is enough: what is not finite stays so. (Overflow would be no flight either.)
bool finite(const VehicleState& s) {
  return std::isfinite(s.p_N.sum() + s.v_N.sum() + s.q_NB.coeffs().sum() +
                       s.w_NB_B.sum() + s.airspeed);
}

std::string text_of(const VehicleState& s) {
  const geo::Euler a = geo::to_euler(s.q_NB);
  return fmt::format(
      "at {:.1f} m north, {:.1f} m east, {:.1f} m above sea level, {:.1f} m/s through "
      "the air, roll {:.0f}, pitch {:.0f}, heading {:.0f} deg, turning at {:.2f}, "
      "{:.2f}, {:.2f} rad/s",
      s.p_N.x(), s.p_N.y(), -s.p_N.z(), s.airspeed, geo::degrees(a.roll),
      geo::degrees(a.pitch), geo::degrees(geo::wrap_2pi(a.yaw)), s.w_NB_B.x(),
      s.w_NB_B.y(), s.w_NB_B.z());
}

// How fast the ground comes up because of the motion over it [m/s].
double rise_of_ground(const Terrain& terrain, const VehicleState& s) {
  return geo::horizontal(s.v_N).dot(terrain.gradient(geo::horizontal(s.p_N)));
}

}  // namespace

SimulatedVehicle::SimulatedVehicle(VehicleParts parts)
    : parts_(std::move(parts)), working_set_(this, sizeof *this, parts_) {}

SensorView SimulatedVehicle::view(const Surroundings& world, Time now) const {
  SensorView view{now,           parts_.state, parts_.air, world.terrain, world.phenomena,
                  world.objects, std::nullopt};
  if (region_of_interest_)
    view.gaze_N = *region_of_interest_ - parts_.autopilot->estimate().p_N;
  return view;
}

// A sensor that says nothing goes on measuring: its errors wander, its clock runs, and
// when it speaks again it is about now.
void SimulatedVehicle::sample_one(Sensor& sensor, bool silent, const SensorView& view,
                                  std::vector<SensorSample>& out) const {
  const auto before = static_cast<std::ptrdiff_t>(out.size());
  sensor.sample(view, out);
  if (silent) out.erase(out.begin() + before, out.end());
}

void SimulatedVehicle::sense(const Surroundings& world, Time now) {
  flight_samples_.clear();
  const SensorView seen = view(world, now);
  for (std::size_t k = 0; k < parts_.sensors.size(); ++k)
    sample_one(*parts_.sensors[k], (silent_sensors_ >> k & 1u) != 0, seen,
               flight_samples_);
  for (const SensorSample& sample : flight_samples_) parts_.autopilot->sense(sample);
}

void SimulatedVehicle::begin(const Surroundings& world, Time now) {
  parts_.air.wind_N = world.wind.wind(parts_.state.p_N, now);
  parts_.autopilot->begin(as_estimate(parts_.state, now), parts_.state.on_ground);
  if (std::exchange(flew_, true)) {
    // What sensors have gathered since the last flight belongs to no flight.
    flight_samples_.clear();
    for (const auto& sensor : parts_.sensors)
      sample_one(*sensor, true, view(world, now), flight_samples_);
  } else {
    sense(world, now);
  }
}

void SimulatedVehicle::begin_step(Time now) {
  if (!parts_.faults.empty()) update_faults(now);
}

void SimulatedVehicle::look(const Surroundings& world, Time now, PayloadSamples& out) {
  for (std::size_t k = 0; k < parts_.payload.size(); ++k) {
    sample_one(*parts_.payload[k], (silent_payload_ >> k & 1u) != 0, view(world, now),
               out.samples);
    out.ends.push_back(out.samples.size());
  }
}

void SimulatedVehicle::advance(const Surroundings& world, Time now, Time until,
                               const Vehicle* next) {
  const double dt = parts_.step.seconds();
  VehicleState& state = parts_.state;
  before_ = state;
  answered_ = true;
  // Within one step of the run no vehicle climbs so far that the density changes.
  parts_.air.density = model::standard_air(-state.p_N.z()).density;
  const auto ground_below = [&] {
    return world.terrain.elevation_msl(geo::horizontal(state.p_N));
  };
  double ground = ground_below();
  const bool near_ground = -state.p_N.z() - ground < kNearGround;
  const std::int64_t steps = (until - now).ns() / parts_.step.ns();
  for (std::int64_t step = 0; now < until; ++step) {
    if (next) next->prefetch(step, steps);
    move(world, now, ground, dt);
    now += parts_.step;
    if (!finite(state))
      return lose(fmt::format("the motion of {} is no longer finite; before it was {}",
                              parts_.name, text_of(before_)));
    if (near_ground || now >= until) ground = ground_below();
    if (-state.p_N.z() < ground) touch_ground(world, ground, dt);
    if (lost_) return;
    sense(world, now);
  }
}

void SimulatedVehicle::move(const Surroundings& world, Time now, double ground,
                            double dt) {
  const Control control = parts_.autopilot->control(now, dt);
  Air& air = parts_.air;
  air.wind_N = world.wind.wind(parts_.state.p_N, now);
  if (parts_.turbulence) {
    const Gust gust = parts_.turbulence->advance(
        {now, parts_.state, -parts_.state.p_N.z() - ground, air.wind_N}, dt);
    air.wind_N += gust.velocity_N;
    air.rates_B = gust.rates_B;
  }
  parts_.plant->step(parts_.state, control, air, dt);
}

void SimulatedVehicle::touch_ground(const Surroundings& world, double ground, double dt) {
  if (rise_of_ground(world.terrain, parts_.state) > kHillside ||
      parts_.plant->touch(parts_.state, ground, dt) == Contact::kCrash)
    lose(parts_.name + " hit the ground");
}

void SimulatedVehicle::lose(std::string text) {
  lost_ = true;
  events_.push_back({"accident", std::move(text)});
}

void SimulatedVehicle::command(const AutopilotCommand& command) {
  ++commands_;
  refusals_before_ = parts_.autopilot->status().refusals;
  answered_ = false;
  parts_.autopilot->command(command);
}

CommandFate SimulatedVehicle::command_fate() const {
  if (commands_ == 0) return {};
  const AutopilotStatus status = parts_.autopilot->status();
  if (status.refusals > refusals_before_)
    return {commands_, CommandFate::State::kRefused, status.refused};
  return {commands_,
          answered_ ? CommandFate::State::kAccepted : CommandFate::State::kPending,
          {}};
}

void SimulatedVehicle::take_events(std::vector<VehicleEvent>& out) {
  for (VehicleEvent& event : events_) out.push_back(std::move(event));
  events_.clear();
}

void SimulatedVehicle::apply(const VehicleFault& fault, Faults& faults) {
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
      silent_sensors_ |= bit;
      return;
    case VehicleFault::Kind::kPayload:
      silent_payload_ |= bit;
      return;
    case VehicleFault::Kind::kBattery:
      faults.battery = true;
      return;
    case VehicleFault::Kind::kLink:
      link_down_ = true;
      return;
  }
}

void SimulatedVehicle::update_faults(Time now) {
  const std::vector<VehicleFault>& faults = parts_.faults;
  fault_active_.resize(faults.size(), false);
  bool changed = false;
  for (std::size_t k = 0; k < faults.size(); ++k) {
    const bool active = faults[k].active(now);
    if (active == fault_active_[k]) continue;
    changed = true;
    fault_active_[k] = active;
    events_.push_back({active ? "failure" : "repaired",
                       active ? skein::text_of(faults[k]) : text_of_end(faults[k])});
  }
  if (!changed) return;
  // Anew, because faults of one part may overlap.
  Faults now_failed;
  silent_sensors_ = silent_payload_ = 0;
  link_down_ = false;
  for (std::size_t k = 0; k < faults.size(); ++k)
    if (fault_active_[k]) apply(faults[k], now_failed);
  parts_.state.faults = now_failed;
}

Result<void> SimulatedVehicle::set_fault(const std::string& part, bool fails, Time now) {
  const auto named = [&](const VehicleFault& fault) { return fault.name == part; };
  const auto found =
      std::find_if(parts_.breakable.begin(), parts_.breakable.end(), named);
  if (found == parts_.breakable.end()) {
    std::string all;
    for (const VehicleFault& one : parts_.breakable)
      all += (all.empty() ? "" : ", ") + one.name;
    return Error{
        ErrorCode::kBadInput, "",
        fmt::format("{} has no part \"{}\"; it has: {}.", parts_.name, part, all), ""};
  }
  for (VehicleFault& fault : parts_.faults)
    if (named(fault) && fault.active(now)) fault.until = now;
  if (!fails) return {};
  VehicleFault fault = *found;
  fault.at = now;
  fault.until = Time::from_ns(std::numeric_limits<std::int64_t>::max());
  parts_.faults.push_back(std::move(fault));
  return {};
}

const VehicleParts& parts_of(const Entity& entity) {
  const auto* simulated = dynamic_cast<const SimulatedVehicle*>(entity.vehicle.get());
  SKEIN_CHECK(simulated, entity.name);
  return simulated->parts();
}

}  // namespace skein::simulation
