// SPDX-License-Identifier: Apache-2.0
// Estimators and strategies of perimeter missions: one row each.

#include "skein/assemble/kinds/kinds_of.h"
#include "skein/assemble/kinds/ranges.h"
#include "skein/layer/reasoning/perimeter/adaptive/adaptive_estimator.h"
#include "skein/layer/reasoning/perimeter/ensemble/ensemble_estimator.h"
#include "skein/layer/reasoning/perimeter/joint/joint_estimator.h"
#include "skein/layer/reasoning/perimeter/pointwise/pointwise_kinds.h"
#include "skein/layer/reasoning/perimeter/strategy/ellipse.h"
#include "skein/layer/reasoning/perimeter/strategy/gus.h"
#include "skein/layer/reasoning/perimeter/strategy/partition.h"
#include "skein/layer/reasoning/perimeter/strategy/sweep.h"
#include "skein/layer/reasoning/perimeter/strategy/tracking.h"

namespace skein::assemble {
namespace {

using namespace perimeter;
using scenario::Fields;

constexpr scenario::Range kPositive{.above = 0, .at_most = 1e6};
constexpr scenario::Range kEdgeAngle{.above = 0, .at_most = 90};
constexpr scenario::Range kFalseReadings{.at_least = 0, .below = 0.5};

constexpr scenario::IntegerRange kControlPoints{.at_least = 8, .at_most = 5000};

// All particles have four numbers; this many take 160 MB.
std::vector<scenario::RuleViolation> particle_errors(const PointwiseOptions& o,
                                                     const scenario::ValidValues& valid) {
  constexpr std::int64_t kMaxParticles = 5'000'000;
  if (!valid("particles", "control_points")) return {};
  if (std::int64_t{o.particles} * o.control_points <= kMaxParticles) return {};
  return {{"particles",
           fmt::format("{} for each of {} points are too much memory; at most {} are "
                       "allowed for so many points.",
                       o.particles, o.control_points, kMaxParticles / o.control_points),
           {"control_points"}}};
}

// Each kind has the keys that it uses.
Fields<PointwiseOptions> pointwise_fields(const std::string& kind) {
  using T = PointwiseOptions;
  Fields<T> fields;
  fields
      .integer("control_points", &T::control_points, "Points of the believed perimeter.",
               kControlPoints)
      .number("process_noise", &T::process_noise,
              "Spectral density of the points' acceleration per axis, in m^2/s^3.",
              {.at_least = 0, .at_most = 100})
      .number("sensor_sd_m", &T::sensor_sd, "Standard deviation of the sensor's range.",
              kPositive);
  if (kind == "point-reset")
    fields
        .number("min_sd_m", &T::min_sd,
                "Minimum standard deviation after a crossing, per axis.", kPositive)
        .formerly("least_sd_m");
  else
    fields
        .number("gate_sigmas", &T::gate_sigmas,
                "A reading counts for points nearer than this many standard deviations.",
                {.above = 0, .at_most = 100})
        .boolean("use_crossings", &T::use_crossings,
                 "Whether a crossing corrects the nearest point.");
  if (kind == "mle" || kind == "map")
    fields.number("sigma_v_m", &T::sigma_v, "Standard deviation of the bound.",
                  kPositive);
  if (kind == "particle")
    fields
        .integer("particles", &T::particles, "Samples per point.",
                 {.at_least = 20, .at_most = 100000})
        .number("false_rate", &T::false_rate, "Probability that a reading is false.",
                kFalseReadings)
        .rules_of_valid(particle_errors);
  return fields;
}

Fields<JointOptions> joint_fields() {
  using T = JointOptions;
  return Fields<T>()
      .integer("control_points", &T::control_points,
               "Points of the believed perimeter, at equal bearings.", kControlPoints)
      .number(
          "spacing_m", &T::spacing,
          "Above 0: points at equal arc length of at most this (5000 points at most), "
          "instead of control_points at equal bearings.",
          kNotNegative)
      .integer("knots", &T::knots, "Unknowns of the radius, and as many of the rate.",
               {.at_least = 8, .at_most = 720})
      .number("false_rate", &T::false_rate,
              "Probability that a reading is wrong, at first; it is learned.",
              kFalseReadings)
      .number("outlier", &T::outlier, "Readings less probable than this are set aside.",
              {.at_least = 0, .at_most = 0.1})
      .integer("patience", &T::patience,
               "Outliers in a row before the belief is corrected instead.",
               {.at_least = 1, .at_most = 1000})
      .duration_s("position_correlation_s", &T::position_correlation,
                  "Correlation time of the aircraft's position errors.")
      .duration_s("growth_horizon_s", &T::growth_horizon,
                  "Time over which the growth of the uncertainty is averaged.",
                  {.above = 0});
}

// Every member has a number at every node; this many take 160 MB.
std::vector<scenario::RuleViolation> ensemble_errors(const EnsembleOptions& o,
                                                     const scenario::ValidValues& valid) {
  constexpr std::int64_t kMaxNumbers = 40'000'000;
  if (!valid("members", "max_nodes")) return {};
  if (std::int64_t{o.members} * o.max_nodes <= kMaxNumbers) return {};
  return {{"max_nodes",
           fmt::format("{} nodes of {} members are too much memory; at most {} nodes are "
                       "allowed for so many members.",
                       o.max_nodes, o.members, kMaxNumbers / o.members),
           {"members"}}};
}

Fields<EnsembleOptions> ensemble_fields() {
  using T = EnsembleOptions;
  return Fields<T>()
      .integer("members", &T::members, "Size of the ensemble.",
               {.at_least = 8, .at_most = 200})
      .number("cell_m", &T::cell, "Finest spacing of the grid.",
              {.at_least = 0.5, .at_most = 1000})
      .integer("max_nodes", &T::max_nodes,
               "Nodes of the grid; beyond, its spacing doubles.",
               {.at_least = 10000, .at_most = 10000000})
      .duration_s("step_s", &T::step, "Longest step of the fronts.", {.above = 0})
      .number("control_spacing_m", &T::control_spacing,
              "Longest distance between boundary points.", kPositive)
      .number("min_area_m2", &T::min_area, "Smaller parts and holes are not reported.",
              kNotNegative)
      .duration_s("rate_memory_s", &T::rate_memory, "In which a local rate is forgotten.",
                  {.above = 0})
      .number("roughness", &T::roughness, "Of the boundary's noise, against its rate's.",
              {.at_least = 0, .at_most = 10})
      .number("false_rate", &T::false_rate,
              "Probability of a wrong in/out reading, at first; it is learned.",
              kFalseReadings)
      .number("sure", &T::sure, "Readings expected with more than this are skipped.",
              {.at_least = 0.5, .below = 1})
      .number("repeat_distance_m", &T::repeat_distance,
              "A reading this near to the last one used, of the same aircraft and side, "
              "is the same one.",
              kNotNegative)
      .duration_s("repeat_time_s", &T::repeat_time, "The same in time.")
      .rules_of_valid(ensemble_errors);
}

// The keys that matter to both methods, or most to either.
struct AdaptiveKeys {
  int control_points = JointOptions{}.control_points;
  double spacing = JointOptions{}.spacing;
  double position_correlation = JointOptions{}.position_correlation;
  int members = EnsembleOptions{}.members;
  double cell = EnsembleOptions{}.cell;
  double false_rate = JointOptions{}.false_rate;
  double lead = AdaptiveOptions{}.lead;

