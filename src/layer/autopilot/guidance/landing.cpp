#include "layer/autopilot/guidance/landing.h"

#include <algorithm>
#include <cmath>

#include "model/path/dubins.h"

namespace skein::autopilot {
namespace {

constexpr double kCalm = 0.5;      // wind that gives no direction [m/s]
constexpr double kRollOut = 1000;  // of line beyond the point [m]
constexpr double kStillTime = 1;   // at rest for this long: landed [s]

}  // namespace

void Landing::begin(const Land& command, const model::Pose& from, const Vec2& wind,
                    double ground_speed, double radius, const LandingOptions& options) {
  options_ = options;
  command_ = command;
  radius_ = radius;
  tangent_ = std::tan(options.glide_slope);
  phase_ = FlightPhase::kFlight;
  still_for_ = 0;
  const Vec2 way = command.point - from.position;
  course_ = command.course        ? *command.course
            : wind.norm() > kCalm ? geo::bearing(-wind)
            : way.norm() > 1      ? geo::bearing(way)
                                  : from.course;
  fix_ = command.point - (options.height / tangent_ + options.lead_in * ground_speed) *
                             geo::unit(course_);
  line_up(model::to_path(model::dubins(from, {fix_, course_}, radius), from));
}

void Landing::line_up(const Path& before) {
  Path path = before;
  joined_at_ = 0;
  for (const PathElement& e : before) joined_at_ += e.length;
  const double line = (command_.point - fix_).norm();
  path.push_back({fix_, course_, line + kRollOut, 0});
  touch_at_ = joined_at_ + line;
  path_.assign(path);
  along_ = 0;
}

Landing::Step Landing::step(const Vec2& p, double height, double ground_speed, bool still,
                            double dt) {
  const double window = std::max(3 * ground_speed, 10.0);
  Step out;
  out.place = path_.project(p, along_ - window, along_ + 5 * window);
  along_ = out.place.along;
  if (phase_ == FlightPhase::kFlight && along_ >= joined_at_) {
    if (height > options_.height + options_.too_high) {
      // Once round in line with the approach.
      line_up({{fix_, course_, 2 * geo::kPi * radius_, 1 / radius_}});
      out.place = path_.project(p, 0, window);
      along_ = out.place.along;
    } else {
      phase_ = FlightPhase::kApproach;
    }
  }
  const double to_go = touch_at_ - along_;
  // After the landing point the slope would lead into the ground: the flare's sink does.
  const double slope_height = std::max(to_go * tangent_, 0.0);
  const bool on_slope = slope_height < options_.height;
  const double sink = ground_speed * tangent_;
  if (phase_ == FlightPhase::kApproach && !options_.touches_down &&
      height <= options_.floor)
    out.done = true;
  if (phase_ == FlightPhase::kApproach && options_.touches_down &&
      height <= options_.flare_height) {
    phase_ = FlightPhase::kFlare;
    flare_sink_ = std::max(sink, options_.touch_down_sink);
  }

  out.altitude_msl =
      command_.ground_msl +
      (phase_ == FlightPhase::kFlight || !on_slope ? options_.height : slope_height);
  out.climb_rate = phase_ == FlightPhase::kApproach && on_slope && to_go > 0 ? -sink : 0;
  if (phase_ == FlightPhase::kFlare) {
    const double share = std::clamp(height / options_.flare_height, 0.0, 1.0);
    out.altitude_msl = command_.ground_msl + std::max(height, 0.0);
    out.climb_rate =
        -(options_.touch_down_sink + share * (flare_sink_ - options_.touch_down_sink));
  }
  // Also without a flare: the ground may have come before the estimate of it.
  if (phase_ != FlightPhase::kFlight) {
    still_for_ = still ? still_for_ + dt : 0;
    if (still_for_ >= kStillTime) phase_ = FlightPhase::kGround;
  }
  if (phase_ == FlightPhase::kGround) {
    out.altitude_msl = command_.ground_msl;
    out.done = true;
  }
  out.phase = phase_;
  out.place.remaining = std::max(to_go, 0.0);
  return out;
}

}  // namespace skein::autopilot
