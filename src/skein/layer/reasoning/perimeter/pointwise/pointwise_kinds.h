// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "skein/layer/reasoning/perimeter/pointwise/pointwise_estimator.h"

namespace skein::perimeter {

/// One pointwise estimator that a user can choose.
struct PointwiseKind {
  const char* name;  ///< as in a scenario's missions[0].estimator
  const char* help;
  std::unique_ptr<PointRule> (*make_rule)(const PointwiseOptions&, std::uint64_t seed);
  bool needs_crossings =
      false;  ///< learns from nothing else, whatever use_crossings says
};

/// All of them: `qkf`, `mle`, `map`, `ukf`, `qkf-a15`, `particle`, `point-reset`. A new
/// one is one row here.
std::span<const PointwiseKind> pointwise_kinds();

/// A new estimator of `kind`, one of pointwise_kinds().
/// @param seed   of the run; only `particle` draws random numbers.
/// @param start  time of the prior.
std::unique_ptr<PerimeterEstimator> make_pointwise(const PointwiseKind& kind,
                                                   const PointwiseOptions& options,
                                                   const PerimeterPrior& prior,
                                                   std::uint64_t seed, Time start = {});

}  // namespace skein::perimeter
