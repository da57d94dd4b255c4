#pragma once

#include <utility>

#include "skein/record/run_reader.h"

namespace skein::record {

/// Turns rows of one entity into samples at equal steps, by interpolation.
class TrackBuilder {
 public:
  TrackBuilder(EntityId id, double step) {
    track_.id = id;
    track_.step = step;
  }

  void add(double time, const Vec3& p_N, double heading) {
    if (track_.north.empty()) {
      track_.start = time;
      put(p_N, heading);
    } else if (time > time_) {
      while (next() <= time) {
        const double f = (next() - time_) / (time - time_);
        put(p_N_ + f * (p_N - p_N_), heading);
      }
    }
    time_ = time;
    p_N_ = p_N;
  }

  StoredTrack take() { return std::move(track_); }

 private:
  double next() const {
    return track_.start + track_.step * static_cast<double>(track_.north.size());
  }
  void put(const Vec3& p_N, double heading) {
    track_.north.push_back(p_N.x());
    track_.east.push_back(p_N.y());
    track_.altitude_msl.push_back(-p_N.z());
    track_.heading.push_back(heading);
  }

  StoredTrack track_;
  double time_ = 0;
  Vec3 p_N_ = Vec3::Zero();
};

}  // namespace skein::record
