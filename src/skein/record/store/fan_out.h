// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include "skein/role/recorder.h"

namespace skein::record {

/// Gives every record to each of its listeners, in their order.
class FanOut final : public Recorder {
 public:
  /// @param listeners  outlive it; none is null.
  explicit FanOut(std::vector<Recorder*> listeners) : listeners_(std::move(listeners)) {}

  void record(const Record& record) override {
    for (Recorder* listener : listeners_) listener->record(record);
  }
  /// Fails: as the first listener that fails; all are asked.
  Result<void> step_done(Time time) override {
    Result<void> all;
    for (Recorder* listener : listeners_)
      if (auto done = listener->step_done(time); !done && all) all = done;
    return all;
  }

 private:
  std::vector<Recorder*> listeners_;
};

}  // namespace skein::record
