// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "skein/base/random.h"
#include "skein/base/time.h"

namespace skein {

/// A span of the run's clock.
struct OutageSpan {
  double from = 0;     ///< [s]
  double until = 1e9;  ///< [s]; by default for good
};

struct OutageOptions {
  std::vector<OutageSpan> spans = {};  ///< that are known beforehand
  double per_hour = 0;                 ///< random ones, mean number per hour without one
  double mean_duration = 20;           ///< of a random one [s], exponentially distributed
};

/// When something does not work: at given times, and at random. The random times are
/// drawn one after the other, so that they do not depend on how often is asked.
class Outages {
 public:
  Outages(const OutageOptions& options, const RandomStream& random);

  /// When the outage at `now` ends; none when there is none. Times never go back.
  std::optional<Time> until(Time now);

 private:
  struct Span {
    Time from, until;
  };
  void draw();

  std::vector<Span> spans_;  // ascending, apart from each other
  std::size_t next_ = 0;     // the first one that may still matter
  double per_hour_;
  double mean_duration_;
  RandomStream random_;
  Span drawn_;
};

}  // namespace skein
