// SPDX-License-Identifier: Apache-2.0
// Terrain, wind, phenomena, things on the ground, other traffic and turbulence.
#include <cmath>
#include <optional>

#include "skein/geo/polygon.h"
#include "skein/role/contract/checks.h"
#include "skein/role/moving_object.h"
#include "skein/role/traffic_aircraft.h"
#include "skein/role/turbulence.h"
#include "skein/role/wind_field.h"

namespace skein::contract {

Violations terrain_violations(const Make<Terrain>& make) {
  constexpr int kPoints = 400;
  constexpr double kStep = 0.5;       // of the differences [m]
  constexpr double kRounding = 1e-6;  // of interpolation [m]
  Checks checks;
  const auto terrain = make();
  RandomStream random = draws(1);
  int smooth = 0;
  for (int i = 0; i < kPoints; ++i) {
    const Vec2 p = place_within(random, i % 10 == 0 ? 1e6 : 3000);
    const double height = terrain->elevation_msl(p);
    const Vec2 slope = terrain->gradient(p);
    checks.expect(std::isfinite(height), "elevation_msl() is not finite everywhere");
    checks.expect(slope.allFinite(), "gradient() is not finite everywhere");
    checks.expect(height <= terrain->highest_msl() + kRounding,
                  "somewhere it is higher than highest_msl()");
    checks.expect(height == terrain->elevation_msl(p) && slope == terrain->gradient(p),
                  "the same place has another height or slope when asked again");
    const auto rise = [&](const Vec2& step) {
      return (terrain->elevation_msl(p + step) - terrain->elevation_msl(p - step)) /
             (2 * step.norm());
    };
    const Vec2 measured(rise({kStep, 0}), rise({0, kStep}));
    if ((measured - slope).norm() < 0.01 + 0.02 * measured.norm()) ++smooth;
  }
  // Edges of a raster's cells have two slopes.
  checks.expect(smooth > kPoints * 8 / 10,
                "gradient() is not the slope of elevation_msl()");
  return checks.take();
}

Violations wind_violations(const Make<WindField>& make) {
  Checks checks;
  const auto wind = make();
  RandomStream random = draws(2);
  for (int i = 0; i < 400; ++i) {
    const Vec2 p = place_within(random, i % 10 == 0 ? 1e6 : 3000);
    const Vec3 place(p.x(), p.y(), -random.uniform(-100, 4000));
    const Time time = Time::from_seconds(random.uniform(0, 86400));
    const Vec3 here = wind->wind(place, time);
    checks.expect(here.allFinite(), "wind() is not finite everywhere");
    checks.expect(here == wind->wind(place, time),
                  "the same place and time has another wind when asked again");
  }
  return checks.take();
}

namespace {

// The distance from `p` to the outline of a region [m].
double to_outline(const geo::Region& region, const Vec2& p) {
  double nearest = 1e9;
  for (const geo::Ring& ring : region)
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Vec2& a = ring[k];
      const Vec2 along = ring[(k + 1) % ring.size()] - a;
      const double share =
          along.squaredNorm() > 0
              ? std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0)
              : 0.0;
      nearest = std::fmin(nearest, (p - a - share * along).norm());
    }
  return nearest;
}

void check_region(const geo::Region& region, Checks& checks) {
  for (const geo::Ring& ring : region) {
    checks.expect(ring.size() >= 3, "a ring of region() has fewer than three points");
    for (const Vec2& p : ring)
      checks.expect(p.allFinite(), "region() has points that are not finite");
  }
}

}  // namespace

Violations phenomenon_violations(const Make<Phenomenon>& make) {
  constexpr double kNear =
      5;  // to the outline, where the two descriptions may differ [m]
  Checks checks;
  const auto fire = make(), twin = make();
  RandomStream random = draws(3);
  std::vector<Vec2> places;
  for (int i = 0; i < 300; ++i) places.push_back(place_within(random, 1500));
  std::vector<bool> burnt(places.size(), false);
  for (int step = 0; step <= 20; ++step) {
    const Time now = Time::from_seconds(10.0 * step);
    fire->advance(now);
    if (step % 2 == 0) fire->advance(now);  // no time passes
    twin->advance(now);
    check_region(fire->region(), checks);
    checks.expect(fire->region() == twin->region(), "two equal ones do not burn alike");
    for (std::size_t i = 0; i < places.size(); ++i) {
      const bool inside = fire->inside(places[i]);
      checks.expect(inside || !burnt[i], "what burnt is no longer inside");
      burnt[i] = burnt[i] || inside;
      checks.expect(inside == geo::contains(fire->region(), places[i]) ||
                        to_outline(fire->region(), places[i]) < kNear,
                    "inside() and region() disagree");
    }
  }
  return checks.take();
}

