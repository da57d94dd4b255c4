// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "skein/data/vehicle/air.h"
#include "skein/data/vehicle/autopilot.h"
#include "skein/data/vehicle/sensing.h"
#include "skein/data/vehicle/vehicle.h"
#include "skein/layer/autopilot/estimator/error_covariance.h"
#include "skein/layer/autopilot/estimator/error_state.h"
#include "skein/layer/autopilot/estimator/estimator_options.h"
#include "skein/layer/autopilot/estimator/flight_alignment.h"
#include "skein/layer/autopilot/estimator/motion_history.h"
#include "skein/layer/autopilot/estimator/observations.h"
#include "skein/layer/autopilot/nav_state.h"

namespace skein::autopilot {

/// What is known at the start, and how well.
struct EstimatorStart {
  Time time;
  Vec3 p_N = Vec3::Zero();       ///< [m]
  Vec3 v_N = Vec3::Zero();       ///< over ground [m/s]
  Quat q_NB = Quat::Identity();  ///< at rest only its yaw counts, without magnetometer
  Vec2 wind_N = Vec2::Zero();    ///< [m/s]
  /// At rest the tilt and the gyros' biases are found first, and with a magnetometer the
  /// heading.
  bool at_rest = false;
  NavAccuracy sd{2, 3, 0.3, 0.02, 0.05, 2};
};

/// Position, velocity, attitude and mean wind from a vehicle's own sensors: an
/// error-state Kalman filter with 28 states; see error_state.h and docs/estimator.md.
///
/// Inertial samples move the state on; nothing else makes its time pass. Every
/// `EstimatorOptions::period` the covariance follows, and what came in since then
/// corrects the state, scalar by scalar. Samples that are not finite, or from before what
/// has been used, are dropped and counted. After a TruthSample the state is the truth,
/// and no other sample counts: for control without an estimator, at no cost.
///
/// A plain value of 5.2 KB that shares its options: it allocates nothing.
/// Reference: [Sola17] section 7 for the error-state filter with global attitude errors.
class FlightEstimator {
 public:
  /// How often what was taken in, or not.
  struct Counts {
    std::uint32_t bad = 0;         ///< not finite
    std::uint32_t late = 0;        ///< from before what has been used, or too late
    std::uint32_t rejected = 0;    ///< beyond the gate
    std::uint32_t gaps = 0;        ///< in the inertial samples
    std::uint32_t resets = 0;      ///< begun again after lasting rejection
    std::uint32_t alignments = 0;  ///< attitude found anew in flight
  };

  FlightEstimator(std::shared_ptr<const EstimatorOptions> options,
                  const EstimatorStart& start);
  /// With options of its own.
  FlightEstimator(const EstimatorOptions& options, const EstimatorStart& start)
      : FlightEstimator(std::make_shared<const EstimatorOptions>(options), start) {}

  /// Takes in one sample; those of no use are passed over.
  void sense(const SensorSample& sample);

  void add(const ImuSample& sample);
  void add(const GnssFix& fix);
  void add(const BarometerSample& sample);
  void add(const MagnetometerSample& sample);
  void add(const AirspeedSample& sample);
  void add(const AnemometerSample& sample);
  void add(const HeightSample& sample);
  void add(const TruthSample& sample);

  /// Whether the vehicle flies without lasting side-slip from now on: a fixed wing in the
  /// air does; on the ground, in a take-off run or while it lines up to touch down the
  /// nose points elsewhere. At first: unless it starts at rest.
  void set_coordinated(bool coordinated) { coordinated_ = coordinated; }

  /// Another unit of this kind is received from now on: what has been learnt of the
  /// errors of the old one is forgotten. Of no meaning for what has no such errors.
  void replaced(FlightSensor sensor);

  /// State at the last inertial sample (or truth).
  const NavState& state() const { return nav_; }
  /// The same for agents; its position_sd is that of the filter.
  NavEstimate estimate() const;
  /// As the filter believes; zero for the truth.
  NavAccuracy accuracy() const;

  /// Since the last fix that was used, or since the start [s].
  double gnss_age() const;
  bool gnss_lost() const { return gnss_age() > options_->gnss_lost_after; }
  /// Above ground [m], when it was measured within the last second.
  std::optional<double> height_agl() const;
  /// Whether the state is the truth.
  bool direct() const { return direct_; }
  /// Whether the tilt is still looked for, at rest.
  bool aligning() const { return aligning_; }
  /// Whether the satellites have contradicted the state for some time, far beyond what it
  /// states of itself: its attitude is then found anew, within seconds.
  bool diverged() const { return alignment_.has_value(); }
  /// Strength of the gusts along the flight, as estimated [m/s].
  double gust_sd() const;
  const Counts& counts() const { return counts_; }

