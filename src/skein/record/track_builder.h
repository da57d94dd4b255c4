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

  void add(double time, double north, double east, double heading) {
    if (track_.north.empty()) {
      track_.start = time;
      put(north, east, heading);
    } else if (time > time_) {
      while (next() <= time) {
        const double f = (next() - time_) / (time - time_);
        put(north_ + f * (north - north_), east_ + f * (east - east_), heading);
      }
    }
    time_ = time;
    north_ = north;
    east_ = east;
  }

  StoredTrack take() { return std::move(track_); }

 private:
  double next() const {
    return track_.start + track_.step * static_cast<double>(track_.north.size());
  }
  void put(double north, double east, double heading) {
    track_.north.push_back(north);
    track_.east.push_back(east);
    track_.heading.push_back(heading);
  }

  StoredTrack track_;
  double time_ = 0, north_ = 0, east_ = 0;
};

}  // namespace skein::record
