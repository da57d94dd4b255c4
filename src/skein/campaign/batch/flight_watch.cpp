// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/batch/flight_watch.h"

#include <algorithm>
#include <cmath>

#include "skein/base/math.h"
#include "skein/geo/rotation.h"

namespace skein::campaign {
namespace {

constexpr double kHoverArrival = 10;  // from the route's end to hovering there [s]

}  // namespace

void FlightWatch::Errors::add(double error) {
  square += error * error;
  count += 1;
  max = std::max(max, std::abs(error));
}

void FlightWatch::Lasting::step(bool holds, double dt) {
  now = holds ? now + dt : 0;
  longest = std::max(longest, now);
}

FlightWatch::FlightWatch(const ControlLimits& limits, EntityId aircraft,
                         double altitude_msl, const Vec2* hover_at)
    : limits_(limits),
      aircraft_(aircraft),
      altitude_msl_(altitude_msl),
      hovers_(hover_at != nullptr) {
  if (hover_at) hover_at_ = *hover_at;
}

void FlightWatch::record(const Record& record) {
  if (const auto* truth = std::get_if<TruthRecord>(&record)) take(*truth);
  if (const auto* estimate = std::get_if<EstimateRecord>(&record)) take(*estimate);
  if (const auto* event = std::get_if<Event>(&record)) take(*event);
}

void FlightWatch::take(const TruthRecord& truth) {
  if (truth.id != aircraft_) return;
  const VehicleState& state = truth.state;
  const double dt = (truth.time - last_).seconds();
  last_ = truth.time;
  position_ = geo::horizontal(state.p_N);
  const double cosine = std::clamp(geo::down_in_body(state.q_NB).z(), -1.0, 1.0);
  const double tilt = math::acos(cosine);
  max_tilt_ = std::max(max_tilt_, tilt);
  min_airspeed_ = std::min(min_airspeed_, state.airspeed);
  tilted_.step(tilt > limits_.tilt, dt);
  slow_.step(state.airspeed < limits_.stall, dt);
  height_.add(-state.p_N.z() - altitude_msl_);
}

void FlightWatch::take(const EstimateRecord& estimate) {
  if (estimate.id != aircraft_) return;
  const AutopilotStatus& status = estimate.status;
  const double wrong = (geo::horizontal(estimate.nav.p_N) - position_).norm();
  if (status.follows) {
    track_.add(std::abs(status.cross_track) + wrong);
    hover_since_ = last_;
  } else if (hovers_ && status.done && (last_ - hover_since_).seconds() > kHoverArrival) {
    track_.add((position_ - hover_at_).norm());
  }
}

void FlightWatch::take(const Event& event) {
  if (event.entity == aircraft_ && event.kind == EventKind::kAccident) accident_ = true;
}

void FlightWatch::add_figures(std::map<std::string, double>& figures) const {
  const bool tilted = tilted_.longest > limits_.tilt_time;
  const bool slow = slow_.longest > limits_.slow_time;
  const bool height = height_.max > limits_.height;
  const bool track = track_.max > limits_.track;
  figures["lost"] = accident_ || tilted || slow || height || track;
  figures["lost_accident"] = accident_;
  figures["lost_tilt"] = tilted;
  figures["lost_slow"] = slow;
  figures["lost_height"] = height;
  figures["lost_track"] = track;
  figures["tilt_max_deg"] = geo::degrees(max_tilt_);
  figures["airspeed_min_mps"] = min_airspeed_;
  figures["slow_longest_s"] = slow_.longest;
  const auto add = [&](const std::string& name, const Errors& errors) {
    if (errors.count <= 0) return;
    figures[name + "_max_m"] = errors.max;
    figures[name + "_rms_m"] = std::sqrt(errors.square / errors.count);
  };
  add("height_error", height_);
  add("track_error", track_);
}

}  // namespace skein::campaign
