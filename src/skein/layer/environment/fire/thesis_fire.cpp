// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/fire/thesis_fire.h"

#include <algorithm>

#include <fmt/format.h>

#include "skein/geo/clip.h"

namespace skein::environment {
namespace {

constexpr double kLongestEdge = 1.5;  // of the mean edge that the asked number would have
constexpr std::size_t kMaxPoints = 8;  // times the asked number

BearingProfile make_shape(const ThesisFireOptions& o, std::uint64_t seed) {
  RandomStream random(seed, 0, Purpose::kFireShape);
  return BearingProfile::harmonics(o.displacement_harmonics, o.displacement,
                                   o.harmonic_decay, random);
}

BearingProfile make_rate(const ThesisFireOptions& o, std::uint64_t seed) {
  RandomStream random(seed, 0, Purpose::kFireRate);
  if (o.rate_sectors > 0)
    return BearingProfile::sectors(o.rate_sectors, o.rate_error, random);
  return BearingProfile::harmonics(o.rate_harmonics, o.rate_error, o.harmonic_decay,
                                   random);
}

}  // namespace

Result<void> check(const ThesisFireOptions& o) {
  const auto bad = [](const char* name, double value, const std::string& allowed) {
    return Error{ErrorCode::kBadInput, name, fmt::format("{} must be {}", value, allowed),
                 ""};
  };
  if (!(o.origin.allFinite() && o.origin.norm() < 1e6))
    return bad("origin", o.origin.norm(), "within 1000 km");
  if (o.points < 8 || o.points > 100000) return bad("points", o.points, "8 to 100000");
  if (!(o.start_radius > 0 && o.start_radius < 1e6))
    return bad("start_radius", o.start_radius, "above 0, below 1000 km");
  if (!(o.displacement >= 0)) return bad("displacement", o.displacement, "0 or above");
  if (o.displacement_harmonics < 0 || o.displacement_harmonics > 1000)
    return bad("displacement_harmonics", o.displacement_harmonics, "0 to 1000");
  if (o.displacement_harmonics > 0 && !(o.displacement < o.start_radius))
    return bad("displacement", o.displacement,
               fmt::format("below the start radius {}", o.start_radius));
  if (!(o.rate >= 0 && o.rate <= 100)) return bad("rate", o.rate, "0 to 100 m/s");
  if (!(o.rate_error >= 0 && o.rate_error <= o.rate))
    return bad("rate_error", o.rate_error, fmt::format("0 to the rate {}", o.rate));
  if (o.rate_harmonics < 0 || o.rate_harmonics > 1000)
    return bad("rate_harmonics", o.rate_harmonics, "0 to 1000");
  if (o.rate_sectors < 0 || o.rate_sectors > 100000)
    return bad("rate_sectors", o.rate_sectors, "0 to 100000");
  if (!(o.harmonic_decay >= 0 && o.harmonic_decay <= 10))
    return bad("harmonic_decay", o.harmonic_decay, "0 to 10");
  if (!o.wind.allFinite()) return bad("wind", o.wind.norm(), "finite");
  const double min = o.rate - o.rate_error;
  if (o.wind.norm() > 0 && !(o.wind.norm() < min))
    return bad("wind", o.wind.norm(),
               fmt::format(
                   "below the minimum spread, {} m/s: a stronger one drives the boundary "
                   "over its own origin",
                   min));
  if (!(std::abs(o.slope_weight) <= 1))
    return bad("slope_weight", o.slope_weight, "-1 to 1");
  if (!(o.step >= 0.01 && o.step <= 60)) return bad("step", o.step, "0.01 to 60 s");
  return {};
}

ThesisFire::ThesisFire(const ThesisFireOptions& options, std::uint64_t seed,
                       const Terrain& terrain)
    : options_(options), terrain_(terrain) {
  const Result<void> valid = check(options);
  SKEIN_CHECK(valid.ok(), valid.error().text());
  shape_ = make_shape(options, seed);
  rate_ = make_rate(options, seed);
  for (int i = 0; i < options_.points; ++i)
    points_.push_back(start_point(2 * geo::kPi * i / options_.points));
  update_region(0);
}

double ThesisFire::start_radius(double bearing) const {
  return options_.start_radius + shape_.at(geo::unit(bearing));
}

double ThesisFire::rate(double bearing) const {
  return options_.rate + rate_.at(geo::unit(bearing));
}

ThesisFire::Point ThesisFire::start_point(double bearing) const {
  return {bearing, options_.origin + start_radius(bearing) * geo::unit(bearing)};
}

Vec2 ThesisFire::velocity(const Vec2& p) const {
  const Vec2 from_origin = p - options_.origin;
  const double distance = from_origin.norm();
  if (!(distance > 0)) return options_.wind;  // no bearing there
  const Vec2 out = from_origin / distance;
  double rate = options_.rate + rate_.at(out);
  if (options_.slope_weight != 0)
    rate *=
        1 + options_.slope_weight * std::clamp(terrain_.gradient(p).dot(out), -1.0, 1.0);
  return rate * out + options_.wind;
}

void ThesisFire::move(Vec2& p, double dt) const {
  const Vec2 k1 = velocity(p);
  const Vec2 k2 = velocity(p + dt / 2 * k1);
  const Vec2 k3 = velocity(p + dt / 2 * k2);
  const Vec2 k4 = velocity(p + dt * k3);
  p += dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
}

void ThesisFire::advance(Time time) {
  const Time step = Time::from_seconds(options_.step);
  if (time == shown_) return;
  while (step * (steps_ + 1) <= time) {
    for (Point& point : points_) move(point.p, options_.step);
    ++steps_;
    if (options_.respace) add_points();
  }
  shown_ = time;
  update_region((time - step * steps_).seconds());
}

void ThesisFire::add_points() {
  const auto edge = [&](std::size_t i) -> Vec2 {
    return points_[(i + 1) % points_.size()].p - points_[i].p;
  };
  double length = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) length += edge(i).norm();
  const double longest = kLongestEdge * length / options_.points;
  // Between two sectors of different rates the boundary has a jump that no number of
  // points fills: stop at a thirtieth of the first spacing.
  const double finest = 2 * geo::kPi / options_.points / 30;

