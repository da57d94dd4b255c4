// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/guidance/landing.h"

#include <algorithm>
#include <cmath>

#include "skein/base/math.h"
#include "skein/data/vehicle/air.h"
#include "skein/model/path/dubins.h"

namespace skein::autopilot {
namespace {

constexpr double kCalm = 0.5;      // wind that gives no direction [m/s]
constexpr double kRollOut = 1000;  // of line beyond the point [m]
constexpr double kStillTime = 1;   // at rest for this long: landed [s]
// Drag at the slowest airspeed over that at cruise, where much of it falls with speed.
constexpr double kSlowDrag = 0.75;
constexpr double kMinIdle = 0.03;       // slope, however little is known [rad]
constexpr double kSlowDownShare = 0.7;  // of the idle deceleration that is planned with
constexpr double kMinPace = 3;          // over ground, of an approach [m/s]
constexpr double kMeasuredBelow = 20;   // the measured height counts [m]: from half of
                                        // this down all of it
constexpr double kLow = 15;  // the slope is met again gently from below this height [m]:
constexpr double kMaxAbove = 1, kMaxBelow = 1.5;  // errors that are worked off [m]
constexpr double kLowGain = 0.5;  // sink per height above the slope in the flare [1/s]
constexpr double kBalloon = 0.7;  // above the height at which the flare began [m]
// The ground is felt when it sinks less than this [m/s], this low [m], for a while [s]:
// longer where no height is measured.
constexpr double kFeltSink = 0.2;
constexpr double kFeltHeight = 0.3;
constexpr double kFeltTime = 0.3, kGuessedTime = 1;
constexpr double kMinDistance = 0.5;  // to brake on [m]

}  // namespace

double roll_out(double airspeed, double head_wind, const Stopping& s) {
  const double pace = airspeed - head_wind;
  const auto seconds = [&](double speed) {  // V / -V'
    const double air2 = (speed + head_wind) * (speed + head_wind);
    const double pressed = std::max(1 - air2 / (s.lift_off * s.lift_off), 0.0);
    return speed /
           (kGravity * (s.friction * pressed + s.drag * air2 / (airspeed * airspeed)));
  };
  constexpr int kParts = 20;
  const double h = pace / kParts;
  double sum = seconds(pace);
  for (int k = 0; k < kParts; ++k)
    sum += (k == 0 ? 1 : 2) * seconds(k * h) + 4 * seconds((k + 0.5) * h);
  return sum * h / 6;
}

void Landing::begin(const Land& command, const model::Pose& from, const Vec2& wind,
                    double radius, const FlightLimits& limits,
                    const LandingOptions& options) {
  options_ = options;
  command_ = command;
  radius_ = radius;
  phase_ = FlightPhase::kFlight;
  still_for_ = 0;
  idle_ = false;
  const Vec2 leg = command.point - from.position;
  course_ = command.course        ? *command.course
            : wind.norm() > kCalm ? geo::bearing(-wind)
            : leg.norm() > 1      ? geo::bearing(leg)
                                  : from.course;
  const double cruise = limits.airspeed;
  airspeed_ = std::max(
      std::min(options.airspeed * limits.slowest + options.wind_share * wind.norm(),
               cruise),
      limits.slowest);
  const double head_wind = -wind.dot(geo::unit(course_));
  const double pace = std::max(airspeed_ - head_wind, kMinPace);
  const double idle = std::max(limits.sink_rate / cruise, kMinIdle);
  tangent_ = std::min(math::tan(options.glide_slope),
                      options.idle_share * idle * airspeed_ / pace);

  // Level flight from cruise to the airspeed of the approach: V dV = a dx.
  const double braking = kSlowDownShare * kGravity * idle;
  const double mean = (cruise + airspeed_) / 2;
  const double slow_down =
      (cruise - airspeed_) / braking * std::max(mean - head_wind, 0.);
  const double lead_in = options.lead_in * std::max(cruise - head_wind, kMinPace);

  stop_distance_ = 0;
  if (options.touches_down) {
    // The flare, with a sink that falls evenly with the height, takes longer than the
    // straight path down; motor idle the aircraft slows down meanwhile.
    const double sink = std::max(pace * tangent_, options.touch_down_sink);
    const double ratio = sink / options.touch_down_sink;
    const double longer = ratio > 1.01 ? math::log(ratio) / (1 - 1 / ratio) : 1;
    const double slowing = kSlowDrag * idle * kGravity * options.flare_time * longer;
    const double touch = std::max(airspeed_ - slowing, head_wind + kMinPace);
    stop_distance_ =
        options.flare_time * ((longer - 1) * pace - longer * slowing / 2) +
        roll_out(
            touch, head_wind,
            {options.roll_friction + options.brake_share * options.brake_friction,
             kSlowDrag * idle, options.lift_off > 0 ? options.lift_off : limits.slowest});
  }
  fix_ =
      command.point - (options.height / tangent_ + lead_in + slow_down + stop_distance_) *
                          geo::unit(course_);
  line_up(model::to_path(model::dubins(from, {fix_, course_}, radius), from));
}

void Landing::line_up(const Path& before) {
  Path path = before;
  joined_at_ = 0;
  for (const PathElement& e : before) joined_at_ += e.length;
  const double line = (command_.point - fix_).norm();
  path.push_back({fix_, course_, line + kRollOut, 0});
  rest_at_ = joined_at_ + line;
  touch_at_ = rest_at_ - stop_distance_;
  path_.assign(path);
  along_ = 0;
}

double Landing::height_of(const View& now) const {
  // Altitudes are off by metres, the height by centimetres: but that over other ground in
  // between says nothing.
  const double height = now.altitude_msl - command_.ground_msl;
  if (!now.height_agl) return height;
  const double share = std::clamp(2 - 2 * *now.height_agl / kMeasuredBelow, 0.0, 1.0);
  return height + share * (*now.height_agl - height);
}

void Landing::feel_ground(const View& now, double height, double dt) {
  if (phase_ == FlightPhase::kRollOut) {
    if (now.height_agl && height > kBalloon) {
      phase_ = FlightPhase::kFlare;  // thrown up by a gust
      felt_for_ = 0;
    }
    return;
  }
  // It sinks no longer, although it shall.
  const bool felt = phase_ == FlightPhase::kFlare && idle_ &&
                    std::abs(now.climb_rate) < kFeltSink &&
                    (!now.height_agl || height < kFeltHeight);
  felt_for_ = felt ? felt_for_ + dt : 0;
  if (felt_for_ >= (now.height_agl ? kFeltTime : kGuessedTime))
    phase_ = FlightPhase::kRollOut;
}

Landing::Step Landing::step(const View& now, double dt) {
  const double window = std::max(3 * now.ground_speed, 10.0);
  Step out;
  out.place = path_.project(now.p, along_ - window, along_ + 5 * window);
  along_ = out.place.along;
  const double height = height_of(now);
  if (phase_ == FlightPhase::kFlight && along_ >= joined_at_) {
    if (height > options_.height + options_.too_high) {
      // One circle in line with the approach.
      line_up({{fix_, course_, 2 * geo::kPi * radius_, 1 / radius_}});
      out.place = path_.project(now.p, 0, window);
      along_ = out.place.along;
    } else {
      phase_ = FlightPhase::kApproach;
    }
  }
  descend(now, height, out);
  // Also without a flare: the ground may have come before the estimate of it.
  if (phase_ != FlightPhase::kFlight) {
    feel_ground(now, height, dt);
    still_for_ = now.still ? still_for_ + dt : 0;
    if (still_for_ >= kStillTime) phase_ = FlightPhase::kGround;
  }
  out.place.remaining = std::max(rest_at_ - along_, 0.0);
  out.aligns =
      options_.align_height > 0 &&
      (phase_ == FlightPhase::kRollOut ||
       (phase_ == FlightPhase::kFlare && idle_ && height < options_.align_height));
  if (phase_ == FlightPhase::kRollOut)
    out.braking = now.ground_speed * now.ground_speed /
                  (2 * std::max(out.place.remaining, kMinDistance));
  if (phase_ == FlightPhase::kGround) {
    out.altitude_msl = now.altitude_msl;
    out.climb_rate = 0;
    out.done = true;
  }
  out.airspeed = idle_ && phase_ != FlightPhase::kApproach ? 0 : airspeed_;
  out.phase = phase_;
  return out;
}

void Landing::descend(const View& now, double height, Step& out) {
  const double to_go = touch_at_ - along_;
  const double slope_height = to_go * tangent_;
  const bool on_slope = slope_height < options_.height;
  const double sink = std::max(now.ground_speed * tangent_, options_.touch_down_sink);
  if (phase_ == FlightPhase::kApproach && !options_.touches_down &&
      height <= options_.floor)
    out.done = true;
  if (options_.touches_down) {
    if (phase_ == FlightPhase::kApproach && height <= options_.sink_height) {
      phase_ = FlightPhase::kFlare;
      idle_ = false;
    }
    if (phase_ == FlightPhase::kFlare && !idle_ && height <= options_.flare_time * sink) {
      idle_ = true;
      flare_sink_ = sink;
      flare_height_ = options_.flare_time * sink;
    } else if (idle_ && height > flare_height_ + kBalloon) {
      idle_ = false;  // thrown up by a gust: not without motor from there
    }
  }

  double setpoint = options_.height;
  if (phase_ == FlightPhase::kApproach && on_slope) {
    setpoint = slope_height;
    if (height < kLow)
      setpoint = std::clamp(setpoint, height - kMaxAbove, height + kMaxBelow);
    out.climb_rate = -sink;
  } else if (phase_ == FlightPhase::kFlare && !idle_) {
    // Sink rate alone, with what little leads back to the slope.
    const double above = std::clamp(height - slope_height, -kMaxBelow, kMaxAbove);
    setpoint = height;
    out.climb_rate = std::min(-sink - kLowGain * above, 0.0);
  } else if (phase_ == FlightPhase::kFlare || phase_ == FlightPhase::kRollOut) {
    const double share = std::clamp(height / flare_height_, 0.0, 1.0);
    setpoint = height;
    out.climb_rate =
        -(options_.touch_down_sink + share * (flare_sink_ - options_.touch_down_sink));
  }
  // In terms of the altitude that control holds.
  out.altitude_msl = now.altitude_msl + setpoint - height;
}

}  // namespace skein::autopilot
