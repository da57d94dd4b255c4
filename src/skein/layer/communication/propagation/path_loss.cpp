// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/communication/propagation/path_loss.h"

#include <algorithm>
#include <cmath>

#include "skein/base/check.h"
#include "skein/base/math.h"
#include "skein/base/random.h"

namespace skein::communication {
namespace {

constexpr std::uint32_t kShadowing = 3;  // of the random streams for radio
constexpr int kWaves = 64;

}  // namespace

FreeSpace::FreeSpace(double frequency)
    : factor_(kSpeedOfLight / frequency / (4 * geo::kPi)) {
  SKEIN_CHECK(frequency > 0);
}

double FreeSpace::received(double radiated, const Vec3& from, const Vec3& to) const {
  const double square = (to - from).squaredNorm();
  if (square <= factor_ * factor_) return radiated;
  return radiated * (factor_ * factor_ / square);
}

FixedPower::FixedPower(double dbm) : power_(1e-3 * math::pow(10, dbm / 10)) {}

double FixedPower::received(double, const Vec3&, const Vec3&) const {
  return power_;
}

TwoRay::TwoRay(double frequency, double antenna_height, const Terrain* ground)
    : near_(frequency),
      wavelength_(kSpeedOfLight / frequency),
      antenna_height_(antenna_height),
      ground_(ground) {}

// Of an antenna above the ground [m].
double TwoRay::height(const Vec3& place) const {
  constexpr double kMinHeight = 0.1;
  const double ground = ground_ ? ground_->elevation_msl(geo::horizontal(place)) : 0;
  return std::max(kMinHeight, antenna_height_ - place.z() - ground);
}

double TwoRay::received(double radiated, const Vec3& from, const Vec3& to) const {
  const double product = height(from) * height(to);
  const double square = (to - from).squaredNorm();
  const double change = 4 * geo::kPi * product / wavelength_;
  if (square <= change * change) return near_.received(radiated, from, to);
  return radiated * math::squared(product / square);
}

LogDistance::LogDistance(double frequency, const PropagationProfile& profile,
                         std::uint64_t seed)
    : near_(frequency),
      exponent_(profile.exponent),
      reference_distance_(profile.reference_distance),
      sigma_db_(profile.shadowing_db) {
  if (sigma_db_ <= 0) return;
  RandomStream random(seed, 0, Purpose::kRadio, kShadowing);
  for (int i = 0; i < kWaves; ++i) {
    // Wave numbers of a field in the plane with correlation exp(-d / D).
    const double rest = 1 - random.uniform();
    const double number =
        std::sqrt(std::max(0.0, 1 / (rest * rest) - 1)) / profile.shadowing_distance;
    const double direction = 2 * geo::kPi * random.uniform();
    waves_.push_back({number * math::cos(direction), number * math::sin(direction),
                      2 * geo::kPi * random.uniform()});
  }
}

double LogDistance::shadowing_db(const Vec3& place) const {
  double sum = 0;
  for (const Wave& wave : waves_)
    sum += math::cos(wave.north * place.x() + wave.east * place.y() + wave.phase);
  return sigma_db_ * std::sqrt(2.0 / kWaves) * sum;
}

double LogDistance::received(double radiated, const Vec3& from, const Vec3& to) const {
  const double distance = (to - from).norm();
  const Vec3 reference(std::min(distance, reference_distance_), 0, 0);
  double power = near_.received(radiated, Vec3::Zero(), reference);
  if (distance > reference_distance_)
    power *= math::pow(reference_distance_ / distance, exponent_);
  if (!waves_.empty()) {
    const double loss_db = (shadowing_db(from) + shadowing_db(to)) / std::sqrt(2.0);
    power *= math::pow(10, -loss_db / 10);
  }
  return std::min(power, radiated);
}

}  // namespace skein::communication
