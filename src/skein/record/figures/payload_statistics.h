// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>

#include "skein/data/perimeter/object.h"
#include "skein/data/vehicle/payload.h"
#include "skein/record/figures/object_track.h"

namespace skein::record {

/// What the payload of a run's aircraft saw: the part of its key figures that is about
/// cameras and ranging sensors.
class PayloadStatistics {
 public:
  void object(const GroundObject& object) { objects_[object.id]; }
  /// Of one object in order of time.
  void motion(const ObjectMotion& motion);
  void detection(const Detection& detection);
  void footprint() { ++pictures_; }
  void ranges() { ++scans_; }

  /// Adds, where there is something to count, `objects` (that exist), `objects_found`,
  /// `detections`, `detection_error_rms_m` (horizontal, to where the object was at that
  /// time), `pictures` and `range_scans`.
  void add_figures(std::map<std::string, double>& figures) const;

 private:
  std::map<std::uint32_t, ObjectTrack> objects_;
  std::set<std::uint32_t> found_;
  std::uint64_t detections_ = 0, pictures_ = 0, scans_ = 0;
  double squared_errors_ = 0, known_ = 0;  // of detections of known objects
};

}  // namespace skein::record
