// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/flights/execution_errors.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace skein::reasoning {
namespace {

constexpr double kMemory = 60;                      // [s]
constexpr double kShare = 0.95;                     // of the samples are within the error
constexpr double kShrinks = 0.1 / 60;               // at most, of it [1/s]
constexpr double kMinAcross = 1, kMinHeight = 0.5;  // nobody flies better [m]

double within(std::vector<double> all) {
  const auto at = static_cast<std::ptrdiff_t>(
      std::min(static_cast<double>(all.size()) - 1,
               std::floor(kShare * static_cast<double>(all.size()))));
  std::nth_element(all.begin(), all.begin() + at, all.end());
  return all[static_cast<std::size_t>(at)];
}

}  // namespace

void ExecutionErrors::add(Time now, const Vec3& off) {
  const double dt = samples_.empty() ? 0 : (now - samples_.back().time).seconds();
  samples_.push_back({now, off.head<2>().norm(), std::abs(off.z())});
  while ((now - samples_.front().time).seconds() > kMemory) samples_.pop_front();
  std::vector<double> across, height;
  for (const Sample& sample : samples_) {
    across.push_back(sample.across);
    height.push_back(sample.height);
  }
  const double keeps = 1 - std::min(1.0, kShrinks * dt);
  across_ = std::max({kMinAcross, within(std::move(across)), across_ * keeps});
  height_ = std::max({kMinHeight, within(std::move(height)), height_ * keeps});
}

}  // namespace skein::reasoning
