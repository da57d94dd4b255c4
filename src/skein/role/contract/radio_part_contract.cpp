// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "skein/base/math.h"
#include "skein/role/antenna.h"
#include "skein/role/contract/checks.h"
#include "skein/role/error_model.h"
#include "skein/role/propagation.h"

namespace skein::contract {
namespace {

constexpr int kDraws = 500;

Vec3 place_in_air(RandomStream& random) {
  const Vec2 place = place_within(random, 20'000);
  return {place.x(), place.y(), -random.uniform(0, 1000)};
}

}  // namespace

Violations propagation_violations(const Make<Propagation>& make) {
  Checks checks;
  const auto one = make(), other = make();
  RandomStream random = draws(32);
  for (int k = 0; k < kDraws; ++k) {
    const double radiated = math::pow(10, random.uniform(-3, 1));  // 1 mW to 10 W
    const Vec3 from = place_in_air(random);
    const Vec3 to = k % 50 == 0 ? from : place_in_air(random);
    const double power = one->received(radiated, from, to);
    checks.expect(std::isfinite(power) && power >= 0, "a power is below 0 or not finite");
    checks.expect(power <= radiated, "more arrives than was sent");
    // Sums in another order differ in their last digits.
    checks.expect(std::abs(one->received(radiated, to, from) - power) <= 1e-9 * power,
                  "a link is not the same in both directions");
    checks.expect(one->received(radiated, from, to) == power,
                  "asked again, it says something else");
    checks.expect(other->received(radiated, from, to) == power,
                  "equal ones say different things");
  }
  return checks.take();
}

Violations antenna_violations(const Make<Antenna>& make) {
  Checks checks;
  const auto one = make(), other = make();
  RandomStream random = draws(33);
  for (int k = 0; k < kDraws; ++k) {
    Vec3 direction = Vec3::Zero();
    if (k < 6)
      direction[k / 2] = k % 2 == 0 ? 1 : -1;
    else
      direction = Vec3(random.normal(), random.normal(), random.normal()).normalized();
    const double gain = one->gain(direction);
    checks.expect(std::isfinite(gain) && gain >= 0, "a gain is below 0 or not finite");
    checks.expect(other->gain(direction) == gain, "equal ones say different things");
  }
  return checks.take();
}

Violations error_model_violations(const Make<ErrorModel>& make) {
  Checks checks;
  const auto one = make(), other = make();
  using Part = double (ErrorModel::*)(double, double) const;
  for (const Part part :
       {&ErrorModel::log_header_success, &ErrorModel::log_payload_success}) {
    const auto success = [&](const ErrorModel& model, double sinr, double duration) {
      return (model.*part)(sinr, duration);
    };
    constexpr double kDuration = 1e-5;  // [s]
    double before = success(*one, 0, kDuration);
    checks.expect(success(*one, 0, 0) <= 0, "a probability is above 1");
    for (double db = -40; db < 60; db += 0.25) {
      const double sinr = math::pow(10, db / 10);
      const double now = success(*one, sinr, kDuration);
      checks.expect(std::isfinite(now), "a logarithm is not finite");
      checks.expect(now <= 0, "a probability is above 1");
      checks.expect(now >= before, "a better signal is understood worse");
      const double half = success(*one, sinr, kDuration / 2);
      // What is lost for certain is lost in each part.
      checks.expect(now < -300 || std::abs(2 * half - now) <= 1e-9 * -now,
                    "parts of a frame do not make the whole");
      checks.expect(success(*other, sinr, kDuration) == now,
                    "equal ones say different things");
      before = now;
    }
  }
  return checks.take();
}

}  // namespace skein::contract
