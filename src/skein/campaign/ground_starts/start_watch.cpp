// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/ground_starts/start_watch.h"

#include <algorithm>
#include <cmath>

#include "skein/base/math.h"
#include "skein/geo/rotation.h"

namespace skein::campaign {

void StartWatch::record(const Record& record) {
  if (const auto* truth = std::get_if<TruthRecord>(&record)) take(*truth);
  if (const auto* estimate = std::get_if<EstimateRecord>(&record)) take(*estimate);
  if (const auto* event = std::get_if<Event>(&record)) take(*event);
}

void StartWatch::take(const TruthRecord& truth) {
  if (truth.id != aircraft_) return;
  const Time time = truth.time;
  const VehicleState& state = truth.state;
  dt_ = (time - last_).seconds();
  last_ = time;
  state_ = state;
  const double tilt =
      math::acos(std::clamp(geo::down_in_body(state.q_NB).z(), -1.0, 1.0));
  max_tilt_ = std::max(max_tilt_, tilt);
  tilted_.step(tilt > limits_.tilt, dt_);
  const bool up = -state.p_N.z() > limits_.altitude_msl - limits_.arrival;
  if (up && climbed_at_ < 0) climbed_at_ = time.seconds();
}

void StartWatch::take(const EstimateRecord& record) {
  const NavEstimate& estimate = record.nav;
  const AutopilotStatus& status = record.status;
  if (record.id != aircraft_) return;
  const Vec3 down = geo::down_in_body(state_.q_NB);
  const Vec3 believed =
      geo::down_in_body(geo::from_euler({estimate.roll, estimate.pitch, 0}));
  const double attitude = math::acos(std::clamp(down.dot(believed), -1.0, 1.0));
  const double height = std::abs(estimate.p_N.z() - state_.p_N.z());
  max_attitude_error_ = std::max(max_attitude_error_, attitude);
  max_height_error_ = std::max(max_height_error_, height);
  misled_.step(attitude > limits_.attitude_error || height > limits_.height_error, dt_);
  failsafe_ = failsafe_ || status.reaction != FailsafeReaction::kNone;
}

void StartWatch::take(const Event& event) {
  if (event.entity == aircraft_ && event.kind == EventKind::kAccident) accident_ = true;
}

void StartWatch::add_figures(std::map<std::string, double>& figures) const {
  const bool tilted = tilted_.longest > limits_.time;
  const bool misled = misled_.longest > limits_.time;
  const bool late = climbed_at_ < 0 || climbed_at_ > limits_.climb_time;
  figures["lost"] = accident_ || tilted || misled || failsafe_ || late;
  figures["lost_accident"] = accident_;
  figures["lost_tilt"] = tilted;
  figures["lost_belief"] = misled;
  figures["lost_failsafe"] = failsafe_;
  figures["lost_climb"] = late;
  if (climbed_at_ >= 0) figures["climb_time_s"] = climbed_at_;
  figures["tilt_max_deg"] = geo::degrees(max_tilt_);
  figures["attitude_error_max_deg"] = geo::degrees(max_attitude_error_);
  figures["believed_height_error_max_m"] = max_height_error_;
}

}  // namespace skein::campaign
