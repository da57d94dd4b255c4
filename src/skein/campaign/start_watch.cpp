#include "skein/campaign/start_watch.h"

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
  tilt_most_ = std::max(tilt_most_, tilt);
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
  attitude_error_most_ = std::max(attitude_error_most_, attitude);
  height_error_most_ = std::max(height_error_most_, height);
  misled_.step(attitude > limits_.attitude_error || height > limits_.height_error, dt_);
  failsafe_ = failsafe_ || status.reaction != FailsafeReaction::kNone;
}

void StartWatch::take(const Event& event) {
  if (event.entity == aircraft_ && event.kind == "accident") accident_ = true;
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
  figures["tilt_most_deg"] = geo::degrees(tilt_most_);
  figures["attitude_error_most_deg"] = geo::degrees(attitude_error_most_);
  figures["believed_height_error_most_m"] = height_error_most_;
}

}  // namespace skein::campaign
