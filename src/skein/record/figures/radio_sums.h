// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <utility>

#include "skein/record/store/run_reader.h"

namespace skein::record {

/// Adds up what radios did and how links were over a run.
class RadioSums {
 public:
  /// In order of time.
  void add(const RadioUseRecord& record);
  void add(const LinkUse& use);

  /// Fills in loads, radios and links of a run.
  void finish(StoredRun& run) const;

 private:
  struct Link {
    std::uint64_t arrived = 0, lost = 0;
    double rssi = 0, sinr = 0, delay = 0;  // weighted by what arrived
    double heard = 0;                      // weight of the levels
  };
  struct Use {
    RadioUse sums;
    double seconds = 0;
  };

  std::vector<StoredLoad> loads_;
  int radios_ = 0;   // in the last load
  double span_ = 0;  // that it covers [s]
  std::map<EntityId, Use> uses_;
  std::map<std::pair<EntityId, EntityId>, Link> links_;
};

}  // namespace skein::record
