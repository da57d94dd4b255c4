// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/batch/lap_recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "skein/base/math.h"
#include "skein/data/vehicle/control.h"

namespace skein::campaign {
namespace {

double rms(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

// The value that 95 % of the magnitudes do not exceed.
double percentile_95(std::vector<double> values) {
  for (double& value : values) value = std::abs(value);
  const std::size_t at = (values.size() * 95 + 99) / 100 - 1;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at),
                   values.end());
  return values[at];
}

}  // namespace

void LapRecorder::record(const Record& record) {
  if (const auto* truth = std::get_if<TruthRecord>(&record)) take(*truth);
  if (const auto* estimate = std::get_if<EstimateRecord>(&record)) take(*estimate);
}

void LapRecorder::take(const TruthRecord& truth) {
  if (!aircraft_) aircraft_ = truth.id;
  if (truth.id != *aircraft_) return;
  fresh_ = samples_.empty();
  before_ = now_;
  time_before_ = time_;
  now_ = truth.state;
  time_ = truth.time;
}

void LapRecorder::take(const EstimateRecord& estimate) {
  if (!aircraft_ || estimate.id != *aircraft_) return;
  const AutopilotStatus& status = estimate.status;
  laps_ = std::max(laps_, status.lap);
  // In guided flight it follows circles where it waits, which are no laps.
  if (!status.follows || status.mode != FlightMode::kAuto) return;
  LapSample sample;
  sample.time = time_.seconds();
  sample.lap = status.lap;
  sample.position = geo::horizontal(now_.p_N);
  const double since = (time_ - estimate.nav.time).seconds();
  const Vec3 error = now_.p_N - since * now_.v_N - estimate.nav.p_N;
  sample.estimated = status.cross_track;
  sample.cross_track =
      status.cross_track + geo::cross(status.along, geo::horizontal(error));
  sample.on_route =
      sample.position - sample.cross_track * geo::turned_right(status.along);
  sample.height_error = -now_.p_N.z() - status.altitude_msl;
  sample.airspeed_error = now_.airspeed - status.airspeed;
  if (!fresh_ && time_ > time_before_) {
    double sum = 0;
    for (const std::size_t k : {channel::kAileron, channel::kElevator, channel::kRudder})
      sum += math::squared(now_.actuators[k] - before_.actuators[k]);
    sample.effort = std::sqrt(sum) / (time_ - time_before_).seconds();
  }
  samples_.push_back(sample);
}

void LapRecorder::add_figures(std::map<std::string, double>& figures) const {
  figures["laps"] = laps_;
  for (int lap = 0; lap < laps_; ++lap) {
    std::vector<double> off, believed, height, speed, effort;
    double first = 0, last = 0;
    for (const LapSample& s : samples_) {
      if (s.lap != lap) continue;
      if (off.empty()) first = s.time;
      last = s.time;
      off.push_back(s.cross_track);
      believed.push_back(s.estimated);
      height.push_back(s.height_error);
      speed.push_back(s.airspeed_error);
      effort.push_back(s.effort);
    }
    if (off.empty()) continue;
    const double values[] = {rms(off),
                             percentile_95(off),
                             rms(believed),
                             percentile_95(believed),
                             rms(height),
                             rms(speed),
                             geo::degrees(rms(effort)),
                             last - first};
    for (std::size_t k = 0; k < std::size(kLapFigures); ++k)
      figures[fmt::format("lap{}_{}", lap + 1, kLapFigures[k].name)] = values[k];
  }
}

}  // namespace skein::campaign
