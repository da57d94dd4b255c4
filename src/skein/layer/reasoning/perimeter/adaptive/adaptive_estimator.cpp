// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/adaptive/adaptive_estimator.h"

#include <algorithm>
#include <cmath>

namespace skein::perimeter {
namespace {

// The mean of 20 squared standard normal numbers stays below this 19 times of 20: only
// beyond is a belief taken for too narrow.
constexpr double kConsistentSquare = 1.57;
constexpr std::size_t kMinCrossings = 10;  // before a record says anything
constexpr std::size_t kFullRecord = 20;    // crossings by which joint is suspected
// One honest record of 20 crossings in 300 has a larger mean square.
constexpr double kSuspectSquare = 2;

template <class Watched>
BoundaryEstimate consistent_boundary(const Watched& watched) {
  BoundaryEstimate boundary = watched.estimator.boundary();
  if (watched.forecasts.recent() < kMinCrossings) return boundary;
  const double missing = watched.forecasts.mean_square() / kConsistentSquare;
  if (missing <= 1) return boundary;
  for (auto& ring : boundary.rings)
    for (BoundaryPoint& point : ring) point.sigma *= std::sqrt(missing);
  return boundary;
}

Time time_of(const Observation& observation) {
  return std::visit([](const auto& o) { return o.time; }, observation);
}

}  // namespace

AdaptiveEstimator::AdaptiveEstimator(const PerimeterPrior& prior,
                                     const AdaptiveOptions& options)
    : prior_(prior), options_(options), joint_(JointEstimator(prior, options.joint)) {}

std::unique_ptr<PerimeterEstimator> AdaptiveEstimator::clone() const {
  return std::make_unique<AdaptiveEstimator>(*this);
}

// With the method that is in use, and no trial of the other.
std::unique_ptr<PerimeterEstimator> AdaptiveEstimator::outlook() const {
  auto ahead = std::make_unique<AdaptiveEstimator>(*this);
  if (ahead->joint_)
    ahead->ensemble_.reset();
  else
    ahead->ensemble_->estimator.look_ahead();
  return ahead;
}

void AdaptiveEstimator::predict(Time time) {
  time_ = time;
  if (joint_) joint_->estimator.predict(time);
  if (ensemble_ && caught_up()) ensemble_->estimator.predict(time);
}

void AdaptiveEstimator::observe(const FireReading& reading) {
  learn(reading);
}

void AdaptiveEstimator::observe(const Crossing& crossing) {
  // Forecasts are judged before the crossing is learned from.
  std::optional<double> joint, ensemble;
  if (joint_) {
    joint = joint_->judge(crossing);
    if (unwatched_.due(time_)) unwatched_.keep(joint_->estimator.boundary());
    unwatched_.see(crossing);
  }
  if (ensemble_ && caught_up()) ensemble = ensemble_->judge(crossing);
  if (joint && ensemble) lead_ += *ensemble - *joint;
  learn(crossing);
  if (joint_ && !ensemble_) begin_trial();
  if (joint_ && ensemble_) decide();
}

void AdaptiveEstimator::learn(const Observation& observation) {
  const auto observe = [](auto& watched) {
    return [&watched](const auto& o) { watched->estimator.observe(o); };
  };
  if (ensemble_ && caught_up()) {
    std::visit(observe(ensemble_), observation);
    if (joint_) ++replayed_;
  }
  if (!joint_) return;
  std::visit(observe(joint_), observation);
  log_.add(observation);
  if (ensemble_) catch_up();
}

// A share of the past with every new observation: no single step takes long.
void AdaptiveEstimator::catch_up() {
  for (int i = 0; i < options_.replay && !caught_up(); ++i) {
    const Observation& observation = log_.at(replayed_++);
    ensemble_->estimator.predict(time_of(observation));
    std::visit([this](const auto& o) { ensemble_->estimator.observe(o); }, observation);
  }
  if (caught_up()) ensemble_->estimator.predict(time_);
}

void AdaptiveEstimator::begin_trial() {
  const ConfidenceMonitor& forecasts = joint_->forecasts;
  if (forecasts.recent() < kFullRecord || forecasts.judged() < next_trial_ ||
      forecasts.mean_square() < kSuspectSquare)
    return;
  ensemble_.emplace(EnsembleEstimator(prior_, options_.ensemble));
  replayed_ = 0;
  lead_ = 0;
}

void AdaptiveEstimator::decide() {
  if (lead_ < -options_.lead) {
    ensemble_.reset();
    next_trial_ = 2 * joint_->forecasts.judged();
    return;
  }
  if (lead_ <= options_.lead) return;
  past_outliers_ = joint_->estimator.health().outliers;
  joint_.reset();
  log_ = {};
  replayed_ = 0;
}

BoundaryEstimate AdaptiveEstimator::boundary() const {
  if (!joint_) return consistent_boundary(*ensemble_);
  BoundaryEstimate boundary = consistent_boundary(*joint_);
  unwatched_.widen(boundary);
  return boundary;
}

EstimatorHealth AdaptiveEstimator::health() const {
  EstimatorHealth health =
      joint_ ? joint_->estimator.health() : ensemble_->estimator.health();
  health.outliers += past_outliers_;
  health.method = joint_ ? "joint" : "ensemble";
  return health;
}

}  // namespace skein::perimeter
