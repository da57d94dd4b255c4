// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/communication/antenna/antenna_pattern.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "skein/base/check.h"
#include "skein/base/math.h"

namespace skein::communication {
namespace {

double factor_of(double gain_db) {
  return math::pow(10, gain_db / 10);
}

// Between two neighbours of an axis.
struct Cell {
  std::size_t low, high;
  double part;  // of the way from low to high
};

bool grows(std::span<const double> axis) {
  return std::adjacent_find(axis.begin(), axis.end(), std::greater_equal<>()) ==
         axis.end();
}

Cell cell_of(std::span<const double> axis, double x) {
  const auto above = std::upper_bound(axis.begin(), axis.end(), x);
  const auto high = static_cast<std::size_t>(above - axis.begin());
  if (high == 0) return {0, 0, 0};
  if (high == axis.size()) return {high - 1, high - 1, 0};
  return {high - 1, high, (x - axis[high - 1]) / (axis[high] - axis[high - 1])};
}

// The same on an axis that goes round.
Cell cell_of_circle(std::span<const double> axis, double x) {
  if (x >= axis.front() && x < axis.back()) return cell_of(axis, x);
  const double gap = axis.front() + 2 * geo::kPi - axis.back();
  const double since =
      x >= axis.back() ? x - axis.back() : x + 2 * geo::kPi - axis.back();
  return {axis.size() - 1, 0, since / gap};
}

}  // namespace

VerticalDipole::VerticalDipole(double min_gain_db) : min_gain_(factor_of(min_gain_db)) {}

double VerticalDipole::gain(const Vec3& direction_B) const {
  const double along = direction_B.z();
  const double square = 1 - along * along;  // of the sine
  if (square <= 0) return min_gain_;
  return std::max(min_gain_, math::squared(math::cos(geo::kPi / 2 * along)) / square);
}

BodyShadow::BodyShadow(const AntennaProfile& profile)
    : half_width_(profile.shadow_half_width),
      edge_(profile.shadow_edge),
      depth_db_(profile.shadow_depth_db),
      cos_inside_(math::cos(std::max(0.0, half_width_ - edge_ / 2))),
      cos_outside_(math::cos(std::min(geo::kPi, half_width_ + edge_ / 2))),
      least_(factor_of(-depth_db_)) {
  const Vec2 level =
      math::cos(profile.shadow_elevation) * geo::unit(profile.shadow_azimuth);
  middle_B_ = {level.x(), level.y(), -math::sin(profile.shadow_elevation)};
}

double BodyShadow::gain(const Vec3& direction_B) const {
  const double along = direction_B.dot(middle_B_);
  if (along <= cos_outside_) return 1;
  if (along >= cos_inside_) return least_;
  const double angle = math::acos(std::clamp(along, -1.0, 1.0));
  const double x = std::clamp((angle - half_width_) / edge_ + 0.5, 0.0, 1.0);
  return factor_of(-depth_db_ * (1 + math::cos(geo::kPi * x)) / 2);
}

GainTable::GainTable(const AntennaProfile& profile)
    : azimuths_(profile.azimuths), elevations_(profile.elevations) {
  SKEIN_CHECK(!azimuths_.empty() && grows(azimuths_) && !elevations_.empty() &&
              grows(elevations_) && profile.gains_db.size() == elevations_.size());
  for (const std::vector<double>& row : profile.gains_db) {
    SKEIN_CHECK(row.size() == azimuths_.size(), row.size(), azimuths_.size());
    gains_db_.insert(gains_db_.end(), row.begin(), row.end());
  }
}

double GainTable::gain(const Vec3& direction_B) const {
  const double azimuth = geo::wrap_2pi(geo::bearing(geo::horizontal(direction_B)));
  const double elevation = -math::asin(std::clamp(direction_B.z(), -1.0, 1.0));
  const Cell column = cell_of_circle(azimuths_, azimuth);
  const Cell row = cell_of(elevations_, elevation);
  const auto along = [&](std::size_t k) {
    const double* gains = &gains_db_[k * azimuths_.size()];
    return gains[column.low] + column.part * (gains[column.high] - gains[column.low]);
  };
  const double low = along(row.low);
  return factor_of(low + row.part * (along(row.high) - low));
}

}  // namespace skein::communication
