// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/keeping/keeping_watch.h"

#include <algorithm>
#include <cmath>

#include "skein/base/math.h"

namespace skein::campaign {
namespace {

constexpr double kTurns = geo::radians(2);  // of a leg's direction [rad/s]

}  // namespace

void KeepingWatch::Errors::add(double error) {
  square += error * error;
  count += 1;
  max = std::max(max, std::abs(error));
}

void KeepingWatch::record(const Record& record) {
  if (const auto* truth = std::get_if<TruthRecord>(&record)) take(*truth);
  if (const auto* estimate = std::get_if<EstimateRecord>(&record)) take(*estimate);
  if (const auto* event = std::get_if<Event>(&record)) take(*event);
}

void KeepingWatch::take(const TruthRecord& truth) {
  if (truth.id != keeping_.aircraft) return;
  const Time time = truth.time;
  const VehicleState& state = truth.state;
  dt_ = (time - now_).seconds();
  now_ = time;
  state_ = state;
}

void KeepingWatch::take(const EstimateRecord& record) {
  const NavEstimate& estimate = record.nav;
  const AutopilotStatus& status = record.status;
  if (record.id != keeping_.aircraft || now_.seconds() < keeping_.settling) return;
  if (keeping_.hovers_at) {
    const Vec3 place(keeping_.hovers_at->x(), keeping_.hovers_at->y(),
                     -keeping_.altitude_msl);
    hover_.add((state_.p_N - place).norm());
    hover_believed_.add((estimate.p_N - place).norm());
    return;
  }
  height_.add(-state_.p_N.z() - keeping_.altitude_msl);
  airspeed_.add(state_.airspeed - keeping_.airspeed);
  keep_to_route(estimate, status);
}

void KeepingWatch::keep_to_route(const NavEstimate& estimate,
                                 const AutopilotStatus& status) {
  const Vec2 before = along_;
  along_ = status.along;
  if (!status.follows || along_.isZero() || before.isZero() || dt_ <= 0) return;
  const Vec2 wrong = geo::horizontal(state_.p_N - estimate.p_N);
  const double across = status.cross_track + geo::turned_right(along_).dot(wrong);
  const double turned = math::atan2(geo::cross(before, along_), before.dot(along_));
  (std::abs(turned) > kTurns * dt_ ? turns_ : straights_).add(across);
  believed_.add(status.cross_track);
}

void KeepingWatch::take(const Event& event) {
  if (event.entity == keeping_.aircraft && event.kind == EventKind::kAccident)
    accident_ = true;
}

void KeepingWatch::add_figures(std::map<std::string, double>& figures) const {
  const auto rms = [&](const char* name, const Errors& errors) {
    if (errors.count > 0) figures[name] = std::sqrt(errors.square / errors.count);
  };
  const auto max = [&](const char* name, const Errors& errors) {
    if (errors.count > 0) figures[name] = errors.max;
  };
  rms("straights_rms_m", straights_);
  rms("turns_rms_m", turns_);
  rms("believed_rms_m", believed_);
  rms("airspeed_rms_mps", airspeed_);
  max("height_max_m", height_);
  max("hover_max_m", hover_);
  max("hover_believed_max_m", hover_believed_);
  figures["accident"] = accident_;
}

}  // namespace skein::campaign
