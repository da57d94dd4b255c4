// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/ensemble/ensemble_estimator.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "skein/base/math.h"
#include "skein/layer/reasoning/perimeter/ensemble/mean_boundary.h"
#include "skein/model/probability/normal.h"
#include "skein/model/probability/truncated_normal.h"

namespace skein::perimeter {
namespace {

constexpr double kImplausible = 0.02;   // a reading less probable needs others that agree
constexpr double kImpossible = 1e-4;    // less probable: the members know nothing of it
constexpr double kSurpriseSigma2 = 16;  // squared innovation, over its variance
constexpr double kHeld = 0.02;   // probability of being false from which a crossing waits
constexpr double kSure = 0.999;  // readings expected with more are trials
constexpr double kConfirmSeconds = 0.9;  // apart, two that agree are believed

}  // namespace

EnsembleEstimator::EnsembleEstimator(const PerimeterPrior& prior,
                                     const EnsembleOptions& options)
    : options_(options), ensemble_(prior, options), false_rate_(options.false_rate) {}

std::unique_ptr<PerimeterEstimator> EnsembleEstimator::clone() const {
  return std::make_unique<EnsembleEstimator>(*this);
}

std::unique_ptr<PerimeterEstimator> EnsembleEstimator::outlook() const {
  auto ahead = std::make_unique<EnsembleEstimator>(*this);
  ahead->look_ahead();
  return ahead;
}

void EnsembleEstimator::predict(Time time) {
  if (time <= time_) return;
  ensemble_.predict((time - time_).seconds());
  time_ = time;
}

bool EnsembleEstimator::repeated(const FireReading& reading,
                                 const AircraftMemory& memory) const {
  const auto last = memory.used.find(reading.inside);
  return last != memory.used.end() &&
         (reading.time - last->second.time).seconds() < options_.repeat_time &&
         (reading.point - last->second.point).norm() < options_.repeat_distance;
}

void EnsembleEstimator::observe(const FireReading& reading) {
  ++health_.observations;
  AircraftMemory& memory = memory_[reading.aircraft];
  if (const auto held = std::exchange(memory.held, std::nullopt))
    settle_held(*held, held->entered == reading.inside);
  const MemberValues distance = ensemble_.distance(reading.point);
  const double noise = reading.point_sd * reading.point_sd +
                       math::squared(options_.sigma_floor_cells * ensemble_.grid().cell);
  const double sd = std::sqrt(distance.variance + noise);
  const double z = distance.mean / sd;
  const double expected = model::normal_cdf(reading.inside ? -z : z);

  const bool implausible = expected < kImplausible;
  if (implausible && !confirmed(reading, memory)) {
    ++health_.outliers;
    return;
  }
  if (!implausible) memory.contradiction.count = 0;
  if (expected > kSure) false_rate_.count(false);
  ensemble_.remember(reading.point, reading.inside);
  if (expected > options_.sure) return;
  if (expected > 0.5 && repeated(reading, memory)) return;
  memory.used[reading.inside] = {reading.time, reading.point};
  if (expected < kImpossible) {
    believe(reading.point, reading.inside, distance);
    return;
  }
  // Inside is phi < 0. Once others agree, a wrong reading is out of the question.
  const double eps = implausible ? 0 : false_rate_.mean();
  const double if_above = reading.inside ? eps : 1 - eps;
  const model::MixtureMoments after =
      model::uncertain_half_line(distance.mean, sd, 0, if_above, 1 - if_above);
  // From the noisy distance to the distance itself: x + K (m - z), P - K (S - C) K'.
  const double gain = distance.variance / (sd * sd);
  const double shift = gain * (after.mean - distance.mean);
  const double variance = distance.variance - gain * gain * (sd * sd - after.variance);
  ensemble_.regress(reading.point, distance, shift,
                    std::sqrt(std::max(variance, 0.0) / distance.variance));
}

bool EnsembleEstimator::confirmed(const FireReading& reading, AircraftMemory& memory) {
  Contradiction& contradiction = memory.contradiction;
  if (contradiction.count == 0 || contradiction.inside != reading.inside)
    contradiction = {0, reading.time, reading.inside};
  ++contradiction.count;
  return (reading.time - contradiction.first).seconds() >= kConfirmSeconds;
}

void EnsembleEstimator::believe(const Vec2& point, bool inside,
                                const MemberValues& distance) {
  const double deep = std::abs(distance.mean);
  const double new_sd = 0.3 * deep + ensemble_.grid().cell;
  if (deep < 0.3 * ensemble_.reach()) {
    // The boundary is wrong by more than the members allow: move it just past the point
    // and spread the members over what that leaves open.
    const double past = (inside ? -1 : 1) * new_sd;
    ensemble_.displace(
        point, (past - distance.mean + 0.5 * new_sd * ensemble_.draw().array()).matrix());
    return;
  }
  // Too deep to belong to the known boundary: a part of its own.
  const double base = 3 * ensemble_.grid().cell;
  ensemble_.stamp(
      point, inside,
      (base * (0.4 * ensemble_.draw().array()).unaryExpr(&math::exp)).matrix());
}

void EnsembleEstimator::observe(const Crossing& crossing) {
  AircraftMemory& memory = memory_[crossing.aircraft];
  if (memory.held && memory.held->entered != crossing.entered) {
    // Back where it was: the later reading is one like those before the held crossing.
    observe(FireReading{crossing.time, crossing.aircraft,
                        crossing.point + 0.5 * crossing.track, crossing.point_sd,
                        crossing.entered});
    return;
  }
  ++health_.observations;
  if (const auto held = std::exchange(memory.held, std::nullopt))
    settle_held(*held, true);
  // The later reading agrees with those that follow on its side.
  memory.contradiction = {1, crossing.time, crossing.entered};
  if (false_rate_.mean() > kHeld * passage(crossing).probability) {
    memory.held = crossing;
    return;
  }
  use(crossing);
}

// A crossing that the next reading takes back was a false reading.
void EnsembleEstimator::settle_held(const Crossing& held, bool confirmed) {
  if (confirmed)
    use(held);
  else
    false_rate_.count(true);
}

EnsembleEstimator::Passage EnsembleEstimator::passage(const Crossing& crossing) const {
  Passage out;
  out.distance = ensemble_.distance(crossing.point);
  const Vec2 gradient = ensemble_.gradient(crossing.point);
  const double slope = gradient.norm();
  // The boundary is anywhere between the two readings: along the normal that is a share
  // of the track; at least half of it because the normal is uncertain too.
  double along = crossing.track.norm();
  if (slope > 0.1)
    along *= std::max(
        0.5, std::abs(gradient.dot(crossing.track)) / std::max(slope * along, 1e-9));
  const double noise = crossing.point_sd * crossing.point_sd +
                       math::squared(options_.sigma_floor_cells * ensemble_.grid().cell);
  out.variance = along * along / 12 + noise;
  out.innovation2 =
      math::squared(out.distance.mean) / (out.distance.variance + out.variance);
  const double sd = std::sqrt(out.distance.variance + noise);
  out.probability = model::normal_cdf((0.5 * along - out.distance.mean) / sd) -
                    model::normal_cdf((-0.5 * along - out.distance.mean) / sd);
  return out;
}

void EnsembleEstimator::use(const Crossing& crossing) {
  const Passage here = passage(crossing);
  if (unwatched_.due(time_)) unwatched_.keep(mean_boundary(ensemble_, time_, options_));
  unwatched_.see(crossing);
  if (here.innovation2 > kSurpriseSigma2) {
    ++health_.outliers;
    adapt(here.innovation2, 1);
    return;
  }
  adapt(here.innovation2,
        here.distance.variance / (here.distance.variance + here.variance));
  pass_through(crossing.point, here.distance, here.variance);
  memory_[crossing.aircraft].used.clear();
}

void EnsembleEstimator::pass_through(const Vec2& point, const MemberValues& distance,
                                     double variance) {
  // An innovation beyond two sigma says that the members are too close together.
  const double prior =
      std::max(distance.variance, distance.mean * distance.mean / 4 - variance);
  const double gain = prior / (prior + variance);
  const double after = std::min(gain * variance, distance.variance);
  ensemble_.regress(point, distance, -gain * distance.mean,
                    std::sqrt(after / distance.variance));
}

void EnsembleEstimator::adapt(double innovation2, double share) {
  // Only as far as the members' spread, not the crossing's own error, was put to the
  // test.
  const double surprise = share * (std::min(innovation2, 9.0) - 1);
  ensemble_.set_noise_factor(
      std::clamp(ensemble_.noise_factor() * math::exp(0.02 * surprise), 0.05, 20.0));
}

BoundaryEstimate EnsembleEstimator::boundary() const {
  BoundaryEstimate boundary = mean_boundary(ensemble_, time_, options_);
  unwatched_.widen(boundary);
  return boundary;
}

}  // namespace skein::perimeter
