// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/skein/skein_autopilot.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "skein/base/math.h"

namespace skein::autopilot {
namespace {

constexpr double kUnknownPlace = 50;  // standard deviation at the start [m]
constexpr double kUnknownWind = 5;    // standard deviation at the start [m/s]
constexpr double kStaleState = 0.5;   // an estimate this old is none [s]
constexpr double kDisbelief = 10;     // of fixes, longer than it takes to begin anew [s]
constexpr double kSilentMonitor = 5;  // then the charge is counted on [s]
constexpr double kCommittedHeight = 10;  // below it a landing is finished [m]
constexpr double kNearCorner = 2;        // of the route home, passed within [turn radii]
constexpr double kMinNear = 10;          // and within this at least [m]

EstimatorStart start_of(const NavEstimate& initial, bool on_ground) {
  EstimatorStart start;
  start.time = initial.time;
  start.p_N = initial.p_N;
  start.v_N = initial.v_N;
  start.q_NB = geo::from_euler({initial.roll, initial.pitch, initial.heading});
  start.wind_N = initial.wind_N;
  start.at_rest = on_ground;
  // Where it is, the first fix says: to be given it would give the receiver's error too.
  start.sd.position = start.sd.altitude = kUnknownPlace;
  start.sd.wind = kUnknownWind;
  return start;
}

// Mean throttle in hover; 0 for what cannot.
double hover_throttle(const Airframe& airframe) {
  const auto* frame = std::get_if<MultirotorAirframe>(&airframe);
  if (!frame) return 0;
  const double share = frame->mass * kGravity /
                       (frame->thrust_max * static_cast<double>(frame->rotors.size()));
  return math::pow(share, 1 / frame->thrust_exponent);
}

double mean_throttle(const Control& control, const Airframe& airframe) {
  const auto* actuators = std::get_if<Actuators>(&control);
  if (!actuators) return 0;
  const auto* frame = std::get_if<MultirotorAirframe>(&airframe);
  if (!frame) return (*actuators)[channel::kThrottle];
  double sum = 0;
  for (std::size_t k = 0; k < frame->rotors.size(); ++k) sum += (*actuators)[k];
  return sum / static_cast<double>(frame->rotors.size());
}

}  // namespace

SkeinAutopilot::Controller SkeinAutopilot::make_controller(const SkeinSetup& setup,
                                                           const Vec3& home_N) {
  if (setup.wing) return FixedWingController(setup, home_N);
  if (setup.rotors) return MultirotorController(setup, home_N);
  return PointController(setup, home_N);
}

SkeinAutopilot::SkeinAutopilot(std::shared_ptr<const SkeinSetup> setup,
                               const NavEstimate& initial, bool on_ground,
                               std::optional<double> ground_msl)
    : SkeinAutopilot(std::move(setup), initial, on_ground,
                     Vec3(initial.p_N.x(), initial.p_N.y(),
                          -ground_msl.value_or(-initial.p_N.z()))) {}

SkeinAutopilot::SkeinAutopilot(std::shared_ptr<const SkeinSetup> setup,
                               const NavEstimate& initial, bool on_ground,
                               const Vec3& home_N)
    : setup_(std::move(setup)),
      home_N_(home_N),
      estimator_({setup_, &setup_->options.estimator}, start_of(initial, on_ground)),
      modes_(setup_->rules),
      fence_(setup_->fence),
      motors_(setup_->options.motor_watch),
      consumption_(setup_->options.consumption),
      ground_(setup_->limits, hover_throttle(setup_->airframe), on_ground),
      sensors_(initial.time, setup_->options.watches_sensors),
      controller_(make_controller(*setup_, home_N_)) {
  if (setup_->wing || setup_->rotors) last_ = Actuators{};
  if (setup_->options.watches_link) input_.link_heard = initial.time;
  if (setup_->options.watches_gnss) input_.gnss_fix = initial.time;
}

void SkeinAutopilot::begin(const NavEstimate& start, bool on_ground) {
  SkeinAutopilot anew(setup_, start, on_ground, home_N_);
  const bool unheard = input_.command != CommandKind::kNone;
  anew.input_.command = unheard ? input_.command : modes_.agent_command();
  anew.agent_command_ = std::move(agent_command_);
  anew.take_off_ = std::move(take_off_);
  anew.return_ = std::move(return_);
  *this = std::move(anew);
}

bool SkeinAutopilot::selected(FlightSensor sensor, std::uint8_t unit, Time time) {
  const SensorSelector::Use use = sensors_.take(sensor, unit, time);
  if (use == SensorSelector::Use::kAnew) estimator_.replaced(sensor);
  return use != SensorSelector::Use::kNo;
}

// Whether the sample counts: of several units of a kind one is flown by.
bool SkeinAutopilot::selected(const SensorSample& sample) {
  if (const auto* imu = std::get_if<ImuSample>(&sample))
    return selected(FlightSensor::kImu, imu->unit, imu->time);
  if (const auto* baro = std::get_if<BarometerSample>(&sample))
    return selected(FlightSensor::kBarometer, baro->unit, baro->time);
  if (const auto* field = std::get_if<MagnetometerSample>(&sample))
    return selected(FlightSensor::kMagnetometer, field->unit, field->time);
  if (const auto* air = std::get_if<AirspeedSample>(&sample))
    return selected(FlightSensor::kAirspeed, air->unit, air->time);
  if (const auto* power = std::get_if<PowerSample>(&sample))
    sensors_.take(FlightSensor::kPower, 0, power->time);
  return true;
}

void SkeinAutopilot::sense(const SensorSample& sample) {
  if (!selected(sample)) return;
  if (const auto* pilot = std::get_if<PilotInput>(&sample)) {
    input_.pilot = *pilot;
  } else if (const auto* link = std::get_if<LinkSample>(&sample)) {
    input_.link_heard = link->time;
  } else if (const auto* power = std::get_if<PowerSample>(&sample)) {
    take(*power);
  } else {
    estimator_.sense(sample);
    if (const auto* truth = std::get_if<TruthSample>(&sample))
      input_.gnss_fix = truth->time;
    // Fixes that the estimator has not believed for long are none.
    const auto* fix = std::get_if<GnssFix>(&sample);
    if (fix && estimator_.gnss_age() < kDisbelief) input_.gnss_fix = fix->time;
  }
}

void SkeinAutopilot::take(const PowerSample& sample) {
  consumption_.sense(sample.time, sample.charge);
  standing_ = sample.motors_standing;
  input_.charge = power_charge_ = sample.charge;
  power_time_ = sample.time;
  powered_ = true;
  HomeFlight flight = setup_->home_flight;
  consumption_.set_powers(flight);
  input_.charge_home = need_of_return(estimator_.state(), flight).energy;
}

// Leg by leg; height is changed over the last place.
HomeNeed SkeinAutopilot::need_of_return(const NavState& nav,
                                        const HomeFlight& flight) const {
  const Vec2 wind = geo::horizontal(nav.wind_N);
  Vec2 from = geo::horizontal(nav.p_N);
  if (return_.points.empty())
    return home_need(geo::horizontal(home_N_) - from, home_N_.z() - nav.p_N.z(), wind,
                     flight);
  HomeFlight leg = flight;
  leg.landing_time = 0;
  HomeNeed all;
  for (std::size_t k = 0; k < return_.points.size(); ++k) {
    const bool last = k + 1 == return_.points.size();
    const double height = last ? -return_.ground_msl - nav.p_N.z() : 0;
    const HomeNeed need =
        home_need(return_.points[k] - from, height, wind, last ? flight : leg);
    all.time += need.time;
    all.energy += need.energy;
    from = return_.points[k];
  }
  return all;
}

// What a landing still takes is not known while it is flown, so it is finished. Before,
// further from its place than it flies in the time of a landing, it is on its way home.
bool SkeinAutopilot::is_landing(const NavState& nav) const {
  if (order_ != Order::kLand || return_.points.size() > 1) return false;
  const Vec2 place =
      return_.points.empty() ? geo::horizontal(home_N_) : return_.points.front();
  const HomeFlight& flight = setup_->home_flight;
  return (geo::horizontal(nav.p_N) - place).norm() <
         flight.airspeed * flight.landing_time;
}

void SkeinAutopilot::set_return(const ReturnRoute& route) {
  if (route == return_) return;
  return_ = route;
  return_changed_ = true;
}

void SkeinAutopilot::command(const AutopilotCommand& command) {
  if (std::holds_alternative<TakeOff>(command.guidance)) take_off_ = command;
  // A take-off without a command that waits for its end stays where it leads.
  agent_command_ = command;
  input_.command = kind_of(command);
}

ControllerView SkeinAutopilot::view() const {
  return {estimator_.state(),
          estimator_.height_agl(),
          -home_N_.z(),
          !modes_.decision().without_position,
          !modes_.decision().without_motor,
          !is_lost(FlightSensor::kAirspeed)};
}

void SkeinAutopilot::look_around(Time now, const NavState& nav) {
  input_.now = now;
  lost_ = sensors_.lost(now);
  input_.imu_lost = is_lost(FlightSensor::kImu);
  input_.estimator_healthy = std::isfinite(nav.p_N.sum() + nav.v_N.sum()) &&
                             (now - nav.time).seconds() < kStaleState &&
                             !estimator_.diverged();
  if (powered_ && (now - power_time_).seconds() > kSilentMonitor)
    input_.charge = std::max(
        0.0, power_charge_ - consumption_.rate() * (now - power_time_).seconds());
  if (is_landing(nav)) input_.charge_home = std::min(input_.charge_home, input_.charge);
  input_.on_ground = ground_.step(nav, throttle_);
  const bool coordinated =
      std::visit([](const auto& f) { return f.coordinated(); }, controller_);
  estimator_.set_coordinated(coordinated && ground_.clear() && !input_.on_ground);
  const bool landing =
      order_ == Order::kLand ||
      (order_ == Order::kAgent && std::holds_alternative<Land>(agent_command_.guidance));
  const bool floor_counts = !input_.on_ground && !landing && order_ != Order::kTakeOff;
  input_.outside_fence = fence_.step(nav.p_N, nav.v_N, floor_counts);
  if (const auto* commanded = std::get_if<Actuators>(&last_)) {
    // For good: a rotor that is no longer commanded to turn looks like one that may
    // stand.
    failed_ |= motors_.step(now, standing_, *commanded);
    input_.motor_failed = failed_ != 0;
    if (auto* rotors = std::get_if<MultirotorController>(&controller_))
      rotors->set_standing(failed_);
  }
  const AutopilotStatus& flown = std::visit(
      [](const auto& f) -> const AutopilotStatus& { return f.status(); }, controller_);
  input_.done = flown.done;
  input_.landed = landing && flown.done && input_.on_ground;
  const bool elsewhere = order_ == Order::kLand && !return_.points.empty();
  const double ground = elsewhere ? return_.ground_msl : -home_N_.z();
  input_.committed = landing && -nav.p_N.z() - ground < kCommittedHeight;
}

Control SkeinAutopilot::control(Time now, double dt) {
  const NavState& nav = estimator_.state();
  look_around(now, nav);
  const Decision& decision = modes_.step(input_);
  const ControllerView seen = view();
  const bool again = decision.events.has(ModeEvent::kOrderChanged);
  if (decision.order != order_ || again) {
    obey(decision.order, order_, seen);
    order_ = decision.order;
  } else if (input_.command != CommandKind::kNone && order_ == Order::kAgent) {
    give(agent_command_, seen);  // the same kind again, with other content
  }
  input_.command = CommandKind::kNone;
  lead_home(seen);
  last_ = fly(order_, seen, dt);
  if (!setup_->lap_wings.empty()) change_gains();
  throttle_ = mean_throttle(last_, setup_->airframe);
  return last_;
}

void SkeinAutopilot::obey(Order order, Order before, const ControllerView& now) {
  const bool another_flew = before == Order::kPilot || before == Order::kStand;
  std::visit(
      [&](auto& controller) {
        if (another_flew && order != before) controller.take_over(now);
        if (order == Order::kDescend && before != order) controller.begin_descent(now);
      },
      controller_);
  switch (order) {
    case Order::kStand:
    case Order::kPilot:
    case Order::kDescend:
      return;
    case Order::kTakeOff:
      give(take_off_, now);
      return;
    case Order::kAgent:
      give(agent_command_, now);
      return;
    case Order::kHold:
    case Order::kReturn:
    case Order::kLand:
      if (order != before) give(failsafe_command(order, now), now);
      return;
  }
}

bool SkeinAutopilot::returns() const {
  return order_ == Order::kReturn || order_ == Order::kLand ||
         (order_ == Order::kAgent &&
          std::holds_alternative<Return>(agent_command_.guidance));
}

// Another route home, or the next piece of it.
void SkeinAutopilot::lead_home(const ControllerView& now) {
  std::vector<Vec2>& points = return_.points;
  if (returns() && points.size() > 1) {
    const double near = std::max(kNearCorner * setup_->limits.turn_radius, kMinNear);
    if ((geo::horizontal(now.nav.p_N) - points.front()).norm() < near) {
      points.erase(points.begin());
      return_changed_ = true;
    }
  }
  if (!return_changed_) return;
  return_changed_ = false;
  if (!returns() || input_.committed) return;
  if (order_ == Order::kAgent)
    give(agent_command_, now);
  else
    give(failsafe_command(order_, now), now);
}

AutopilotCommand SkeinAutopilot::failsafe_command(Order order,
                                                  const ControllerView& now) const {
  AutopilotCommand command;
  command.altitude_msl = -now.nav.p_N.z();
  const bool at_home = return_.points.empty();
  if (order == Order::kReturn || (order == Order::kLand && return_.points.size() > 1))
    command.guidance = Return{};
  else if (order == Order::kLand)
    command.guidance = at_home ? Land{geo::horizontal(home_N_), -home_N_.z()}
                               : Land{return_.points.back(), return_.ground_msl};
  else
    command.guidance = HoldPosition{geo::horizontal(now.nav.p_N)};
  return command;
}

void SkeinAutopilot::give(const AutopilotCommand& command, const ControllerView& now) {
  const auto* back = std::get_if<Return>(&command.guidance);
  AutopilotCommand led = command;
  if (back && !back->point && !return_.points.empty())
    led.guidance = Return{return_.points.front()};
  auto reason = std::visit([&](auto& controller) { return controller.command(led, now); },
                           controller_);
  if (!reason) return;
  refused_ = std::move(*reason);
  ++refusals_;
}

Control SkeinAutopilot::fly(Order order, const ControllerView& now, double dt) {
  return std::visit(
      [&](auto& controller) {
        switch (order) {
          case Order::kStand:
            return controller.stand(now, dt);
          case Order::kTakeOff:
            // Not before it knows how it stands.
            return estimator_.aligning() ? controller.stand(now, dt)
                                         : controller.fly(now, dt);
          case Order::kPilot:
            return controller.pilot(*input_.pilot, now, dt);
          case Order::kDescend:
            return modes_.decision().without_attitude ? controller.release(now, dt)
                                                      : controller.descend(now, dt);
          default:
            return controller.fly(now, dt);
        }
      },
      controller_);
}

void SkeinAutopilot::change_gains() {
  auto& wing = std::get<FixedWingController>(controller_);
  const std::size_t lap =
      std::min(static_cast<std::size_t>(wing.status().lap), setup_->lap_wings.size() - 1);
  if (lap == lap_) return;
  lap_ = lap;
  wing.change(setup_->options.lap_gains[lap].lateral, setup_->lap_wings[lap]);
}

AutopilotStatus SkeinAutopilot::status() const {
  AutopilotStatus status = std::visit(
      [](const auto& f) -> const AutopilotStatus& { return f.status(); }, controller_);
  const Decision& decision = modes_.decision();
  status.on_ground = ground_.on_ground();
  status.mode = decision.mode;
  status.trigger = decision.trigger;
  status.reaction = decision.reaction;
  if (order_ == Order::kPilot || order_ == Order::kDescend) status.follows = false;
  if (order_ != Order::kAgent) status.done = false;  // of what the agent wants
  status.refusals = refusals_;
  status.refused = refused_;
  status.lost_sensors = lost_;
  status.units = sensors_.units();
  status.charge = input_.charge;
  status.reserve = input_.charge - input_.charge_home;
  status.endurance = consumption_.endurance();
  return status;
}

}  // namespace skein::autopilot
