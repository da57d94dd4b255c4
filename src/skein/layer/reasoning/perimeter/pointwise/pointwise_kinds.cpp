// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/pointwise/pointwise_kinds.h"

#include "skein/layer/reasoning/perimeter/pointwise/gaussian_rule.h"
#include "skein/layer/reasoning/perimeter/pointwise/particle_rule.h"

namespace skein::perimeter {

namespace {

using model::RangeRule;

template <RangeRule rule>
std::unique_ptr<PointRule> make_gaussian(const PointwiseOptions& options, std::uint64_t) {
  return std::make_unique<GaussianRule>(rule, options.sigma_v);
}

std::unique_ptr<PointRule> make_particle(const PointwiseOptions& options,
                                         std::uint64_t seed) {
  return std::make_unique<ParticleRule>(options.particles, options.false_rate, seed);
}

std::unique_ptr<PointRule> make_reset(const PointwiseOptions& options, std::uint64_t) {
  return std::make_unique<ResetRule>(options.min_sd);
}

constexpr PointwiseKind kKinds[] = {
    {"qkf", "the thesis's filter: exact moments of a half-space, per control point",
     make_gaussian<RangeRule::kExact>},
    {"mle", "as qkf, with the most likely range of a noisy bound",
     make_gaussian<RangeRule::kMle>},
    {"map", "as qkf, with the most probable range", make_gaussian<RangeRule::kMap>},
    {"ukf", "as qkf, with two clipped sigma points", make_gaussian<RangeRule::kUkf>},
    {"qkf-a15", "ablation: qkf with the gain (A.15), over-confident",
     make_gaussian<RangeRule::kGainA15>},
    {"particle", "a particle filter per control point", make_particle},
    {"point-reset",
     "the thesis's benchmark: crossings set control points, nothing else counts",
     make_reset, true},
};

}  // namespace

std::span<const PointwiseKind> pointwise_kinds() {
  return kKinds;
}

std::unique_ptr<PerimeterEstimator> make_pointwise(const PointwiseKind& kind,
                                                   const PointwiseOptions& options,
                                                   const PerimeterPrior& prior,
                                                   std::uint64_t seed, Time start) {
  PointwiseOptions used = options;
  used.use_crossings |= kind.needs_crossings;
  return std::make_unique<PointwiseEstimator>(used, prior, kind.make_rule(used, seed),
                                              start);
}

}  // namespace skein::perimeter
