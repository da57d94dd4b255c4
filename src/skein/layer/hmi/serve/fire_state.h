// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "skein/data/event/record.h"

namespace skein::hmi {

/// What is believed of fires, now and ahead, as it was recorded last: taken in by the
/// thread of the run, asked for by any.
class FireState {
 public:
  void take(const PerimeterRecord& record);
  void take(const ForecastRecord& record);
  void clear();

  /// A boundary that a mission believes in; of a forecast made before, at its time.
  struct Believed {
    std::string mission;
    BoundaryEstimate boundary;
    std::optional<Time> made;  ///< of a forecast
  };
  std::vector<Believed> all() const;

 private:
  mutable std::mutex lock_;
  std::map<std::string, BoundaryEstimate> now_;             // by mission
  std::map<std::string, std::vector<Believed>> forecasts_;  // of one making, by mission
};

}  // namespace skein::hmi
