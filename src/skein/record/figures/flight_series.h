// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <vector>

#include "skein/base/id.h"
#include "skein/geo/vec.h"

namespace skein::record {

/// How one aircraft flew over time, thinned out. All columns have the length of `time`;
/// what is not known is NaN.
struct FlightSeries {
  EntityId id;
  std::vector<float> time;            ///< [s]
  std::vector<float> altitude_msl;    ///< true [m]
  std::vector<float> airspeed;        ///< true [m/s]
  std::vector<float> cross_track;     ///< of what it follows, as it believes [m]
  std::vector<float> position_error;  ///< horizontal, of its estimate [m]
  std::vector<float> charge;          ///< left, from 0 to 1
  std::vector<float> reserve;  ///< of it, as it believes, less what it takes to get home
};

/// Makes series of the rows of a run's truth and estimates: first all of the truth, then
/// the estimates, each in order of time.
class FlightSeriesBuilder {
 public:
  /// @param step     between samples [s].
  /// @param flights  those of this many aircraft that come first are kept.
  FlightSeriesBuilder(double step, int flights) : step_(step), flights_(flights) {}

  struct Truth {
    double time;  // [s]
    Vec2 p;
    double altitude_msl, airspeed, charge;
  };
  void truth(EntityId id, const Truth& row);

  struct Estimate {
    double time;  // [s]
    Vec2 p;
    double cross_track, reserve;
  };
  void estimate(EntityId id, const Estimate& row);

  std::vector<FlightSeries> take();

 private:
  struct Flight {
    FlightSeries series;
    std::vector<Vec2> places;  // of the samples
    double due = 0;            // time of the next sample, if there is one [s]
    std::size_t next = 0;      // sample that waits for its estimate
  };
  double step_;
  int flights_;
  std::map<EntityId, Flight> by_id_;
};

}  // namespace skein::record
