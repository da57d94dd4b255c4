// SPDX-License-Identifier: Apache-2.0
#include "skein/record/figures/payload_statistics.h"

#include <cmath>

namespace skein::record {

void PayloadStatistics::motion(const ObjectMotion& motion) {
  objects_[motion.object].add(motion);
}

void PayloadStatistics::detection(const Detection& detection) {
  ++detections_;
  found_.insert(detection.object);
  const auto object = objects_.find(detection.object);
  if (object == objects_.end()) return;
  const auto place = object->second.at(detection.time);
  if (!place) return;
  squared_errors_ += (detection.point - *place).squaredNorm();
  known_ += 1;
}

void PayloadStatistics::add_figures(std::map<std::string, double>& figures) const {
  const auto put = [&figures](const char* name, std::uint64_t count) {
    figures[name] = static_cast<double>(count);
  };
  if (!objects_.empty()) {
    put("objects", objects_.size());
    put("objects_found", found_.size());
  }
  if (pictures_ > 0 || detections_ > 0) {
    put("pictures", pictures_);
    put("detections", detections_);
  }
  if (known_ > 0) figures["detection_error_rms_m"] = std::sqrt(squared_errors_ / known_);
  if (scans_ > 0) put("range_scans", scans_);
}

}  // namespace skein::record
