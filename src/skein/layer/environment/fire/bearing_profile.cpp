// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/fire/bearing_profile.h"

#include <algorithm>

#include "skein/base/check.h"
#include "skein/base/math.h"

namespace skein::environment {

BearingProfile BearingProfile::harmonics(int count, double amplitude, double decay,
                                         RandomStream& random) {
  BearingProfile profile;
  if (count <= 0 || amplitude == 0) return profile;
  for (int k = 1; k <= count; ++k)
    profile.harmonics_.push_back(math::pow(k, -decay) *
                                 geo::unit(2 * geo::kPi * random.uniform()));
  // 64 samples per period of the highest harmonic find the extreme to (pi/64)^2/2 = 0.1
  // %.
  const int samples = 64 * count;
  double largest = 0;
  for (int i = 0; i < samples; ++i)
    largest =
        std::max(largest, std::abs(profile.at(geo::unit(2 * geo::kPi * i / samples))));
  for (Vec2& h : profile.harmonics_) h *= amplitude / largest;
  return profile;
}

BearingProfile BearingProfile::sectors(int count, double amplitude,
                                       RandomStream& random) {
  SKEIN_CHECK(count > 0, count);
  BearingProfile profile;
  for (int i = 0; i < count; ++i)
    profile.sectors_.push_back(random.uniform(-amplitude, amplitude));
  return profile;
}

double BearingProfile::at(const Vec2& direction) const {
  if (!sectors_.empty()) {
    const double turn = geo::wrap_2pi(geo::bearing(direction)) / (2 * geo::kPi);
    const auto count = sectors_.size();
    const auto index = static_cast<std::size_t>(turn * static_cast<double>(count));
    return sectors_[std::min(index, count - 1)];
  }
  // cos and sin of the multiples by repeated turning, without trigonometry.
  const double c1 = direction.x(), s1 = direction.y();
  double sum = 0, c = 1, s = 0;
  for (const Vec2& h : harmonics_) {
    const double turned = c * c1 - s * s1;
    s = c * s1 + s * c1;
    c = turned;
    sum += h.x() * c + h.y() * s;
  }
  return sum;
}

}  // namespace skein::environment
