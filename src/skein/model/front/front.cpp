// SPDX-License-Identifier: Apache-2.0
#include "skein/model/front/front.h"

#include <algorithm>

#include <fmt/format.h>

#include "skein/base/check.h"
#include "skein/geo/clip.h"
#include "skein/model/front/spacing.h"

namespace skein::model {
namespace {

constexpr std::size_t kMinMarkers =
    24;                              // of a ring, as long as the finest spacing allows
constexpr double kFinest = 0.1;      // finest spacing of a small ring, in spacings
constexpr double kMinIsland = 0.5;   // [squared spacings]
constexpr double kWorldEnd = 1e7;    // [m], well within what clipping can hold
constexpr double kMinSpot = 0.0025;  // [squared spacings]: slivers that merging leaves

// Outward direction at b of the circle through a, b, c; not of unit length.
Vec2 normal_at(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Vec2 in = b - a, out = c - b;
  return geo::turned_left(in * out.squaredNorm() + out * in.squaredNorm());
}

}  // namespace

Result<void> check(const FrontOptions& o) {
  const auto bad = [](const char* name, double value, const char* allowed) {
    return Error{ErrorCode::kBadInput, name, fmt::format("{} must be {}", value, allowed),
                 ""};
  };
  if (!(o.spacing >= 0.01 && o.spacing <= 1e5))
    return bad("spacing", o.spacing, "0.01 to 100000 m");
  if (!(o.courant > 0 && o.courant <= 0.5))
    return bad("courant", o.courant, "above 0, up to 0.5");
  if (!(o.max_step > 0 && o.max_step <= 3600))
    return bad("max_step", o.max_step, "above 0, up to 3600 s");
  if (!(o.max_markers >= 100)) return bad("max_markers", o.max_markers, "at least 100");
  return {};
}

Front::Front(const geo::Region& burnt, const FrontOptions& options, double time)
    : options_(options), spacing_(options.spacing), time_(time) {
  const Result<void> valid = check(options);
  SKEIN_CHECK(valid.ok(), valid.error().text());
  ignite(burnt);
}

void Front::ignite(const geo::Region& burnt) {
  rings_.insert(rings_.end(), burnt.begin(), burnt.end());
  rings_ = geo::clean_touching(rings_, geo::FillRule::kPositive);
  tidy();
}

int Front::markers() const {
  std::size_t sum = 0;
  for (const geo::Ring& ring : rings_) sum += ring.size();
  return static_cast<int>(sum);
}

double Front::ring_spacing(const geo::Ring& ring) const {
  // A bound from the number of markers spares the length of long rings.
  if (ring.size() > 2 * kMinMarkers || geo::signed_area(ring) < 0) return spacing_;
  const double length = geo::length(std::span<const Vec2>(ring));
  return std::clamp(length / static_cast<double>(kMinMarkers), kFinest * spacing_,
                    spacing_);
}

void Front::evaluate(const WaveletField& field) {
  velocities_.clear();
  step_ = options_.max_step;
  for (const geo::Ring& ring : rings_) {
    const auto n = ring.size();
    wavelets_.resize(n);
    field.wavelets(ring, time_, wavelets_);
    double fastest2 = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const Vec2 normal =
          normal_at(ring[i > 0 ? i - 1 : n - 1], ring[i], ring[i + 1 < n ? i + 1 : 0]);
      const bool beyond = ring[i].cwiseAbs().maxCoeff() > kWorldEnd;
      const Vec2 v = beyond ? Vec2(0, 0) : spread_velocity(wavelets_[i], normal);
      SKEIN_CHECK(v.allFinite(), v.x(), v.y(), ring[i].x(), ring[i].y());
      fastest2 = std::max(fastest2, v.squaredNorm());
      velocities_.push_back(v);
    }
    if (fastest2 > 0)
      step_ =
          std::min(step_, options_.courant * ring_spacing(ring) / std::sqrt(fastest2));
  }
  evaluated_ = true;
}

double Front::next_time(const WaveletField& field) {
  if (!evaluated_) evaluate(field);
  return time_ + step_;
}

void Front::step(const WaveletField& field) {
  if (!evaluated_) evaluate(field);
  move(step_);
  time_ += step_;
}

void Front::advance(const WaveletField& field, double time) {
  SKEIN_CHECK(time >= time_, time, time_);
  while (next_time(field) < time) step(field);
  move(time - time_);
  time_ = time;
}

void Front::move(double dt) {
  if (!(dt > 0)) return;
  const Vec2* v = velocities_.data();
  for (geo::Ring& ring : rings_)
    for (Vec2& p : ring) p += dt * *v++;
  tidy();
}

void Front::tidy() {
  evaluated_ = false;
  for (geo::Ring& ring : rings_) {
    respace(ring, ring_spacing(ring), scratch_);
    cut_loops(ring, kMinIsland * spacing_ * spacing_);
  }
  if (search_.any(rings_, 2 * spacing_)) {
    rings_ = geo::clean_touching(rings_, geo::FillRule::kPositive);
    ++merges_;
  }
  std::erase_if(rings_, [&](const geo::Ring& ring) {
    if (ring.size() < 3) return true;
    if (ring.size() > 4 * kMinMarkers) return false;
    const double area = geo::signed_area(ring) / (spacing_ * spacing_);
    return area < kMinSpot && area > -kMinIsland;
  });
  limit_markers();
}

void Front::limit_markers() {
  while (markers() > options_.max_markers) {
    spacing_ *= 2;
    for (geo::Ring& ring : rings_) ring = geo::resample_by_spacing(ring, spacing_, 8);
    rings_ = geo::clean_touching(rings_, geo::FillRule::kPositive);
  }
}

}  // namespace skein::model
