// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "skein/base/time.h"
#include "skein/geo/local_frame.h"
#include "skein/geo/vec.h"
#include "skein/link/mavlink/constants.h"
#include "skein/link/mavlink/dispatch.h"
#include "skein/link/mavlink/flight_modes.h"
#include "skein/link/mavlink/frame_parser.h"
#include "skein/link/mavlink/messages.h"
#include "skein/link/mavlink/payload.h"
#include "skein/link/vehicle_services/outbox.h"

namespace skein::mixed::fake {

using mavlink::Make;

inline Time s(double seconds) {
  return Time::from_seconds(seconds);
}

/// What is wrong with a fake vehicle or its link. All at once is possible.
struct Faults {
  double late = 0;                ///< its frames and those to it take so much longer [s]
  bool time_of_day = false;       ///< it answers TIMESYNC by the time of day
  bool no_timesync = false;       ///< it does not answer TIMESYNC
  double clock_jump_at = -1;      ///< when its clock is set ahead or back [s]; < 0: never
  double clock_jump = 0;          ///< by so much [s]
  Vec3 displaced = Vec3::Zero();  ///< it stands so far from where it should [m]
  Vec3 home_displaced = Vec3::Zero();    ///< its home is so far from where it stands [m]
  double position_jump_at = -1;          ///< when its estimate jumps [s]; < 0: never
  Vec3 position_jump = Vec3::Zero();     ///< by so much [m]
  bool deaf = false;                     ///< it answers no command and obeys none
  double deaf_at = -1;                   ///< the same from then on [s]; < 0: never
  std::set<std::uint16_t> refuses = {};  ///< commands that it denies
  std::string refusal = {};              ///< what it says to people when it denies one
  bool keeps_mode = false;    ///< it accepts changes of its mode and does not change it
  double keeps_mode_at = -1;  ///< the same from then on [s]; < 0: never
  bool ignores_setpoints = false;
  double silent_at = -1;              ///< when it says nothing [s]; < 0: never
  double silent_for = 0;              ///< for so long [s]
  std::uint8_t system = 1;            ///< its number
  bool no_gps_message = false;        ///< no GPS_RAW_INT
  bool no_estimator_message = false;  ///< no EKF_STATUS_REPORT, no ESTIMATOR_STATUS
  bool no_fix = false;                ///< its receiver has no fix
  bool no_home = false;               ///< no HOME_POSITION
  double position_rate = 10;          ///< of its positions [Hz]; 0: none
  double ack_loss = 0;                ///< probability that an acknowledgement is lost
  double command_loss = 0;            ///< the same of a command, each time it is sent
  unsigned seed = 1;                  ///< of what is lost
  double charge = 0.9;                ///< of its battery
  double climb_limit = 1e9;           ///< it climbs no higher [m]
  std::uint8_t type = 2;              ///< MAV_TYPE
};

/// A multirotor with the flavour of ArduPilot or PX4 at the far end of a link, in
/// simulated time, hand-written for tests: it moves as a point, knows the modes that runs
/// use, and has faults. Its truth is what tests judge by.
class FakeVehicle {
 public:
  FakeVehicle(Make make, Faults with, const geo::LocalFrame& frame)
      : faults(std::move(with)),
        make_(make),
        frame_(frame),
        out_(faults.system, 1,
             [this](auto, std::span<const std::byte> bytes) {
               if (!silent()) sent_.emplace_back(bytes.begin(), bytes.end());
             }),
        home_(faults.displaced) {
    p_N = home_;
    set_mode(make == Make::kArduPilot ? kStabilize : kHold);
  }

  Faults faults;

  // Its truth.
  Vec3 p_N = Vec3::Zero(), v_N = Vec3::Zero();
  bool armed = false;
  bool critical = false;  ///< as its heartbeats say of its state
  VehicleMode mode() const { return mavlink::mode_of(make_, true, custom_mode_); }
  bool on_ground() const { return p_N.z() > home_.z() - 0.3; }
  double height() const { return home_.z() - p_N.z(); }
  const Vec3& home() const { return home_; }
  Time now;
  Time last_setpoint = s(-1000);  ///< obeyed
  double furthest = 0;      ///< from where it began, on the map, while in the air [m]
  double lowest_led = 1e9;  ///< height at which it was led sideways, the least [m]
  bool flew = false;
  int setpoints = 0;                      ///< obeyed
  int arms = 0, take_offs = 0;            ///< commands that it accepted
  std::map<std::uint16_t, int> commands;  ///< that came in, by their numbers
  /// Times that a repeated command took it from who had chosen a mode.
  int overridden = 0;
  /// The same by a command first sent before a heartbeat could tell.
  int crossed = 0;

