// SPDX-License-Identifier: Apache-2.0
#include "skein/mixed/driven_plant.h"

#include <algorithm>
#include <utility>

#include "skein/base/check.h"
#include "skein/model/atmosphere/atmosphere.h"

namespace skein::mixed {
namespace {

// What inertial sensors can measure, and bumps on the ground exceed [m/s^2].
constexpr double kMaxForce = 16 * kGravity;

}  // namespace

DrivenPlant::DrivenPlant(DrivenPlantParts parts)
    : parts_(std::move(parts)),
      faults_(std::move(parts_.faults), std::move(parts_.breakable)) {
  SKEIN_CHECK(parts_.channels > 0 && parts_.channels <= Actuators::kMaxChannels);
}

void DrivenPlant::begin(const Surroundings& world, Time now) {
  parts_.air.wind_N = world.wind.wind(parts_.state.p_N, now);
  outputs_ = {};
  parts_.drive->begin(now);
}

void DrivenPlant::begin_step(Time now) {
  if (faults_.update(now, events_)) parts_.state.faults = faults_.in_force().plant;
  parts_.drive->look_after(now);
  outside_.clear();
  parts_.drive->take_events(now, outside_);
  for (OutsideEvent& event : outside_) {
    events_.push_back({event.kind, event.text});
    reports_.emplace_back(std::move(event));
  }
}

void DrivenPlant::advance(const Surroundings& world, Time now, Time until) {
  const double dt = parts_.step.seconds();
  // Within one step of the run no vehicle climbs so far that the density changes.
  parts_.air.density = model::standard_air(-parts_.state.p_N.z()).density;
  PlantFlight flight(parts_.name, *parts_.plant, parts_.turbulence.get(), parts_.state,
                     parts_.air, world.terrain, world.wind);
  applied_ = {static_cast<std::uint32_t>(parts_.channels), {}, {}};
  while (now < until && !lost_) {
    const Vec3 v_before_N = parts_.state.v_N;
    const bool last = now + parts_.step >= until;
    if (auto accident = flight.step(now, control(), dt, last)) {
      lost_ = true;
      events_.push_back({EventKind::kAccident, *std::move(accident)});
    } else {
      now += parts_.step;
      exchange(now, v_before_N, flight.ground_msl());
    }
  }
  if (!applied_.steps.empty()) reports_.emplace_back(std::move(applied_));
}

Control DrivenPlant::control() const {
  Actuators actuators;
  std::copy_n(outputs_.begin(), parts_.channels, actuators.channel.begin());
  return actuators;
}

void DrivenPlant::exchange(Time now, const Vec3& v_before_N, double ground_msl) {
  const VehicleState& state = parts_.state;
  SensedMotion motion;
  motion.time = now;
  motion.dt = parts_.step.seconds();
  motion.p_N = state.p_N;
  motion.v_N = state.v_N;
  motion.q_NB = state.q_NB;
  motion.w_NB_B = state.w_NB_B;
  const Vec3 f_N = (state.v_N - v_before_N) / motion.dt - Vec3(0, 0, kGravity);
  const Vec3 f_B = state.q_NB.conjugate() * f_N;
  motion.f_B = f_B.cwiseMax(-kMaxForce).cwiseMin(kMaxForce);
  motion.airspeed = state.airspeed;
  motion.height_agl = -state.p_N.z() - ground_msl;
  motion.energy = state.energy;
  parts_.drive->exchange(motion, std::span(outputs_).first(parts_.channels));
  note_outputs();
}

// A row that holds on costs one number.
void DrivenPlant::note_outputs() {
  const auto begin = outputs_.begin();
  const auto end = begin + static_cast<std::ptrdiff_t>(parts_.channels);
  const auto count = static_cast<std::ptrdiff_t>(parts_.channels);
  if (!applied_.steps.empty() && std::equal(begin, end, applied_.values.end() - count)) {
    ++applied_.steps.back();
    return;
  }
  applied_.values.insert(applied_.values.end(), begin, end);
  applied_.steps.push_back(1);
}

void DrivenPlant::take_events(std::vector<VehicleEvent>& out) {
  for (VehicleEvent& event : events_) out.push_back(std::move(event));
  events_.clear();
}

void DrivenPlant::take_reports(std::vector<VehicleReport>& out) {
  for (VehicleReport& report : reports_) out.push_back(std::move(report));
  reports_.clear();
}

}  // namespace skein::mixed
