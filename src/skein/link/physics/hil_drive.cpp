// SPDX-License-Identifier: Apache-2.0
#include "skein/link/physics/hil_drive.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <thread>
#include <utility>

#include "skein/base/log.h"
#include "skein/data/vehicle/air.h"
#include "skein/link/physics/earth_field.h"
#include "skein/link/transport/endpoint_address.h"
#include "skein/model/atmosphere/atmosphere.h"

namespace skein::physics {
namespace {

using namespace std::chrono_literals;

constexpr auto kServe = 100ms;    // between looks while a connection is waited for
constexpr auto kMaxLate = 500ms;  // that is caught up with
constexpr auto kLine = 5s;        // between lines about waiting
const Time kFixPeriod = Time::from_seconds(0.1);
constexpr double kPositionSd = 0.3, kAltitudeSd = 0.5, kVelocitySd = 0.1;
constexpr std::uint8_t kSatellites = 14;

}  // namespace

Vec3 HilSensing::noise3(double deviation) {
  const double x = noise_(), y = noise_(), z = noise_();
  return deviation * Vec3(x, y, z);
}

HilSensors HilSensing::sensors(const SensedMotion& motion) {
  const double altitude = -motion.p_N.z();
  const model::StandardAir air = model::standard_air(altitude);
  const geo::Geodetic at = frame_.from_plane(geo::horizontal(motion.p_N));
  const Vec3 field_N = earth_field(at.latitude_deg, at.longitude_deg, declination_);
  HilSensors sensors;
  sensors.time = motion.time;
  sensors.imu = {motion.f_B + noise3(0.05), motion.w_NB_B + noise3(0.001)};
  sensors.field_B_gauss = motion.q_NB.conjugate() * field_N + noise3(0.002);
  const double error = 1.5 * noise_();
  sensors.barometer = {air.pressure + error, altitude - error / (air.density * kGravity),
                       air.temperature};
  sensors.pitot_pressure =
      air.density * motion.airspeed * motion.airspeed / 2 + 2 * noise_();
  return sensors;
}

HilFix HilSensing::fix(const SensedMotion& motion) {
  const Vec3 p_N =
      motion.p_N + noise3(1).cwiseProduct(Vec3(kPositionSd, kPositionSd, kAltitudeSd));
  const geo::Geodetic at = frame_.from_plane(geo::horizontal(p_N));
  HilFix fix;
  fix.utc_us = start_utc_us_ + motion.time.ns() / 1000;
  fix.latitude_deg = at.latitude_deg;
  fix.longitude_deg = at.longitude_deg;
  fix.alt_msl = -p_N.z();
  fix.position_sd = kPositionSd;
  fix.altitude_sd = kAltitudeSd;
  fix.v_N = motion.v_N + noise3(kVelocitySd);
  fix.satellites = kSatellites;
  return fix;
}

HilTruth HilSensing::truth(const SensedMotion& motion) const {
  const geo::Geodetic at = frame_.from_plane(geo::horizontal(motion.p_N));
  const double density = model::standard_air(-motion.p_N.z()).density;
  HilTruth truth;
  truth.time = motion.time;
  truth.latitude_deg = at.latitude_deg;
  truth.longitude_deg = at.longitude_deg;
  truth.alt_msl = -motion.p_N.z();
  truth.v_N = motion.v_N;
  truth.q_NB = motion.q_NB;
  truth.w_NB_B = motion.w_NB_B;
  truth.a_B = motion.f_B + motion.q_NB.conjugate() * Vec3(0, 0, kGravity);
  truth.true_airspeed = motion.airspeed;
  truth.indicated_airspeed =
      motion.airspeed * std::sqrt(density / model::kSeaLevelDensity);
  return truth;
}

HilDrive::HilDrive(HilDriveOptions options, HilSensing sensing, ChannelMap channels,
                   DrivingProgram program, DriveClock clock)
    : options_(std::move(options)),
      sensing_(std::move(sensing)),
      channels_(std::move(channels)),
      program_(std::move(program)),
      clock_(std::move(clock)),
      watch_(options_.patience, "an autopilot with HIL messages at " +
                                    transport::text_of(options_.link.at)) {}

HilDrive::~HilDrive() {
  program_.stop();
}

Result<void> HilDrive::open() {
  auto simulator = HilSimulator::open(options_.link);
  if (!simulator) return simulator.error();
  simulator_ = std::move(simulator).value();
  return program_.start();
}

void HilDrive::begin(Time now) {
  begin_ = now;
  begin_wall_.reset();
  fix_due_ = now;
  *clock_ = now.ns();
}

void HilDrive::look_after(Time) {
  if (program_.look(events_)) watch_.renew();
}

bool HilDrive::wait_for_connection(std::chrono::nanoseconds allowed) {
  const Clock::time_point until = Clock::now() + allowed;
  Clock::time_point line_due = Clock::now() + kLine;
  for (;;) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now());
    simulator_->serve(std::clamp<std::chrono::milliseconds>(left, 0ms, kServe));
    if (simulator_->connected()) return true;
    if (left <= kServe || program_.ended()) return false;
    if (Clock::now() < line_due) continue;
    line_due += kLine;
    log_warning("{}: waits for an autopilot at {}", options_.name, simulator_->place());
  }
}

// Until the wall clock is at `now` of the run.
void HilDrive::wait_for_wall(Time now) {
  const std::chrono::nanoseconds since((now - begin_).ns());
  // After a pause time goes on from there: what was missed is not made up for.
  const Clock::time_point here = Clock::now();
  if (!begin_wall_ || here > *begin_wall_ + since + kMaxLate) begin_wall_ = here - since;
  std::this_thread::sleep_until(*begin_wall_ + since);
}

bool HilDrive::exchange(const SensedMotion& motion, std::span<float> channels) {
  *clock_ = motion.time.ns();
  if (!simulator_) return false;
  const auto allowed = [&] { return watch_.allowed(motion.dt, Clock::now()); };
  if (!simulator_->connected()) {
    if (program_.ended()) return false;
    if (!wait_for_connection(allowed())) {
      watch_.missed(events_);
      return false;
    }
  }
  if (real_time()) wait_for_wall(motion.time);
  if (motion.time >= fix_due_) {
    fix_due_ = motion.time + kFixPeriod;
    simulator_->send(sensing_.fix(motion));
  }
  simulator_->send(sensing_.truth(motion));
  const HilReply reply =
      simulator_->step(sensing_.sensors(motion), options_.patience.answer);
  switch (reply.outcome) {
    case HilOutcome::kControls:
      heard_ = Clock::now();
      watch_.answered(events_);
      channels_.apply(reply.controls.channel, channels);
      return true;
    case HilOutcome::kNoControls:
      // It boots, or has no new ones in real time.
      if (real_time() && watch_.state() == AnswerWatch::State::kAnswers &&
          Clock::now() - heard_ > options_.patience.answer)
        watch_.missed(events_);
      return false;
    case HilOutcome::kTimedOut:
      watch_.missed(events_);
      return false;
    case HilOutcome::kNotConnected:
      watch_.missed(events_, "its connection is gone");
      return false;
  }
  return false;
}

void HilDrive::take_events(Time, std::vector<OutsideEvent>& out) {
  out.insert(out.end(), std::make_move_iterator(events_.begin()),
             std::make_move_iterator(events_.end()));
  events_.clear();
}

}  // namespace skein::physics
