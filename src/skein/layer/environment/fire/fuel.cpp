// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/fire/fuel.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "skein/base/math.h"
#include "skein/base/random.h"

namespace skein::environment {
namespace {

constexpr int kPeriod = 64;

struct Between {
  int low, high;
  double weight;  // of high; its slope is zero at the nodes
};

Between nodes_around(double x) {
  const double low = std::floor(x), u = x - low;
  const double periods = std::floor(low / kPeriod);
  const int i = std::clamp(static_cast<int>(low - periods * kPeriod), 0, kPeriod - 1);
  return {i, (i + 1) % kPeriod, u * u * (3 - 2 * u)};
}

}  // namespace

Result<void> check(const PatchyFuelOptions& o) {
  const auto bad = [](const char* name, double value, const char* allowed) {
    return Error{ErrorCode::kBadInput, name, fmt::format("{} must be {}", value, allowed),
                 ""};
  };
  if (!(o.patch_size >= 1 && o.patch_size <= 1e6))
    return bad("patch_size", o.patch_size, "1 to 1000000 m");
  if (!(o.variation >= 0 && o.variation <= 1))
    return bad("variation", o.variation, "0 to 1");
  if (!(o.unburnable_share >= 0 && o.unburnable_share <= 0.5))
    return bad("unburnable_share", o.unburnable_share, "0 to 0.5");
  return {};
}

PatchyFuel::PatchyFuel(const PatchyFuelOptions& options, std::uint64_t seed)
    : options_(options) {
  const Result<void> valid = check(options);
  SKEIN_CHECK(valid.ok(), valid.error().text());
  RandomStream random(seed, 0, Purpose::kFireFuel);
  for (int i = 0; i < kPeriod * kPeriod; ++i) nodes_.push_back(random.normal());

  // The quantile of the noise, by sampling it a third of a patch apart.
  bare_below_ = -std::numeric_limits<double>::infinity();
  if (options.unburnable_share == 0) return;
  std::vector<double> values;
  const double step = options.patch_size / 3;
  for (int x = 0; x < 3 * kPeriod; ++x)
    for (int y = 0; y < 3 * kPeriod; ++y) values.push_back(noise({x * step, y * step}));
  std::sort(values.begin(), values.end());
  bare_below_ = values[static_cast<std::size_t>(options.unburnable_share *
                                                static_cast<double>(values.size()))];
}

// Standard normal at every point, and smooth.
double PatchyFuel::noise(const Vec2& p) const {
  const Between x = nodes_around(p.x() / options_.patch_size);
  const Between y = nodes_around(p.y() / options_.patch_size);
  const auto node = [&](int i, int j) {
    const int index = i * kPeriod + j;
    return nodes_[static_cast<std::size_t>(index)];
  };
  const double a = 1 - x.weight, b = x.weight, c = 1 - y.weight, d = y.weight;
  const double sum = a * (c * node(x.low, y.low) + d * node(x.low, y.high)) +
                     b * (c * node(x.high, y.low) + d * node(x.high, y.high));
  return sum / std::sqrt((a * a + b * b) * (c * c + d * d));
}

double PatchyFuel::factor(const Vec2& p) const {
  const double value = noise(p);
  if (value < bare_below_) return 0;
  return math::exp(options_.variation * std::clamp(value, -3.0, 3.0));
}

}  // namespace skein::environment