  /// Someone else changes its mode: a pilot, or a failsafe of its own.
  void change_mode(VehicleMode to) {
    const auto number = mavlink::custom_mode_of(make_, true, to);
    if (!number) return;
    set_mode(*number);
    changed_at_ = now;
  }

  /// It says something to people.
  void say(std::uint8_t severity, const std::string& what) {
    mavlink::Statustext text;
    text.severity = severity;
    mavlink::set_text(text.text, what);
    out_.send(1, text);
  }

  /// Frames that it has sent since the last call.
  std::vector<std::vector<std::byte>> take_sent() { return std::exchange(sent_, {}); }

  void receive(const mavlink::Frame& frame) {
    if (frame.target_system() != 0 && frame.target_system() != faults.system) return;
    using namespace mavlink;  // NOLINT: a list of messages
    dispatch<Timesync, CommandLong, CommandInt, SetPositionTargetGlobalInt>(
        frame, [this](const auto& m) { take(m); });
  }

  void step(Time at, double dt) {
    now = at;
    move(dt);
    if (due("heartbeat", 1)) say_condition();
    if (due("status", 0.5)) say_quality();
    if (faults.position_rate > 0 && due("position", 1 / faults.position_rate))
      say_motion();
  }

 private:
  static constexpr std::uint32_t kStabilize = 0;
  static constexpr std::uint32_t kHold = 4U << 16 | 3U << 24;
  static constexpr double kSpeed = 8, kClimb = 3, kSink = 1.5;  // [m/s]
  static constexpr std::uint8_t kAccepted = 0, kDenied = 2;

  bool ardupilot() const { return make_ == Make::kArduPilot; }
  bool from(double at) const { return at >= 0 && now >= s(at); }
  bool silent() const {
    return from(faults.silent_at) && now < s(faults.silent_at + faults.silent_for);
  }
  bool deaf() const { return faults.deaf || from(faults.deaf_at); }
  void set_mode(std::uint32_t number) { custom_mode_ = number; }
  bool due(const std::string& what, double period) {
    Time& next = due_[what];
    if (now < next) return false;
    next = now + s(period);
    return true;
  }

  Time boot_time() const {
    return now + s(37) + s(from(faults.clock_jump_at) ? faults.clock_jump : 0);
  }
  std::uint32_t boot_ms() const {
    return static_cast<std::uint32_t>(std::max<std::int64_t>(boot_time().ns(), 0) /
                                      1'000'000);
  }
  // Where it believes that it is.
  Vec3 believed() const {
    return from(faults.position_jump_at) ? Vec3(p_N + faults.position_jump) : p_N;
  }

  void move(double dt) {
    v_N = Vec3::Zero();
    if (!armed) return;
    switch (mode()) {
      case VehicleMode::kTakeOff:
        if (go(Vec3(p_N.x(), p_N.y(), climb_to_), dt)) set_mode(kHold);
        break;
      case VehicleMode::kGuided:
        if (goal_) go(*goal_, dt);
        break;
      case VehicleMode::kReturn: {
        const Vec2 way = geo::horizontal(home_) - geo::horizontal(p_N);
        if (way.norm() > 1)
          go(Vec3(home_.x(), home_.y(), std::min(p_N.z(), home_.z() - 15)), dt);
        else
          come_down(dt);
        break;
      }
      case VehicleMode::kLand:
        come_down(dt);
        break;
      default:
        break;
    }
    if (on_ground()) return;
    flew = true;
    furthest = std::max(furthest, geo::horizontal(p_N - home_).norm());
    if (geo::horizontal(v_N).norm() > 1 && mode() == VehicleMode::kGuided)
      lowest_led = std::min(lowest_led, height());
  }

  void come_down(double dt) {
    if (on_ground()) {
      armed = false;
      p_N.z() = home_.z();
      return;
    }
    p_N.z() += kSink * dt;
    v_N.z() = kSink;
  }

  bool go(const Vec3& there, double dt) {
    const Vec2 way = geo::horizontal(there - p_N);
    const double step = kSpeed * dt;
    const Vec3 before = p_N;
    p_N.head<2>() += way.norm() > step ? Vec2(way.normalized() * step) : way;
    p_N.z() += std::clamp(there.z() - p_N.z(), -kClimb * dt, kClimb * dt);
    p_N.z() = std::max(p_N.z(), home_.z() - faults.climb_limit);
    v_N = (p_N - before) / dt;
    return (there - p_N).norm() < 0.5;
  }