Violations moving_object_violations(const Make<MovingObject>& make) {
  constexpr double kStep = 0.1;  // [s]
  Checks checks;
  const auto one = make(), twin = make();
  RandomStream random = draws(5);
  std::optional<Vec2> before, velocity;
  for (int i = 0; i < 6000; ++i) {
    std::vector<Vec3> aircraft;
    for (int k = 0; k < 3; ++k) {
      const Vec2 p = place_within(random, 1500);
      aircraft.emplace_back(p.x(), p.y(), -100);
    }
    const ObjectView view{Time::from_seconds(kStep * i), aircraft};
    one->advance(view);
    twin->advance(view);
    const Vec2 place = one->position(), speed = one->velocity();
    checks.expect(place.allFinite() && speed.allFinite(), "its motion is not finite");
    checks.expect(place == twin->position() && speed == twin->velocity(),
                  "two equal ones do not move alike");
    if (before) {
      const double fastest = std::fmax(velocity->norm(), speed.norm());
      checks.expect((place - *before).norm() <= kStep * fastest + 1e-6,
                    "it moves further than its velocity says");
    }
    before = place;
    velocity = speed;
  }
  return checks.take();
}

Violations traffic_violations(const Make<TrafficAircraft>& make) {
  constexpr double kStep = 0.1;         // [s]
  constexpr double kAcceleration = 50;  // of what pilots fly [m/s^2]
  Checks checks;
  const auto one = make(), twin = make();
  RandomStream random = draws(6);
  std::optional<TrafficState> before;
  std::vector<NoticedAircraft> aircraft;
  for (std::uint32_t k = 0; k < 4; ++k) {
    const Vec2 p = place_within(random, 1500), v = place_within(random, 20);
    aircraft.push_back({EntityId{k}, {p.x(), p.y(), -100}, {v.x(), v.y(), 0}});
  }
  for (int i = 0; i < 6000; ++i) {
    for (NoticedAircraft& each : aircraft) each.p_N += kStep * each.v_N;
    const TrafficView view{Time::from_seconds(kStep * i), aircraft};
    one->advance(view);
    twin->advance(view);
    const TrafficState now = one->state(), other = twin->state();
    checks.expect(now.p_N.allFinite() && now.v_N.allFinite(), "its motion is not finite");
    checks.expect(
        now.p_N == other.p_N && now.v_N == other.v_N && now.phase == other.phase,
        "two equal ones do not fly alike");
    const bool flown =
        before && is_there(before->phase) && now.phase == TrafficPhase::kFlies;
    if (flown) {
      const double fastest = std::fmax(before->v_N.norm(), now.v_N.norm());
      checks.expect((now.p_N - before->p_N).norm() <=
                        kStep * (fastest + kAcceleration * kStep) + 1e-6,
                    "it moves further than its velocity says");
    }
    before = now;
  }
  return checks.take();
}

Violations turbulence_violations(const Make<Turbulence>& make) {
  constexpr double kStep = 0.02;  // [s]
  Checks checks;
  const auto one = make(), twin = make();
  RandomStream random = draws(4);
  VehicleState vehicle;
  vehicle.airspeed = 20;
  vehicle.v_N = {20, 0, 0};
  for (int i = 0; i < 1500; ++i) {
    vehicle.p_N = {20 * kStep * i, 0, -100};
    const TurbulenceView view{Time::from_seconds(kStep * i), vehicle,
                              random.uniform(0, 600),
                              Vec3(random.uniform(-10, 10), 3, 0)};
    const Gust gust = one->advance(view, kStep), other = twin->advance(view, kStep);
    checks.expect(gust.velocity_N.allFinite() && gust.rates_B.allFinite(),
                  "gusts are not finite");
    checks.expect(gust.velocity_N == other.velocity_N && gust.rates_B == other.rates_B,
                  "two equal ones do not gust alike");
  }
  return checks.take();
}

}  // namespace skein::contract
