// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/data/vehicle/payload.h"
#include "skein/role/recorder.h"

namespace skein::simulation {

/// Hands on what is recorded of a payload sensor, and keeps its pictures and what was
/// found in them.
class PayloadTap final : public Recorder {
 public:
  /// @param recorder  that it is handed on to; outlives this.
  explicit PayloadTap(Recorder& recorder) : recorder_(recorder) {}

  void record(const Record& record) override {
    if (const auto* picture = std::get_if<Footprint>(&record))
      pictures.push_back(*picture);
    else if (const auto* found = std::get_if<Detection>(&record))
      detections.push_back(*found);
    recorder_.record(record);
  }

  void clear() {
    pictures.clear();
    detections.clear();
  }

  std::vector<Footprint> pictures;
  std::vector<Detection> detections;

 private:
  Recorder& recorder_;
};

}  // namespace skein::simulation