  void say_condition() {
    mavlink::Heartbeat heartbeat;
    heartbeat.type = faults.type;
    heartbeat.autopilot =
        ardupilot() ? mavlink::kAutopilotArduPilot : mavlink::kAutopilotPx4;
    heartbeat.base_mode = static_cast<std::uint8_t>(mavlink::kModeCustom |
                                                    (armed ? mavlink::kModeArmed : 0));
    heartbeat.custom_mode = custom_mode_;
    constexpr std::uint8_t kStandby = 3, kActive = 4, kCritical = 5;
    heartbeat.system_status = critical ? kCritical : armed ? kActive : kStandby;
    heartbeat.mavlink_version = 3;
    out_.send(1, heartbeat);
    mavlink::ExtendedSysState landed;
    landed.landed_state = on_ground() ? 1 : 2;
    out_.send(1, landed);
    mavlink::SysStatus status;
    status.voltage_battery = 12'000;
    status.current_battery = 100;
    status.battery_remaining = static_cast<std::int8_t>(std::lround(faults.charge * 100));
    out_.send(1, status);
    if (faults.no_home) return;
    const Vec3 at = home_ + faults.home_displaced;
    const auto place = scaled(at);
    mavlink::HomePosition home;
    home.latitude = place.first;
    home.longitude = place.second;
    home.altitude = static_cast<std::int32_t>(std::lround(-at.z() * 1000));
    out_.send(1, home);
  }

  void say_quality() {
    const auto place = scaled(believed());
    if (!faults.no_gps_message) {
      mavlink::GpsRawInt gps;
      gps.time_usec = static_cast<std::uint64_t>(boot_ms()) * 1000;
      gps.fix_type = faults.no_fix ? 1 : 3;
      gps.lat = place.first;
      gps.lon = place.second;
      gps.alt = static_cast<std::int32_t>(std::lround(-believed().z() * 1000));
      gps.eph = gps.epv = 100;
      gps.satellites_visible = faults.no_fix ? 2 : 12;
      out_.send(1, gps);
    }
    if (faults.no_estimator_message) return;
    constexpr std::uint16_t kWell = 1 | 2 | 4 | 8 | 16 | 32 | 256 | 512;
    constexpr std::uint16_t kNoPlace = 1 | 4 | 32 | 128;
    const std::uint16_t flags = faults.no_fix ? kNoPlace : kWell;
    if (ardupilot()) {
      mavlink::EkfStatusReport ekf;
      ekf.flags = flags;
      out_.send(1, ekf);
    } else {
      mavlink::EstimatorStatus estimator;
      estimator.flags = flags;
      out_.send(1, estimator);
    }
  }

  void say_motion() {
    mavlink::Attitude attitude;
    attitude.time_boot_ms = boot_ms();
    out_.send(1, attitude);
    const Vec3 at = believed();
    const auto place = scaled(at);
    mavlink::GlobalPositionInt position;
    position.time_boot_ms = boot_ms();
    position.lat = place.first;
    position.lon = place.second;
    position.alt = static_cast<std::int32_t>(std::lround(-at.z() * 1000));
    position.relative_alt = static_cast<std::int32_t>(
        std::lround((home_.z() + faults.home_displaced.z() - at.z()) * 1000));
    position.vx = static_cast<std::int16_t>(std::lround(v_N.x() * 100));
    position.vy = static_cast<std::int16_t>(std::lround(v_N.y() * 100));
    position.vz = static_cast<std::int16_t>(std::lround(v_N.z() * 100));
    out_.send(1, position);
  }

  std::pair<std::int32_t, std::int32_t> scaled(const Vec3& p) const {
    const geo::Geodetic at = frame_.from_plane(geo::horizontal(p));
    return {static_cast<std::int32_t>(std::lround(at.latitude_deg * 1e7)),
            static_cast<std::int32_t>(std::lround(at.longitude_deg * 1e7))};
  }

  void take(const mavlink::Timesync& m) {
    if (m.tc1 != 0 || faults.no_timesync) return;
    mavlink::Timesync answer;
    constexpr double kTimeOfDay = 1.8e9;
    answer.tc1 = faults.time_of_day ? (s(kTimeOfDay) + now).ns() : boot_time().ns();
    answer.ts1 = m.ts1;
    out_.send(1, answer);
  }

