// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/fire/front_fire.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

namespace skein::environment {
namespace {

constexpr int kIgnitionPoints = 48;

geo::Ring circle(const Ignition& ignition) {
  geo::Ring ring;
  for (int i = 0; i < kIgnitionPoints; ++i)
    ring.push_back(ignition.point +
                   ignition.radius * geo::unit(2 * geo::kPi * i / kIgnitionPoints));
  return ring;
}

const FrontFireOptions& checked(const FrontFireOptions& options) {
  const Result<void> valid = check(options);
  SKEIN_CHECK(valid.ok(), valid.error().text());
  return options;
}

}  // namespace

Result<void> check(const FrontFireOptions& options) {
  const auto bad = [](std::string name, double value, const char* allowed) {
    return Error{ErrorCode::kBadInput, std::move(name),
                 fmt::format("{} must be {}", value, allowed), ""};
  };
  if (Result<void> spread = check(options.spread); !spread) return spread.error();
  if (options.spread.rate > 20) return bad("rate", options.spread.rate, "at most 20 m/s");
  if (Result<void> front = check(options.front); !front) return front.error();
  if (!(options.age >= 0 && options.age <= 30 * 86400.0))
    return bad("age", options.age, "0 s to 30 days");
  if (!(options.wind_height >= 0 && options.wind_height <= 1000))
    return bad("wind_height", options.wind_height, "0 to 1000 m");
  for (std::size_t i = 0; i < options.ignitions.size(); ++i) {
    const Ignition& ignition = options.ignitions[i];
    const auto key = [&](const char* name) {
      return fmt::format("ignitions[{}].{}", i, name);
    };
    if (!(ignition.point.allFinite() && ignition.point.norm() < 1e6))
      return bad(key("point"), ignition.point.norm(), "within 1000 km");
    // Below a tenth of the spacing the markers of a circle would fall together.
    if (!(ignition.radius >= 0.1 * options.front.spacing && ignition.radius < 1e5))
      return bad(key("radius"), ignition.radius,
                 "between a tenth of the spacing and 100 km");
    if (!(ignition.delay >= 0 && ignition.delay < 1e9))
      return bad(key("delay"), ignition.delay, "0 s to 1e9 s");
  }
  for (const geo::Ring& ring : options.start)
    for (const Vec2& p : ring)
      if (!(p.allFinite() && p.norm() < 1e6))
        return bad("start", p.norm(), "within 1000 km");
  if (options.ignitions.empty() && options.start.empty())
    return Error{ErrorCode::kBadInput, "ignitions", "nothing ever burns",
                 "give an ignition or a start region"};
  return {};
}

FrontFire::Field::Field(const FrontFireOptions& options, const Terrain& terrain,
                        const WindField& wind, std::shared_ptr<const FuelField> fuel)
    : law_(options.spread),
      wind_height_(options.wind_height),
      terrain_(terrain),
      wind_(wind),
      fuel_(std::move(fuel)) {}

void FrontFire::Field::wavelets(std::span<const Vec2> points, double time,
                                std::span<model::Wavelet> out) const {
  const Time now = Time::from_seconds(std::max(time, 0.0));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2& p = points[i];
    const Vec3 above(p.x(), p.y(), -terrain_.elevation_msl(p) - wind_height_);
    const Vec2 wind = geo::horizontal(wind_.wind(above, now));
    out[i] = model::spread_wavelet(law_, wind, terrain_.gradient(p),
                                   fuel_ ? fuel_->factor(p) : 1.0);
  }
}

FrontFire::FrontFire(const FrontFireOptions& options, const Terrain& terrain,
                     const WindField& wind, std::shared_ptr<const FuelField> fuel)
    : age_(checked(options).age),
      waiting_(options.ignitions),
      field_(options, terrain, wind, std::move(fuel)),
      front_(options.start, options.front, -options.age) {
  std::stable_sort(
      waiting_.begin(), waiting_.end(),
      [](const Ignition& a, const Ignition& b) { return a.delay > b.delay; });
  advance(Time());
}

void FrontFire::advance(Time time) {
  const double until = time.seconds();
  bool changed = false;
  for (;;) {
    const double next = front_.next_time(field_);
    const double lit = waiting_.empty() ? std::numeric_limits<double>::infinity()
                                        : waiting_.back().delay - age_;
    if (lit <= std::min(until, next)) {
      front_.advance(field_, std::max(lit, front_.time()));
      front_.ignite({circle(waiting_.back())});
      waiting_.pop_back();
    } else if (next <= until) {
      front_.step(field_);
    } else {
      break;
    }
    changed = true;
  }
  if (changed) lookup_.reset();
}

}  // namespace skein::environment
