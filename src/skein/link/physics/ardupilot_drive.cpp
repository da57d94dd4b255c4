// SPDX-License-Identifier: Apache-2.0
#include "skein/link/physics/ardupilot_drive.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "skein/base/log.h"
#include "skein/base/math.h"

namespace skein::physics {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr double kMetresPerDegree = 111'318.84502145034;  // of SITL's sphere
constexpr auto kLook = 200ms;      // between looks at the program while it is waited for
constexpr auto kReport = 5s;       // between lines about waiting
constexpr auto kFarewell = 300ms;  // for its orderly end

}  // namespace

Vec3 sitl_place(const Vec3& p_N, const geo::LocalFrame& frame, const SitlHome& home) {
  const geo::Geodetic at = frame.from_plane(geo::horizontal(p_N));
  const double mean = geo::radians((at.latitude_deg + home.latitude_deg) / 2);
  const double scale = std::max(math::cos(mean), 0.01);
  return {(at.latitude_deg - home.latitude_deg) * kMetresPerDegree,
          std::remainder(at.longitude_deg - home.longitude_deg, 360) * kMetresPerDegree *
              scale,
          p_N.z() + home.alt_msl};
}

ArduPilotDrive::ArduPilotDrive(ArduPilotDriveOptions options,
                               const geo::LocalFrame& frame, ChannelMap channels,
                               DrivingProgram program, DriveClock clock)
    : options_(std::move(options)),
      frame_(frame),
      channels_(std::move(channels)),
      program_(std::move(program)),
      clock_(std::move(clock)),
      watch_(options_.patience, fmt::format("ArduPilot SITL at port {}", options_.port)) {
}

ArduPilotDrive::~ArduPilotDrive() {
  if (!backend_ || program_.ended()) return;
  // It ends by itself only while it is answered.
  program_.stop();
  const Clock::time_point until = Clock::now() + kFarewell;
  while (program_.is_ours() && Clock::now() < until && !program_.ended()) {
    asked_ = asked_ || backend_->wait(5ms).has_value();
    last_.time += Time::from_seconds(last_.dt);
    if (asked_ && !reply(last_)) return;
  }
}

Result<void> ArduPilotDrive::open() {
  auto backend = ArduPilotBackend::open(options_.port);
  if (!backend) {
    Error error = backend.error();
    error.hint =
        fmt::format("{} is to be moved by an autopilot that asks there.", options_.name);
    return error;
  }
  backend_ = std::move(backend).value();
  return program_.start();
}

void ArduPilotDrive::begin(Time now) {
  zero_.reset();
  *clock_ = now.ns();
}

void ArduPilotDrive::look_after(Time) {
  if (!program_.look(events_)) return;
  backend_->forget_program();
  asked_ = false;
  watch_.renew();
}

// The next frame. While it is waited for long, its program is looked at.
std::optional<ServoFrame> ArduPilotDrive::wait(std::chrono::nanoseconds allowed) {
  const Clock::time_point begin = Clock::now(), until = begin + allowed;
  Clock::time_point report_due = begin + kReport;
  for (;;) {
    const Clock::time_point now = Clock::now();
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - now);
    if (auto frame =
            backend_->wait(std::clamp<std::chrono::milliseconds>(left, 0ms, kLook)))
      return frame;
    if (left <= kLook || program_.ended()) return std::nullopt;
    if (now < report_due) continue;
    report_due = now + kReport;
    log_warning("{}: waits for {}", options_.name,
                fmt::format("ArduPilot SITL at port {}", options_.port));
  }
}

bool ArduPilotDrive::reply(const SensedMotion& motion) {
  const std::uint64_t restarts = backend_->counts().restarts;
  if (std::exchange(restarts_, restarts) != restarts) zero_.reset();
  if (!zero_) zero_ = motion.time - Time::from_seconds(motion.dt);
  PhysicsFrame frame;
  frame.time = motion.time - *zero_;
  frame.w_NB_B = motion.w_NB_B;
  frame.f_B = motion.f_B;
  frame.p_N = sitl_place(motion.p_N, frame_, options_.home);
  frame.v_N = motion.v_N;
  frame.q_NB = motion.q_NB;
  frame.airspeed = motion.airspeed;
  frame.range = std::max(motion.height_agl, 0.0);
  if (motion.energy.voltage > 0)
    frame.battery = {motion.energy.voltage, motion.energy.power / motion.energy.voltage};
  asked_ = !backend_->reply(frame).ok();
  return !asked_;
}

bool ArduPilotDrive::exchange(const SensedMotion& motion, std::span<float> channels) {
  *clock_ = motion.time.ns();
  last_ = motion;
  if (!backend_) return false;
  const auto allowed = [&] { return watch_.allowed(motion.dt, Clock::now()); };
  // Who is gone has no step under way; what it asks first is where it is.
  if (!asked_) {
    if (program_.ended()) return false;
    asked_ = wait(allowed()).has_value();
    if (!asked_) return miss();
  }
  if (!reply(motion)) return false;
  watch_.answered(events_);
  const auto frame = wait(allowed());
  asked_ = frame.has_value();
  if (!frame) return miss();
  channels_.apply(outputs_of(*frame, channels_), channels);
  return true;
}

bool ArduPilotDrive::miss() {
  watch_.missed(events_, program_.ended() ? "its program has ended" : "");
  return false;
}

void ArduPilotDrive::take_events(Time, std::vector<OutsideEvent>& out) {
  out.insert(out.end(), std::make_move_iterator(events_.begin()),
             std::make_move_iterator(events_.end()));
  events_.clear();
}

std::vector<double> ArduPilotDrive::outputs_of(const ServoFrame& frame,
                                               const ChannelMap& map) {
  std::vector<double> outputs(std::min(map.outputs(), frame.channels));
  for (std::size_t k = 0; k < outputs.size(); ++k) {
    const double pulse = frame.pwm_us[k];
    if (pulse == 0) continue;
    outputs[k] = map.is_motor(k) ? (pulse - 1000) / 1000 : (pulse - 1500) / 500;
  }
  return outputs;
}

}  // namespace skein::physics