  /// Everything that is estimated, with the covariance of its error as of the last
  /// correction, at most one period ago.
  const Navigated& navigated() const { return x_; }
  const ErrorCovariance& covariance() const { return covariance_; }

 private:
  // Sum of what came in of one kind since the last correction.
  template <class Value>
  struct Batch {
    Value sum;
    double count = 0;
    void add(const Value& value) {
      sum = count > 0 ? Value(sum + value) : value;
      count += 1;
    }
    Value mean() const { return sum / count; }
  };
  // Errors that are alike from one measurement to the next inform about a constant as
  // much as white ones of variance sd^2 (1 + phi) / (1 - phi), phi = exp(-dt / tau), and
  // the first of them as much as itself.
  struct Coloured {
    Time last;
    bool any = false;
    double variance(double sd2, double tau, Time now) const;
    void used(Time now) {
      last = now;
      any = true;
    }
  };
  // Gusts as they show in one direction of the flight.
  struct Gusts {
    double variance = 0;  // estimated: may be below 0 [m^2/s^2]
    double seconds = 0;   // over which
    Coloured last;
  };
  // What became of a measurement, and its innovation squared over the variance of that.
  struct Fused {
    bool accepted = false;
    double square = 0;
  };
  // Since when one kind of measurement has been rejected without break.
  struct Rejection {
    Time since;
    bool now = false;
  };

  Gusts first_gusts() const {
    constexpr double kWorth = 20;  // of the first guess of their strength [s]
    return {options_->gust_sd * options_->gust_sd, kWorth, {}};
  }
  // Mean square of the fixes' innovations, over what it should be, of a filter that has
  // lost itself.
  static constexpr double kDiverged = 4;

  bool waits_for_rest() const;
  bool is_shaken(const ImuSample& sample, double dt) const;
  void align(const ImuSample& sample, double dt);
  void finish_alignment();
  void bridge(double gap);
  void publish(const Vec3& w_B);
  void correct();
  void propagate();
  void add_scale_noise(Transition& step);
  void fuse_fix(ErrorVector& error);
  bool contradicted(double mean_square);
  void find_attitude(const Past& past);
  void take_attitude(const Quat& q_NB, double heading_sd);
  void fuse_altitude(ErrorVector& error);
  void fuse_bearing(ErrorVector& error);
  double bearing_curvature() const;
  void fuse_air_data(ErrorVector& error);
  void fuse_through_gusts(const Observation& z, double innovation, double white,
                          double sideslip, Gusts& gusts, ErrorVector& error);
  Fused fuse(const Observation& z, double innovation, double variance,
             ErrorVector& error);
  bool lasts(Rejection& rejection, bool accepted, double limit);
  void inject(const ErrorVector& error);
  void begin_again(const GnssFix& fix, const Past& past);
  void take_precision_of(const GnssFix& fix);
  static Vec3 at_rest() { return {0, 0, -kGravity}; }
  double seconds_since(Time t) const { return (nav_.time - t).seconds(); }

  std::shared_ptr<const EstimatorOptions> options_;
  NavState nav_;
  Navigated x_;
  ErrorCovariance covariance_;
  Interval step_;  // since the last correction
  MotionHistory history_;

  GnssFix fix_;                   // the last one
  MotionHistory::Motion at_fix_;  // estimated for its time
  double gnss_sd_ = 0, gnss_fast_ = 1, gnss_down_ = 1;
  double gnss_time_ = 1, multipath_sd_ = 0;
  Coloured last_fix_, last_bearing_;
  Batch<double> altitude_, airspeed_;
  Batch<Vec3> field_N_, wind_N_;
  Vec3 lasting_f_ = at_rest(), usual_f_ = at_rest();  // specific force in B, smoothed
  double field_level_ = 0, field_down_ = 0, field_seconds_ = 0;
  Gusts gusts_along_, gusts_across_;  // as pitot and fin feel them
  Gusts gusts_north_, gusts_east_;    // as an anemometer does
  double airspeed_offset_ = 0;  // of the measured airspeed over that in the mean wind
  double height_agl_ = 0;

  Time accepted_fix_, airspeed_time_, height_time_, field_time_, align_from_;
  Rejection fix_rejection_, bearing_rejection_, altitude_rejection_;
  Time judged_;  // the last fix that was
  double innovation_ratio_ =
      1;  // smoothed square of the fixes' innovations over what it should be
  std::optional<FlightAlignment> alignment_;  // under way
  Vec3 field_B_ = Vec3::Zero();               // last measured
  Batch<Vec3> align_w_, align_f_, align_m_;
  bool fix_waits_ = false, has_fix_ = false, has_height_ = false, has_airspeed_ = false;
  bool aligning_ = false, direct_ = false, coordinated_ = true, has_judged_ = false;
  Counts counts_;
};

}  // namespace skein::autopilot
