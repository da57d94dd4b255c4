// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/asset/fixed_wing/fixed_wing_plant.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "skein/base/check.h"
#include "skein/base/math.h"
#include "skein/layer/asset/body/bounded.h"
#include "skein/layer/asset/fixed_wing/trim.h"
#include "skein/model/atmosphere/atmosphere.h"

namespace skein::asset {
namespace {

constexpr double kLongestStep = 0.01;  // [s]
// RK4 is stable up to 2.8 and good to 3e-4 of a decay or turn of this size [-].
constexpr double kFastest = 0.5;
constexpr double kMaxParts = 1000;
// Of what the aircraft can do just so, planners and autopilots get this share.
constexpr double kReserve = 0.8;
// Where its ceiling is looked for [m].
constexpr double kLowestCeiling = 0;
constexpr double kHighestCeiling = 30000;
// A motor that shall stand and turns slower than this does [rad/s or share].
constexpr double kStands = 1e-3;

// Where a servo is after h [s], with `decay` = exp(-h / lag): at its largest rate until
// the lag asks for less.
double servo_after(const Servos& servos, double from, double to, double h, double decay) {
  const double missing = to - from;
  const double slow_zone = servos.rate * servos.lag;
  const double fast = std::abs(missing) - slow_zone;
  if (fast <= 0) return to - missing * decay;
  const double fast_time = fast / servos.rate;
  if (fast_time >= h) return from + std::copysign(servos.rate * h, missing);
  return to - std::copysign(slow_zone, missing) * math::exp((fast_time - h) / servos.lag);
}

// A value at the beginning, the middle and the end of a step.
using Course = std::array<double, 3>;

Course servo_course(const Servos& servos, double from, double to, double dt,
                    double half_decay) {
  const double middle = servo_after(servos, from, to, dt / 2, half_decay);
  return {from, middle, servo_after(servos, middle, to, dt / 2, half_decay)};
}

// The fastest of the aerodynamic dampings and frequencies at sea level, per airspeed.
double stiffness_of(const FixedWingParameters& p) {
  const double rho_S = model::kSeaLevelDensity * p.geometry.area;
  const double b = p.geometry.span, c = p.geometry.chord;
  const auto frequency = [&](double derivative, double length, double inertia) {
    return std::sqrt(rho_S * length * std::abs(derivative) / (2 * inertia));
  };
  return std::max({rho_S * b * b * std::abs(p.aero.Clp) / (4 * p.inertia.xx),
                   rho_S * c * c * std::abs(p.aero.Cmq) / (4 * p.inertia.yy),
                   rho_S * b * b * std::abs(p.aero.Cnr) / (4 * p.inertia.zz),
                   rho_S * std::abs(p.aero.CLa) / (2 * p.mass),
                   frequency(p.aero.Cma, c, p.inertia.yy),
                   frequency(p.aero.Cnb, b, p.inertia.zz)});
}

// The largest steady climb angle at cruise whose thrust there is.
double steepest_climb(const FixedWingModel& model) {
  double low = 0, high = geo::kPi / 3;
  for (int i = 0; i < 30; ++i) {
    const double middle = (low + high) / 2;
    (find_trim(model, {model.envelope.cruise, middle}).found() ? low : high) = middle;
  }
  return low;
}

// The angle of the glide at cruise, down positive.
double glide(const FixedWingModel& model) {
  double low = 0, high = geo::kPi / 3;
  for (int i = 0; i < 30; ++i) {
    const double middle = (low + high) / 2;
    const TrimResult result =
        find_trim(model, {model.envelope.cruise, -middle}, TrimThrust::kDirect);
    (result.trim.thrust > 0 ? low : high) = middle;
  }
  return low;
}

// The thinnest air in which it flies level at some airspeed that keeps the lift reserve
// of its slowest one; a glider needs no thrust, only that airspeed.
double min_density(const FixedWingModel& model) {
  const Envelope& envelope = model.envelope;
  const auto flies = [&](double altitude) {
    const double density = model::standard_air(altitude).density;
    const double min = envelope.slowest * std::sqrt(model::kSeaLevelDensity / density);
    if (min > envelope.fastest) return false;
    if (!model.engine.exists()) return true;
    for (const double airspeed :
         {std::max(min, envelope.cruise), min, (min + envelope.fastest) / 2})
      if (find_trim(model, {airspeed, 0, 0, altitude}).found()) return true;
    return false;
  };
  double low = kLowestCeiling, high = kHighestCeiling;
  for (int i = 0; i < 12; ++i) {
    const double middle = (low + high) / 2;
    (flies(middle) ? low : high) = middle;
  }
  return model::standard_air(low).density;
}

FixedWingAirframe airframe_of(const FixedWingModel& model) {
  const Envelope& envelope = model.envelope;
  const double V = envelope.cruise;
  FixedWingAirframe a;
  a.mass = model.body.mass();
  a.slowest = envelope.slowest;
  a.cruise = V;
  a.fastest = envelope.fastest;
  a.bank_limit = envelope.bank_limit;
  a.pitch_up = envelope.pitch_up;
  a.pitch_down = envelope.pitch_down;
  a.motor = model.engine.exists();
  a.rudder = model.servos.rudder_max > 0;
  const double glide_angle = glide(model);
  if (a.motor) a.climb_rate = kReserve * V * math::sin(steepest_climb(model));
  a.sink_rate = kReserve * V * math::sin(glide_angle);
  const Trim trim =
      find_trim(model, {V, a.motor ? 0 : -glide_angle}, TrimThrust::kEngine).trim;
  a.trim_alpha = trim.alpha;
  a.trim_elevator = trim.surfaces.elevator / model.servos.elevator_max;
  a.trim_throttle = trim.throttle;

  const auto turn = [&](const Vec3& v_B, const Vec3& w_B, const Surfaces& d) -> Vec3 {
    const Wrench wrench = model.loads(Flow(v_B), w_B, d, model::kSeaLevelDensity, {});
    return model.body.angular_acceleration(w_B, wrench.moment_B);
  };
  const Vec3 still = turn(trim.v_AB_B, Vec3::Zero(), trim.surfaces);
  const auto with = [&](double aileron, double elevator, double rudder) -> Vec3 {
    Surfaces d = trim.surfaces;
    d.aileron += aileron;
    d.elevator += elevator;
    d.rudder += rudder;
    return turn(trim.v_AB_B, Vec3::Zero(), d) - still;
  };
  a.aileron_power = with(model.servos.aileron_max, 0, 0).x();
  a.elevator_power = with(0, -model.servos.elevator_max, 0).y();
  a.rudder_power = with(0, 0, -model.servos.rudder_max).z();
  const double rate = 1e-3;  // the damping is linear in it
  a.roll_damping = (still - turn(trim.v_AB_B, {rate, 0, 0}, trim.surfaces)).x() / rate;
  a.pitch_damping = (still - turn(trim.v_AB_B, {0, rate, 0}, trim.surfaces)).y() / rate;
  const double angle = 1e-3;
  const auto pitched = [&](double alpha) -> Vec3 {
    return V * Vec3(math::cos(alpha), 0, math::sin(alpha));
  };
  const Vec3 more = pitched(trim.alpha + angle), less = pitched(trim.alpha - angle);
  a.pitch_stiffness =
      (turn(less, Vec3::Zero(), trim.surfaces) - turn(more, Vec3::Zero(), trim.surfaces))
          .y() /
      (2 * angle);
  const double qS_m =
      0.5 * model::kSeaLevelDensity * V * V * model.wing_area * model.body.inverse_mass();
  a.lift_slope = qS_m / V *
                 (model.aero.lift_coefficient(trim.alpha + angle) -
                  model.aero.lift_coefficient(trim.alpha - angle)) /
                 (2 * angle);
  return a;
}

}  // namespace

FixedWingPlant::FixedWingPlant(const FixedWingParameters& parameters)
    : model_(parameters),
      ground_(parameters.ground),
      hand_launch_(parameters.hand_launch),
      stiffness_(stiffness_of(parameters)) {
  SKEIN_CHECK(errors(parameters).empty());
  airframe_ = airframe_of(model_);
  airframe_.span = parameters.geometry.span;
  airframe_.roll_friction = parameters.ground.friction_along;
  airframe_.rest_pitch = parameters.ground.rest_pitch;
  if (airframe_.rudder) airframe_.steering = parameters.ground.steering;
  airframe_.brake_friction = parameters.ground.brake_friction;
  airframe_.hand_launched = hand_launch_.has_value() && airframe_.motor;
  const double V = airframe_.cruise;
  limits_.airspeed = V;
  limits_.turn_radius = V * V / (kGravity * math::tan(kReserve * airframe_.bank_limit));
  limits_.climb_rate = airframe_.climb_rate;
  limits_.sink_rate = airframe_.sink_rate;
  limits_.slowest = airframe_.slowest;
  limits_.fastest = airframe_.fastest;
  limits_.min_density = min_density(model_);
  limits_.climb_acceleration = kClimbAcceleration;
}

VehicleState FixedWingPlant::start(const VehicleStart& start) const {
  VehicleState state;
  state.energy = model_.engine.full();
  state.on_ground = start.on_ground;
  if (start.on_ground) {
    state.p_N = start.p_N;
    state.held = start.held && model_.engine.exists();
    const bool in_hand = state.held && hand_launch_;
    if (in_hand) state.p_N.z() -= hand_launch_->height;
    state.q_NB = geo::from_euler(
        {0, in_hand ? hand_launch_->pitch : ground_.rest_pitch, start.heading});
    state.airspeed = start.wind_N.norm();
    return state;
  }
  const double climb =
      airframe_.motor ? 0
                      : -math::asin(airframe_.sink_rate / (kReserve * airframe_.cruise));
  TrimResult result = find_trim(model_, {airframe_.cruise, climb, 0, -start.p_N.z()});
  // In air too thin for its engine it starts as at sea level, and will sink.
  if (!result.found()) result = find_trim(model_, {airframe_.cruise, climb});
  const Trim& trim = result.trim;
  set_motion(state, trimmed_motion(trim, start.p_N, start.heading, start.wind_N));
  state.airspeed = airframe_.cruise;
  state.actuators[channel::kAileron] = trim.surfaces.aileron;
  state.actuators[channel::kElevator] = trim.surfaces.elevator;
  state.actuators[channel::kRudder] = trim.surfaces.rudder;
  state.actuators[channel::kThrottle] = trim.spin;
  return state;
}

double FixedWingPlant::parts(const VehicleState& state, const Air& air, double dt) const {
  const double airspeed = (state.v_N - air.wind_N).norm();
  const double fastest = std::max(stiffness_ * airspeed, state.w_NB_B.norm());
  const double needed =
      std::max(dt * (fastest / kFastest), dt / kLongestStep * (1 - 1e-9));
  return needed <= 1 ? 1 : std::min(std::ceil(needed), kMaxParts);
}

void FixedWingPlant::step(VehicleState& state, const Control& control, const Air& air,
                          double dt) const {
  const Actuators& actuators = std::get<Actuators>(control);
  const double n = parts(state, air, dt);
  const double height = -state.p_N.z();
  for (double i = 0; i < n; i += 1) {
    if (state.held)
      held_step(state, actuators, air, dt / n);
    else
      short_step(state, actuators, air, dt / n);
  }
  state.airspeed = (state.v_N - air.wind_N).norm();
  if (-state.p_N.z() > height) state.on_ground = false;
}

// Its crew moves it; surfaces and engine are its own.
void FixedWingPlant::held_step(VehicleState& state, const Actuators& control,
                               const Air& air, double dt) const {
  const double throttle = bounded_or(0, control[channel::kThrottle], 0, 1);
  if (!hold(hand_launch_, state, throttle, air.wind_N, dt))
    return short_step(state, control, air, dt);
  VehicleState own = state;
  short_step(own, control, air, dt);
  state.actuators = own.actuators;
  state.energy = own.energy;
}

Contact FixedWingPlant::touch(VehicleState& state, double ground_msl, double dt) const {
  // Wheels turn with the rudder, which yaws left when positive.
  const double left =
      airframe_.rudder ? state.actuators[channel::kRudder] / model_.servos.rudder_max : 0;
  return touch_ground(ground_, state, ground_msl, dt, state.actuators[channel::kBrake],
                      -ground_.steering * left);
}

void FixedWingPlant::short_step(VehicleState& state, const Actuators& control,
                                const Air& air, double dt) const {
  const double altitude = -state.p_N.z();
  const model::DensityAround density = model::density_around(altitude);
  Motion motion = motion_of(state);

  // Servos and engine move on their own: their whole course through the step is known.
  const Servos& servos = model_.servos;
  const double servo_decay = math::exp(-0.5 * dt / servos.lag);
  const auto surface = [&](std::size_t k, double largest) -> Course {
    double& at = state.actuators[k];
    if (state.faults.is_stuck(k)) return {at, at, at};
    const double to =
        state.faults.is_dead(k) ? 0 : bounded_or(0, control[k], -1, 1) * largest;
    const Course course = servo_course(servos, at, to, dt, servo_decay);
    at = course[2];
    return course;
  };
  const Course aileron = surface(channel::kAileron, servos.aileron_max);
  const Course elevator = surface(channel::kElevator, servos.elevator_max);
  const Course rudder = surface(channel::kRudder, servos.rudder_max);
  // Brakes act faster than the wheels slow down; a dead one does not hold.
  if (!state.faults.is_stuck(channel::kBrake))
    state.actuators[channel::kBrake] =
        state.faults.is_dead(channel::kBrake)
            ? 0
            : bounded_or(0, control[channel::kBrake], 0, 1);

  const Engine& engine = model_.engine;
  double& spin = state.actuators[channel::kThrottle];
  Course spins{spin, spin, spin};
  if (engine.exists()) {
    const Mat3 R_NB = rotation(motion.q_NB);
    const double forward = R_NB.col(0).dot(motion.v_N - air.wind_N);
    if (!state.faults.is_stuck(channel::kThrottle)) {
      const bool runs = !state.faults.is_dead(channel::kThrottle) &&
                        !state.faults.battery && state.energy.charge > 0;
      const double throttle = runs ? bounded_or(0, control[channel::kThrottle], 0, 1) : 0;
      const double to =
          engine.target(throttle, state.energy.voltage, forward, density.density);
      const double decay = math::exp(-0.5 * dt / engine.lag());
      spins[1] = to + (spin - to) * decay;
      spins[2] = to + (spins[1] - to) * decay;
      if (to == 0 && spins[2] < kStands) spins[2] = 0;
    }
    const double share = draw(engine.source(), state.energy, state.faults,
                              engine.power(spins[1], forward, density.density), dt);
    // Power goes with the cube of the speed: this makes do with the share.
    spin = share < 1 ? spins[2] * (2 + share) / 3 : spins[2];
  }

  rk4_step(model_.body, motion, dt, [&](const Stage& stage) {
    const auto k = static_cast<std::size_t>(stage.halves);
    const Vec3 v_AB_B = in_body(stage.R_NB, stage.motion.v_N - air.wind_N);
    const double rho = density.at(-stage.motion.p_N.z() - altitude);
    const Wrench wrench = model_.loads(Flow(v_AB_B), stage.motion.w_NB_B - air.rates_B,
                                       {aileron[k], elevator[k], rudder[k]}, rho,
                                       engine.output(spins[k], v_AB_B.x(), rho));
    return Loads{wrench.force_B, wrench.moment_B};
  });
  set_motion(state, motion);
}

}  // namespace skein::asset
