// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/joint/joint_estimator.h"

#include <algorithm>
#include <cmath>

#include "skein/base/check.h"
#include "skein/base/math.h"

namespace skein::perimeter {
namespace {

constexpr double kForget = 1e-6;  // share of the weights returned per reading
constexpr double kFloor = 1e-6;   // maximum that one reading takes from a weight
constexpr double kLost = 1e-3;    // weight below which a hypothesis counts for nothing
constexpr double kWidening = 3;   // sigma that a boundary may be off after widening
constexpr double kMinReportedRadius = 1;  // of a reported point [m]
constexpr double kMinFrame = 20;          // the polar frame ends here [m]
constexpr double kSteep = 1;              // slope over radius of a flank
constexpr double kWall = 10;              // the same of one that counts as no steeper
constexpr double kBlur = 0.1;             // part of a flank's height that is unknown
constexpr double kHeld = 2.5;   // sigma from which a crossing waits for the next reading
constexpr double kSure = 1e-3;  // readings less probable contradict a sure belief

}  // namespace

JointEstimator::JointEstimator(const PerimeterPrior& prior, const JointOptions& options)
    : JointEstimator(prior, options, boundary_hypotheses(prior)) {}

JointEstimator::JointEstimator(const PerimeterPrior& prior, const JointOptions& options,
                               const std::vector<BoundaryHypothesis>& hypotheses)
    : prior_(prior), options_(options), false_rate_(options.false_rate) {
  SKEIN_CHECK(!hypotheses.empty());
  hypotheses_ = hypotheses;
  double total = 0;
  for (const BoundaryHypothesis& hypothesis : hypotheses) total += hypothesis.weight;
  filters_.reserve(hypotheses.size());
  for (const BoundaryHypothesis& hypothesis : hypotheses) {
    filters_.emplace_back(prior, hypothesis, options.knots, options.aircraft);
    prior_weights_.push_back(hypothesis.weight / total);
  }
  weights_ = prior_weights_;
  evidence_.resize(weights_.size());
  aircraft_.reserve(static_cast<std::size_t>(options.aircraft));
}

int JointEstimator::slot(EntityId id) {
  for (std::size_t i = 0; i < aircraft_.size(); ++i) {
    if (aircraft_[i].id == id) return static_cast<int>(i);
  }
  if (aircraft_.size() == aircraft_.capacity()) {
    aircraft_.reserve(2 * aircraft_.size() + 1);
    for (BoundaryFilter& filter : filters_) {
      filter.reserve_aircraft(static_cast<int>(aircraft_.capacity()));
    }
  }
  aircraft_.emplace_back();
  aircraft_.back().id = id;
  return static_cast<int>(aircraft_.size()) - 1;
}

void JointEstimator::predict(Time time) {
  const double dt = (time - time_).seconds();
  SKEIN_CHECK(dt >= 0, dt);
  time_ = time;
  for (BoundaryFilter& filter : filters_) filter.predict(dt);
  restart_invalid();
}

// A filter whose numbers have run away starts again from what was given at the beginning.
void JointEstimator::restart_invalid() {
  for (std::size_t i = 0; i < filters_.size(); ++i) {
    if (filters_[i].sound()) continue;
    filters_[i] = BoundaryFilter(prior_, hypotheses_[i], options_.knots,
                                 static_cast<int>(aircraft_.capacity()));
    weights_ = prior_weights_;
    ++health_.outliers;
  }
}

void JointEstimator::observe(const FireReading& reading) {
  read(reading, false);
}

void JointEstimator::read(const FireReading& reading, bool changed) {
  const Vec2 offset = reading.point - prior_.origin;
  PolarReading polar;
  polar.bearing = geo::bearing(offset);
  polar.distance = offset.norm();
  polar.inside = reading.inside;
  polar.position_sd = reading.point_sd;
  learn(reading.aircraft, polar, changed);
}

void JointEstimator::observe(const Crossing& crossing) {
  // When the earlier reading was itself the later one of a crossing, it has been counted.
  if (aircraft_[static_cast<std::size_t>(slot(crossing.aircraft))].crossed) {
    read(FireReading{crossing.time, crossing.aircraft,
                     crossing.point + 0.5 * crossing.track, crossing.point_sd,
                     crossing.entered},
         true);
    return;
  }
  const Vec2 offset = crossing.point - prior_.origin;
  const Vec2 e_r = offset.norm() > 0 ? Vec2(offset.normalized()) : Vec2(1, 0);
  PolarReading polar;
  polar.bearing = geo::bearing(offset);
  polar.distance = offset.norm();
  polar.inside = crossing.entered;
  polar.position_sd = crossing.point_sd;
  polar.crossing = true;
  polar.radial = crossing.track.dot(e_r);
  polar.tangential = crossing.track.dot(geo::turned_right(e_r));
  polar.period = options_.period;
  learn(crossing.aircraft, polar, true);
}

void JointEstimator::learn(EntityId id, PolarReading reading, bool changed) {
  const int index = slot(id);
  Aircraft& aircraft = aircraft_[static_cast<std::size_t>(index)];
  note(aircraft, reading);
  settle_held(index, reading);
  if (changed && may_be_false(reading)) {
    aircraft.held = reading;
    aircraft.held_since = time_;
    return;
  }
  use(index, reading);
}

// What the readings before say about this one: its period, and how much of its position
// error is theirs.
void JointEstimator::note(Aircraft& aircraft, PolarReading& reading) {
  if (aircraft.has_last) {
    const double period = (time_ - aircraft.last).seconds();
    if (period > 0) reading.period = period;
  }
  if (reading.crossing) {
    // An error that wanders slowly is the same in successive crossings: they count as
    // few.
    if (aircraft.has_crossed && options_.position_correlation > 0) {
      const double apart =
          std::max((time_ - aircraft.last_crossing).seconds(), reading.period);
      const double same = math::exp(-apart / options_.position_correlation);
      reading.position_sd *= std::sqrt((1 + same) / (1 - same));
    }
    aircraft.last_crossing = time_;
    aircraft.has_crossed = true;
  }
  aircraft.last = time_;
  aircraft.has_last = true;
  aircraft.crossed = reading.crossing;
  ++health_.observations;
}

bool JointEstimator::may_be_false(const PolarReading& reading) const {
  double probability = 0;
  for (std::size_t i = 0; i < filters_.size(); ++i)
    probability += weights_[i] * filters_[i].probability(reading);
  return false_rate_.mean() > kHeld * probability;
}

// A change of sides that the next reading takes back was a false reading; one that it
// confirms counts, and is not held against the sensor.
void JointEstimator::settle_held(int index, const PolarReading& next) {
  Aircraft& aircraft = aircraft_[static_cast<std::size_t>(index)];
  if (!aircraft.held) return;
  PolarReading held = *aircraft.held;
  aircraft.held.reset();
  if (held.inside == next.inside) {
    held.age = (time_ - aircraft.held_since).seconds();
    use(index, held);
  } else {
    false_rate_.count(true);
  }
}

void JointEstimator::use(int index, const PolarReading& reading) {
  Aircraft& aircraft = aircraft_[static_cast<std::size_t>(index)];
  double probability = 0;
  for (std::size_t i = 0; i < filters_.size(); ++i) {
    evidence_[i] = filters_[i].probability(reading);
    probability += weights_[i] * evidence_[i];
  }
  if (!reading.crossing && probability > 1 - kSure) false_rate_.count(false);
  if (probability < options_.outlier) {
    ++health_.outliers;
    if (++aircraft.suspects <= options_.patience) return;
  } else {
    aircraft.suspects = 0;
  }
  double total = 0;
  for (std::size_t i = 0; i < filters_.size(); ++i) {
    if (probability < options_.outlier && evidence_[i] < options_.outlier) {
      filters_[i].widen(reading.bearing, reading.distance, kWidening);
    }
    evidence_[i] = filters_[i].observe(index, reading, false_rate_.mean());
    weights_[i] *= std::max(evidence_[i], kFloor * probability);
    total += weights_[i];
  }
  for (std::size_t i = 0; i < filters_.size(); ++i) {
    weights_[i] = (1 - kForget) * weights_[i] / total + kForget * prior_weights_[i];
  }
  restart_invalid();
}

BoundaryFilter::Local JointEstimator::at(double bearing) const {
  BoundaryFilter::Local mixed;
  double square = 0, product = 0, growth_square = 0, counted = 0;
  for (const double weight : weights_) counted += weight < kLost ? 0 : weight;
  for (std::size_t i = 0; i < filters_.size(); ++i) {
    const BoundaryFilter::Local local = filters_[i].at(bearing);
    const double w = weights_[i] < kLost ? 0 : weights_[i] / counted;
    mixed.radius += w * local.radius;
    mixed.slope += w * local.slope;
    mixed.growth += w * local.growth;
    square += w * (local.variance + local.radius * local.radius);
    product += w * (local.covariance + local.radius * local.growth);
    growth_square += w * (local.growth_variance + local.growth * local.growth);
  }
  mixed.variance = std::max(0.0, square - mixed.radius * mixed.radius);
  mixed.covariance = product - mixed.radius * mixed.growth;
  mixed.growth_variance = std::max(0.0, growth_square - mixed.growth * mixed.growth);
  return mixed;
}

// Deviation of what a radius over bearing cannot show [m]: flanks so steep that the fire
// hardly is star-shaped there, to a part of the change of radius between knots; and
// anything nearer to the origin than the frame reaches.
double JointEstimator::blur(const BoundaryFilter::Local& local) const {
  const double radius = std::max(local.radius, kMinFrame);
  const double steep =
      std::clamp(std::abs(local.slope), kSteep * radius, kWall * radius) -
      kSteep * radius;
  const double flank = kBlur * steep * 2 * geo::kPi / options_.knots;
  return math::hypot(flank, std::max(0.0, kMinFrame - local.radius));
}

BoundaryPoint JointEstimator::point_at(double bearing) const {
  const BoundaryFilter::Local local = at(bearing);
  const double radius = std::max(local.radius, kMinReportedRadius);
  const Vec2 e_r = geo::unit(bearing);
  const double tilt = local.slope / radius;
  const double upright =
      1 / std::sqrt(1 + tilt * tilt);  // cosine between normal and radius
  const double horizon = options_.growth_horizon;
  const double sigma = std::sqrt(local.variance);
  const double later =
      std::sqrt(std::max(0.0, local.variance + 2 * horizon * local.covariance +
                                  horizon * horizon * local.growth_variance));
  BoundaryPoint point;
  point.position = prior_.origin + radius * e_r;
  point.normal = (e_r - tilt * geo::turned_right(e_r)) * upright;
  point.sigma = math::hypot(upright * sigma, blur(local));
  point.sigma_growth = upright * (later - sigma) / horizon;
  point.rate = upright * local.growth;
  return point;
}

// Bearings of points at equal arc length of at most `spacing`, from a fine polygon.
std::vector<double> JointEstimator::spaced_bearings(double spacing) const {
  constexpr std::size_t kFine = 720;
  constexpr double kStep = 2 * geo::kPi / kFine;
  std::vector<double> length(kFine + 1, 0.0);
  Vec2 last(std::max(at(0).radius, kMinReportedRadius), 0);
  for (std::size_t i = 1; i <= kFine; ++i) {
    const double bearing = kStep * static_cast<double>(i);
    const Vec2 point =
        std::max(at(bearing).radius, kMinReportedRadius) * geo::unit(bearing);
    length[i] = length[i - 1] + (point - last).norm();
    last = point;
  }
  constexpr double kMinPoints = 8, kMaxPoints = 5000;
  const int count = static_cast<int>(
      std::clamp(std::ceil(length.back() / spacing), kMinPoints, kMaxPoints));
  std::vector<double> bearings;
  std::size_t cell = 0;
  for (int i = 0; i < count; ++i) {
    const double target = length.back() * i / count;
    while (length[cell + 1] < target) ++cell;
    const double part = (target - length[cell]) / (length[cell + 1] - length[cell]);
    bearings.push_back(kStep * (static_cast<double>(cell) + part));
  }
  return bearings;
}

BoundaryEstimate JointEstimator::boundary() const {
  std::vector<double> bearings;
  if (options_.spacing > 0) {
    bearings = spaced_bearings(options_.spacing);
  } else {
    for (int i = 0; i < options_.control_points; ++i) {
      bearings.push_back(2 * geo::kPi * i / options_.control_points);
    }
  }
  BoundaryEstimate estimate;
  estimate.time = time_;
  auto& ring = estimate.rings.emplace_back();
  ring.reserve(bearings.size());
  for (const double bearing : bearings) ring.push_back(point_at(bearing));
  return estimate;
}

std::unique_ptr<PerimeterEstimator> JointEstimator::clone() const {
  return std::make_unique<JointEstimator>(*this);
}

}  // namespace skein::perimeter
