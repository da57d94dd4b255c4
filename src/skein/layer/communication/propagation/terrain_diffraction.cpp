// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/communication/propagation/terrain_diffraction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "skein/base/check.h"
#include "skein/base/math.h"
#include "skein/layer/communication/propagation/knife_edge.h"
#include "skein/layer/communication/propagation/path_ends.h"

namespace skein::communication {
namespace {

constexpr double kEarthRadius = 4.0 / 3 * 6'371e3;  // that rays see [m]
constexpr double kNoLoss = -0.78;                   // Fresnel parameters up to there

// Ground between two ends: places 0 and size - 1 are the ends themselves.
struct Profile {
  std::array<double, TerrainDiffraction::kMaxSamples + 2> height;
  int size;
  double spacing;  // [m]
};

struct Edge {
  int place = 0;
  double v = -math::kInfinity;
};

// The edge with the largest Fresnel parameter between two places of a profile.
Edge main_edge(const Profile& profile, int begin, int end, double wavelength) {
  Edge main;
  const double slope = (profile.height[static_cast<std::size_t>(end)] -
                        profile.height[static_cast<std::size_t>(begin)]) /
                       (end - begin);
  for (int k = begin + 1; k < end; ++k) {
    const double line =
        profile.height[static_cast<std::size_t>(begin)] + slope * (k - begin);
    const double over = profile.height[static_cast<std::size_t>(k)] - line;
    const double v = fresnel_parameter(over, (k - begin) * profile.spacing,
                                       (end - k) * profile.spacing, wavelength);
    if (v > main.v) main = {k, v};
  }
  return main;
}

}  // namespace

TerrainDiffraction::TerrainDiffraction(std::unique_ptr<Propagation> open,
                                       const Terrain& terrain, double frequency,
                                       double step)
    : open_(std::move(open)),
      terrain_(terrain),
      wavelength_(kSpeedOfLight / frequency),
      step_(step),
      highest_(terrain.highest_msl()) {
  SKEIN_CHECK(frequency > 0 && step > 0, frequency, step);
}

double TerrainDiffraction::received(double radiated, const Vec3& from,
                                    const Vec3& to) const {
  const double power = open_->received(radiated, from, to);
  const double loss = loss_db(from, to);
  return loss > 0 ? power * math::pow(10, -loss / 10) : power;
}

double TerrainDiffraction::loss_db(const Vec3& a, const Vec3& b) const {
  const auto [from, to] = ordered_ends(a, b);
  const Vec2 begin = geo::horizontal(from);
  const Vec2 way = geo::horizontal(to) - begin;
  const double distance = way.norm();
  // What is further below the line is out of the way, wherever along the path.
  const double clearance = -kNoLoss * std::sqrt(wavelength_ * distance / 8) +
                           distance * distance / (8 * kEarthRadius);
  if (std::min(-from.z(), -to.z()) > highest_ + clearance) return 0;

  Profile profile;
  profile.size =
      1 + std::clamp(
              static_cast<int>(std::min(std::ceil(distance / step_), 1.0 + kMaxSamples)),
              1, 1 + kMaxSamples);
  const int last = profile.size - 1;
  profile.spacing = distance / last;
  profile.height[0] = -from.z();
  profile.height[static_cast<std::size_t>(last)] = -to.z();
  for (int k = 1; k < last; ++k) {
    const double part = static_cast<double>(k) / last;
    const double line = -from.z() + part * (from.z() - to.z());
    // Twice: lines to the main edge are up to one clearance lower.
    const double ground = line > highest_ + 2 * clearance
                              ? highest_
                              : terrain_.elevation_msl(begin + part * way);
    const double d1 = k * profile.spacing, d2 = (last - k) * profile.spacing;
    profile.height[static_cast<std::size_t>(k)] = ground + d1 * d2 / (2 * kEarthRadius);
  }

  const Edge edge = main_edge(profile, 0, last, wavelength_);
  if (edge.v <= kNoLoss) return 0;
  const double loss = knife_edge_loss_db(edge.v);
  const double minor =
      knife_edge_loss_db(main_edge(profile, 0, edge.place, wavelength_).v) +
      knife_edge_loss_db(main_edge(profile, edge.place, last, wavelength_).v);
  return loss + (1 - math::exp(-loss / 6)) * minor;
}

}  // namespace skein::communication
