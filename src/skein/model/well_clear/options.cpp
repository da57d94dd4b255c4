// SPDX-License-Identifier: Apache-2.0
#include "skein/model/well_clear/options.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "skein/base/math.h"

namespace skein::model {
namespace {

double horizontal_speed(const OwnMotion& own) {
  return std::sqrt(own.vx * own.vx + own.vy * own.vy);
}

// Steps of `size` that cover `length`, which may be negative.
std::size_t steps_over(double length, double size) {
  return static_cast<std::size_t>(std::ceil(std::max(0.0, length / size)));
}

// Whether a level change is within the volume at a whole second of a part of it.
struct StepScan {
  const WellClearVolume& volume;
  const IntruderMotion& intruder;
  const OwnMotion& own;
  double horizon;

  void scan(const LevelChange& change, double from, double until, bool and_until,
            OptionSpan& into) const {
    for (double t = from; t < horizon && (t < until || (and_until && t <= until));
         t += 1) {
      if (!is_within(volume, relative_motion(own, change.at(t), intruder))) continue;
      into.first_step = std::min(into.first_step, t);
      into.last_step = std::max(into.last_step, t);
    }
  }
};

}  // namespace

double same(double larger) {
  constexpr double kMin = 1e-5;
  return larger == 0 ? kMin : std::max(kMin, std::ldexp(1, std::ilogb(larger) - 12));
}

ManoeuvreOptions::ManoeuvreOptions(const WellClearConfiguration& configuration,
                                   ManoeuvreKind kind)
    : configuration_(&configuration), kind_(kind) {}

void ManoeuvreOptions::start(const OwnMotion& own) {
  own_ = own;
  values_.clear();
  times_.clear();
  steady_times_.clear();
  points_.clear();
  changes_.clear();
  switch (kind_) {
    case ManoeuvreKind::kTrack:
      return start_track();
    case ManoeuvreKind::kSpeed:
      return start_speed();
    case ManoeuvreKind::kVerticalSpeed:
      return start_vertical_speed();
    case ManoeuvreKind::kAltitude:
      return start_altitude();
  }
}

// Values, times and room for the points of steps both ways from the own value.
void ManoeuvreOptions::list_steps(double own, double step, double rate, double min,
                                  double max) {
  own_value_ = own;
  center_ = steps_over(own - min, step);
  const std::size_t count = center_ + steps_over(max - own, step) + 1;
  dt_ = step / rate;
  for (std::size_t i = 0; i < count; ++i) {
    const double k = static_cast<double>(i) - static_cast<double>(center_);
    values_.push_back(own + k * step);
    times_.push_back(std::abs(k) * dt_);
  }
  points_.resize(count);
  steady_times_.resize(count, 0);
}

void ManoeuvreOptions::find_ranges(double min, double max) {
  lowest_ = min;
  highest_ = max;
  first_range_ = 0;
  end_of_ranges_ = values_.size() - 1;
  while (first_range_ + 1 < end_of_ranges_ &&
         values_[first_range_ + 1] - min <= same(min))
    ++first_range_;
  while (first_range_ + 1 < end_of_ranges_ &&
         max - values_[end_of_ranges_ - 1] <= same(max))
    --end_of_ranges_;
}

void ManoeuvreOptions::start_track() {
  const auto& limits = configuration_->track;
  const double pi = std::numbers::pi;
  const double speed = horizontal_speed(own_);
  const double course = math::atan2(own_.vy, own_.vx);
  // Half a turn is a whole number of steps, but for rounding.
  const double half = pi - limits.step / 4;
  list_steps(course, limits.step, limits.turn_rate, course - half, course + half);
  find_ranges(values_.front(), values_.back());
  const double c = math::cos(limits.step), s = math::sin(limits.step);
  const double radius = speed / limits.turn_rate;
  const double vx = speed > 0 ? own_.vx : 0, vy = speed > 0 ? own_.vy : 0;
  for (const double side : {-1.0, 1.0}) {
    double ux = vx, uy = vy;  // the velocity, turned step by step
    for (std::size_t k = 0; k <= center_; ++k) {
      const std::size_t at = side < 0 ? center_ - k : center_ + k;
      const double t = times_[at];
      const double scale = speed > 0 ? side * radius / speed : 0;
      points_[at] = {t,      scale * (uy - vy), scale * (vx - ux), own_.vz * t, ux, uy,
                     own_.vz};
      const double turned = c * ux - side * s * uy;
      uy = side * s * ux + c * uy;
      ux = turned;
    }
  }
}

void ManoeuvreOptions::start_speed() {
  const auto& limits = configuration_->speed;
  const double speed = horizontal_speed(own_);
  const double ex = speed > 0 ? own_.vx / speed : 1, ey = speed > 0 ? own_.vy / speed : 0;
  list_steps(speed, limits.step, limits.accel, limits.min, limits.max);
  find_ranges(limits.min, limits.max);
  for (std::size_t i = 0; i < count(); ++i) {
    const double t = times_[i], to = values_[i];
    const double way = (speed + to) / 2 * t;
    points_[i] = {t, ex * way, ey * way, own_.vz * t, ex * to, ey * to, own_.vz};
  }
}

void ManoeuvreOptions::start_vertical_speed() {
  const auto& limits = configuration_->vertical_speed;
  list_steps(own_.vz, limits.step, limits.accel, limits.min, limits.max);
  find_ranges(limits.min, limits.max);
  for (std::size_t i = 0; i < count(); ++i) {
    const double t = times_[i], to = values_[i];
    points_[i] = {t,       own_.vx * t, own_.vy * t, (own_.vz + to) / 2 * t,
                  own_.vx, own_.vy,     to};
  }
}

void ManoeuvreOptions::start_altitude() {
  const auto& limits = configuration_->altitude;
  constexpr double kRounding = 1e-9;  // of a step
  const std::size_t steps =
      steps_over(limits.max - limits.min - kRounding * limits.step, limits.step);
  own_value_ = own_.z;
  dt_ = 1;
  for (std::size_t k = 0; k <= steps; ++k) {
    const double to = limits.min + static_cast<double>(k) * limits.step;
    const LevelChange& change = changes_.emplace_back(own_, limits, to);
    const double t = change.level_at() + dt_;
    values_.push_back(to);
    times_.push_back(t);
    steady_times_.push_back(change.steady_from());
    points_.push_back(change.at(t));
  }
  find_ranges(limits.min, limits.max);
}

void ManoeuvreOptions::survey(const WellClearVolume& volume,
                              const IntruderMotion& intruder, double horizon,
                              StepRule rule, std::span<OptionSpan> spans) const {
  if (kind_ == ManoeuvreKind::kAltitude)
    survey_altitudes(volume, intruder, horizon, spans);
  else
    survey_steps(volume, intruder, horizon, rule, spans);
}

void ManoeuvreOptions::survey_steps(const WellClearVolume& volume,
                                    const IntruderMotion& intruder, double horizon,
                                    StepRule rule, std::span<OptionSpan> spans) const {
  for (const bool down : {true, false}) {
    OptionSpan on_way;
    const std::size_t steps = down ? center_ : count() - 1 - center_;
    for (std::size_t k = 0; k <= steps; ++k) {
      const std::size_t at = down ? center_ - k : center_ + k;
      const double t = times_[at];
      const RelativeMotion motion = relative_motion(own_, points_[at], intruder);
      const ConflictSpan span = conflict_span(volume, motion, horizon - t);
      const bool within = rule == StepRule::kUntilNext ? span.conflict() && span.in < dt_
                                                       : is_within(volume, motion);
      if (within) {
        on_way.first_step = std::min(on_way.first_step, t);
        on_way.last_step = t;
      }
      on_way.straight = {t + span.in, t + span.out};
      spans[at] = on_way;
    }
  }
}

void ManoeuvreOptions::survey_altitudes(const WellClearVolume& volume,
                                        const IntruderMotion& intruder, double horizon,
                                        std::span<OptionSpan> spans) const {
  const StepScan steps{volume, intruder, own_, horizon};
  // What all changes with a steady part in one direction have in common.
  const LevelChange* common[2] = {nullptr, nullptr};
  OptionSpan begin[2];
  for (std::size_t i = 0; i < count(); ++i) {
    const LevelChange& change = changes_[i];
    const double from = change.steady_from(), until = change.steady_until();
    OptionSpan option;
    if (until > from) {
      const bool up = change.at(from).vz > 0;
      if (!common[up]) {
        common[up] = &change;
        steps.scan(change, 0, from, false, begin[up]);
        ManoeuvrePoint p = change.at(from);
        const ConflictSpan span =
            conflict_span(volume, relative_motion(own_, p, intruder), horizon - from);
        begin[up].steady = {from + span.in, from + span.out};
      }
      option = begin[up];
      if (until >= horizon) {
        spans[i] = option;
        continue;
      }
      option.steady.out = std::min(option.steady.out, until);
    } else {
      steps.scan(change, 0, from, false, option);
    }
    steps.scan(change, std::ceil(until), change.level_at() + 1, true, option);
    const double t = times_[i];
    const ConflictSpan span =
        conflict_span(volume, relative_motion(own_, points_[i], intruder), horizon - t);
    option.straight = {t + span.in, t + span.out};
    spans[i] = option;
  }
}

}  // namespace skein::model