  void answer(std::uint16_t command, std::uint8_t result) {
    mavlink::CommandAck ack;
    ack.command = command;
    ack.result = result;
    if (result == kDenied && !faults.refusal.empty()) {
      mavlink::Statustext text;
      text.severity = 3;
      mavlink::set_text(text.text, faults.refusal);
      out_.send(1, text);
    }
    if (!chance(faults.ack_loss)) out_.send(1, ack);
  }

  void take(const mavlink::CommandInt& m) {
    mavlink::CommandLong command;
    command.command = m.command;
    command.param1 = m.param1;
    command.param2 = m.param2;
    command.param3 = m.param3;
    command.param4 = m.param4;
    command.param7 = m.z;
    take(command);
  }

  void take(const mavlink::CommandLong& m) {
    ++commands[m.command];
    if (deaf() || chance(faults.command_loss)) return;
    const bool refused = faults.refuses.contains(m.command);
    const std::uint32_t mode_before = custom_mode_;
    const bool armed_before = armed;
    const bool accepted = !refused && obey(m);
    // What was under way when the mode was changed could not be stopped.
    const bool changed = custom_mode_ != mode_before || armed != armed_before;
    if (changed && changed_at_ && m.confirmation > 0 && now - *changed_at_ > s(0.1))
      ++overridden;
    if (changed && changed_at_ && m.confirmation == 0 && now - *changed_at_ < s(1.2))
      ++crossed;
    answer(m.command, accepted ? kAccepted : kDenied);
  }

  // Whether it accepts the command.
  bool obey(const mavlink::CommandLong& m) {
    switch (m.command) {
      case 176: {
        const auto number = ardupilot() ? static_cast<std::uint32_t>(m.param2)
                                        : static_cast<std::uint32_t>(m.param2) << 16 |
                                              static_cast<std::uint32_t>(m.param3) << 24;
        const VehicleMode to = mavlink::mode_of(make_, true, number);
        if (to == VehicleMode::kOther) return false;
        // Offboard needs setpoints that come in already.
        if (!ardupilot() && to == VehicleMode::kGuided && now - heard_setpoint_ > s(0.5))
          return false;
        if (faults.keeps_mode || from(faults.keeps_mode_at)) return true;
        if (to != mode()) goal_.reset();
        set_mode(number);
        return true;
      }
      case 400:
        if (m.param1 > 0.5F) ++arms;
        if (m.param1 < 0.5F && !on_ground() && m.param2 < 1) return false;
        armed = m.param1 > 0.5F;
        return true;
      case 22:
        if (!armed || (ardupilot() && mode() != VehicleMode::kGuided)) return false;
        ++take_offs;
        climb_to_ = ardupilot() ? home_.z() - static_cast<double>(m.param7)
                                : -static_cast<double>(m.param7);
        if (ardupilot())
          goal_ = Vec3(p_N.x(), p_N.y(), climb_to_);
        else
          set_mode(4U << 16 | 2U << 24);
        return true;
      case 511:
      case 512:
        return true;
      default:
        return false;
    }
  }

  void take(const mavlink::SetPositionTargetGlobalInt& m) {
    if (deaf()) return;
    heard_setpoint_ = now;
    if (faults.ignores_setpoints || mode() != VehicleMode::kGuided || !armed ||
        on_ground())
      return;
    last_setpoint = now;
    ++setpoints;
    const Vec2 place = frame_.to_plane(m.lat_int * 1e-7, m.lon_int * 1e-7);
    // It flies by its own estimate.
    const Vec3 off = believed() - p_N;
    goal_ = Vec3(place.x(), place.y(), -static_cast<double>(m.alt)) - off;
  }

  bool chance(double probability) {
    return probability > 0 &&
           std::uniform_real_distribution<double>()(random_) < probability;
  }

  Make make_;
  const geo::LocalFrame& frame_;
  std::vector<std::vector<std::byte>> sent_;
  vehicle_services::Outbox out_;
  Vec3 home_;
  std::uint32_t custom_mode_ = 0;
  std::optional<Vec3> goal_;
  double climb_to_ = 0;
  Time heard_setpoint_ = s(-1000);
  std::map<std::string, Time> due_;
  std::optional<Time> changed_at_;  // its mode, by someone else
  std::mt19937 random_{faults.seed};
};

}  // namespace skein::mixed::fake