  AdaptiveOptions options(std::uint64_t seed) const {
    AdaptiveOptions all;
    all.joint.control_points = control_points;
    all.joint.spacing = spacing;
    all.joint.position_correlation = position_correlation;
    all.joint.false_rate = all.ensemble.false_rate = false_rate;
    all.ensemble.members = members;
    all.ensemble.cell = cell;
    all.ensemble.seed = seed;
    all.lead = lead;
    return all;
  }
};

Fields<AdaptiveKeys> adaptive_fields() {
  using T = AdaptiveKeys;
  return Fields<T>()
      .integer("control_points", &T::control_points,
               "joint: points of the believed perimeter, at equal bearings.",
               kControlPoints)
      .number("spacing_m", &T::spacing,
              "joint: above 0, points at equal arc length of at most this, instead of "
              "control_points at equal bearings.",
              kNotNegative)
      .duration_s("position_correlation_s", &T::position_correlation,
                  "joint: correlation time of the aircraft's position errors.")
      .integer("members", &T::members, "ensemble: its size.",
               {.at_least = 8, .at_most = 200})
      .number("cell_m", &T::cell, "ensemble: finest spacing of the grid.",
              {.at_least = 0.5, .at_most = 1000})
      .number("false_rate", &T::false_rate,
              "Probability that a reading is wrong, at first; it is learned.",
              kFalseReadings)
      .number("lead", &T::lead,
              "The ensemble takes over when the crossings were more probable under it by "
              "this logarithm, all together.",
              {.at_least = 0, .at_most = 10000});
}

Fields<GusOptions> gus_fields() {
  using T = GusOptions;
  return Fields<T>()
      .number(
          "aim_sigmas", &T::aim_sigmas,
          "Aim this many standard deviations beyond the boundary: 0.6745 for the 50 % "
          "interval, 1.1774 for the 50 % ellipse.",
          {.at_least = 0, .at_most = 10})
      .number("min_reach_m", &T::min_reach, "Aim at least this far beyond it.",
              kNotNegative)
      .formerly("least_reach_m")
      .number("separation_m", &T::separation, "Between the targets of two aircraft.",
              kNotNegative)
      .duration_s("patience_s", &T::patience, "An order not done after this is renewed.",
                  {.above = 0})
      .duration_s("settle_s", &T::settle_time,
                  "Per second of flight: the constant in J / (t_go + constant).",
                  {.at_least = 0});
}

Fields<EllipseOptions> ellipse_fields() {
  using T = EllipseOptions;
  return Fields<T>()
      .number("separation_m", &T::separation, "Between the targets of two aircraft.",
              kNotNegative)
      .number("switch_ratio", &T::switch_ratio,
              "Change when another axis is this many times longer.",
              {.at_least = 1, .at_most = 100})
      .duration_s("patience_s", &T::patience, "An order not done after this is renewed.",
                  {.above = 0});
}

Fields<TrackingOptions> tracking_fields() {
  using T = TrackingOptions;
  return Fields<T>()
      .boolean("predicted", &T::predicted,
               "Follow the predicted edge instead of the real one.")
      .boolean("clockwise", &T::clockwise, "Sense of rotation, on the map.")
      .angle_deg("edge_angle_deg", &T::edge_angle,
                 "Real edge: between course and edge, to cross it again.", kEdgeAngle)
      .number("look_ahead_m", &T::look_ahead, "Predicted: length of the line ordered.",
              kPositive)
      .duration_s("renew_s", &T::renew_period,
                  "Predicted: the line is renewed this often.", {.above = 0});
}

Fields<SweepOptions> sweep_fields() {
  using T = SweepOptions;
  return Fields<T>()
      .angle_deg("edge_angle_deg", &T::edge_angle,
                 "Between course and edge, to cross it again.", kEdgeAngle)
      .duration_s("window_s", &T::window,
                  "Plan this far ahead along the edge, or an even share of it.",
                  {.above = 0})
      .number("follow_speed_mps", &T::follow_speed, "Progress along the edge.",
              {.above = 0, .at_most = 1000})
      .duration_s("decide_s", &T::decide_period, "Think of leaving the edge this often.",
                  {.above = 0})
      .number("leave_ratio", &T::leave_ratio,
              "Leave when elsewhere is this many times better.",
              {.at_least = 1, .at_most = 1000})
      .number("seen_again", &T::seen_again,
              "Worth of a place, for each other aircraft that will see it.",
              {.above = 0, .at_most = 1})
      .duration_s("commit_s", &T::commit, "Stay at least this long with a new place.");
}

}  // namespace

Kinds<PerimeterEstimator, EstimatorContext> estimator_kinds() {
  Kinds<PerimeterEstimator, EstimatorContext> kinds("estimator");
  kinds.add("joint",
            "The whole boundary and its rate as one Gaussian, with the wind; for fires "
            "that are star-shaped, or nearly so.",
            joint_fields(),
            [](const JointOptions& options, const EstimatorContext& context) {
              return std::make_unique<JointEstimator>(context.prior, options);
            });
  kinds.add("ensemble",
            "An ensemble of level sets: for fires of any shape, with islands.",
            ensemble_fields(),
            [](const EnsembleOptions& options, const EstimatorContext& context) {
              EnsembleOptions all = options;
              all.seed = context.seed;
              return std::make_unique<EnsembleEstimator>(context.prior, all);
            });
  kinds.add("adaptive",
            "Begins as joint, and hands over to ensemble where the crossings show that "
            "the fire's shape is not what joint assumes.",
            adaptive_fields(),
            [](const AdaptiveKeys& keys, const EstimatorContext& context) {
              return std::make_unique<AdaptiveEstimator>(context.prior,
                                                         keys.options(context.seed));
            });
  for (const PointwiseKind& kind : pointwise_kinds())
    kinds.add(kind.name, kind.help, pointwise_fields(kind.name),
              [&kind](const PointwiseOptions& options, const EstimatorContext& context) {
                return make_pointwise(kind, options, context.prior, context.seed);
              });
  return kinds;
}

Kinds<MonitoringStrategy, StrategyContext> strategy_kinds() {
  Kinds<MonitoringStrategy, StrategyContext> kinds("strategy");
  kinds.add("gus", "Greedy uncertainty suppression: the thesis's routing.", gus_fields(),
            [](const GusOptions& options, const StrategyContext&) {
              return std::make_unique<GusStrategy>(options, false);
            });
  kinds.add("gus-rate", "The same per second of flight.", gus_fields(),
            [](const GusOptions& options, const StrategyContext&) {
              return std::make_unique<GusStrategy>(options, true);
            });
  kinds.add("ellipse", "Fly to the tip of the largest major axis.", ellipse_fields(),
            [](const EllipseOptions& options, const StrategyContext&) {
              return std::make_unique<EllipseStrategy>(options);
            });
  kinds.add("tracking",
            "Evenly spaced aircraft follow the edge: the predicted one, or the real one, "
            "found with the in/out sensor or with an edge-finder.",
            tracking_fields(),
            [](const TrackingOptions& options, const StrategyContext&) {
              return std::make_unique<TrackingStrategy>(options);
            });
  kinds.add("partition", "Each aircraft watches its own arc, as gus-rate does.",
            gus_fields(), [](const GusOptions& options, const StrategyContext&) {
              return std::make_unique<PartitionStrategy>(options);
            });
  kinds.add("sweep",
            "Follow the real edge on the arc and in the direction that pay most, and cut "
            "across when another arc pays more.",
            sweep_fields(), [](const SweepOptions& options, const StrategyContext&) {
              return std::make_unique<SweepStrategy>(options);
            });
  return kinds;
}

}  // namespace skein::assemble
