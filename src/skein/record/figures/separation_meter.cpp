// SPDX-License-Identifier: Apache-2.0
#include "skein/record/figures/separation_meter.h"

#include <algorithm>
#include <cmath>

#include "skein/record/store/ground_time.h"

namespace skein::record {
namespace {

constexpr double kNear = 700;  // well clear and what two move between moments [m]
constexpr int kParts = 8;      // of the motion between two moments

}  // namespace

SeparationMeter::SeparationMeter(const Separation& kept)
    : kept_(kept), near_(std::max(kNear, 1.2 * kept.horizontal)) {}

void SeparationMeter::keeps(EntityId id, const Separation& kept) {
  if (!(kept.horizontal > 0 && kept.vertical > 0)) return;
  others_[id] = kept;
  near_ = std::max(near_, 1.2 * kept.horizontal);
}

void SeparationMeter::place(Time time, EntityId id, const Vec3& p_N, bool on_ground) {
  if (on_ground) touched_[id] = time;
  const auto touched = touched_.find(id);
  if (touched != touched_.end() && (time - touched->second).seconds() < kGroundTime)
    return;
  if (begun_ && time != time_) look();
  begun_ = true;
  time_ = time;
  now_.emplace_back(id, p_N);
}

void SeparationMeter::finish() {
  look();
}

void SeparationMeter::look() {
  places_.clear();
  for (const auto& [id, p] : now_) {
    const auto before = last_.find(id);
    const auto kept = others_.find(id);
    places_.push_back({id, before == last_.end() ? p : before->second, p,
                       kept == others_.end() ? kept_ : kept->second});
  }
  std::ranges::sort(places_, {}, [](const Place& place) { return place.to.x(); });
  for (std::size_t i = 0; i < places_.size(); ++i)
    for (std::size_t j = i + 1;
         j < places_.size() && places_[j].to.x() - places_[i].to.x() < near_; ++j)
      look(places_[i], places_[j]);
  last_.clear();
  last_.insert(now_.begin(), now_.end());
  now_.clear();
}

void SeparationMeter::look(const Place& a, const Place& b) {
  if (std::abs(a.to.y() - b.to.y()) > near_) return;
  const Separation well_clear = *separation_named("well-clear"),
                   nmac = *separation_named("nmac");
  const Separation kept = larger(a.kept, b.kept);
  const Pair pair = a.id < b.id ? Pair{a.id, b.id} : Pair{b.id, a.id};
  const Vec3 from = b.from - a.from, to = b.to - a.to;
  for (int k = 1; k <= kParts; ++k) {
    const Vec3 apart = from + (to - from) * (static_cast<double>(k) / kParts);
    const double horizontal = apart.head<2>().norm(), vertical = std::abs(apart.z());
    const double ratio = kept.ratio(horizontal, vertical);
    if (ratio < min_ratio_) {
      min_ratio_ = ratio;
      min_horizontal_ = horizontal;
    }
    if (ratio < 1) violations_.insert(pair);
    if (nmac.ratio(horizontal, vertical) < 1) near_collisions_.insert(pair);
    if (well_clear.ratio(horizontal, vertical) < 1) well_clear_lost_.insert(pair);
  }
}

}  // namespace skein::record