  std::vector<Point> added;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (edge(i).norm() <= longest) continue;
    const double from = points_[i].bearing;
    const double to = i + 1 < points_.size() ? points_[i + 1].bearing : 2 * geo::kPi;
    if (to - from < 2 * finest) continue;
    Point point = start_point((from + to) / 2);
    for (std::int64_t k = 0; k < steps_; ++k) move(point.p, options_.step);
    added.push_back(point);
  }
  const auto max = kMaxPoints * static_cast<std::size_t>(options_.points);
  if (added.empty() || points_.size() + added.size() > max) return;
  points_.insert(points_.end(), added.begin(), added.end());
  std::sort(points_.begin(), points_.end(),
            [](const Point& a, const Point& b) { return a.bearing < b.bearing; });
}

// The region `since` [s] after the last whole step.
void ThesisFire::update_region(double since) {
  region_.assign(1, {});
  geo::Ring& ring = region_[0];
  ring.reserve(points_.size());
  for (const Point& point : points_) {
    ring.push_back(point.p);
    if (since > 0) move(ring.back(), since);
  }
  // A ring whose points follow each other clockwise around the origin, once, cannot cross
  // itself.
  bool star = true;
  int turns = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 a = ring[i] - options_.origin,
               b = ring[(i + 1) % ring.size()] - options_.origin;
    star = star && geo::cross(a, b) > 0;
    if (a.y() < 0 && b.y() >= 0) ++turns;
  }
  if (!star || turns != 1) region_ = geo::clean(region_, geo::FillRule::kPositive);
  lookup_.reset();
}

}  // namespace skein::environment
