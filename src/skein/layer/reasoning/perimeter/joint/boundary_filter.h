// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include <array>
#include <vector>

#include "skein/data/perimeter/fire.h"
#include "skein/layer/reasoning/perimeter/joint/periodic_spline.h"
#include "skein/layer/reasoning/perimeter/joint/step_likelihood.h"

namespace skein::perimeter {

/// How much a function of bearing varies, by harmonic: variance proportional to
/// 1 / (1 + (k / cutoff)^fall), scaled so that all harmonics together have variance sd^2.
struct Roughness {
  double sd = 0;
  double cutoff = 8;  ///< harmonic up to which all are alike
  double fall = 6;    ///< how fast the variance falls beyond
};

/// One hypothesis about how smooth the fire is and how steady its rates are.
struct BoundaryHypothesis {
  double weight = 1;        ///< before any observation
  Roughness radius;         ///< of the start boundary [m]
  Roughness rate;           ///< of the spread over bearing [m/s]
  double mean_rate_sd = 0;  ///< of the spread's mean over all bearings [m/s]
  double wind_sd = 1;       ///< per axis [m/s]
  double rate_drift = 0;    ///< random walk of the rate, per root second [m/s/sqrt(s)]
  double texture_rate = 0;  ///< growth of what the spline cannot show [m/s]
};

/// An in/out reading, or the crossing between two, in polar form about the origin.
struct PolarReading {
  double bearing = 0;      ///< of the point; of the middle of a crossing [rad]
  double distance = 0;     ///< from the origin [m]
  bool inside = false;     ///< of the reading; of the later one of a crossing
  double position_sd = 0;  ///< per axis [m]
  bool crossing = false;
  double radial = 0;      ///< crossing: track between the readings, outward part [m]
  double tangential = 0;  ///< crossing: part towards growing bearing [m]
  double period = 0;      ///< crossing: time between the readings [s]
  double age = 0;         ///< since it was made [s]
};

/// The polar frame ends here [m].
inline constexpr double kMinPolarRadius = 20;

/// The boundary r(bearing), its spread v(bearing) and the wind w as one Gaussian.
///
///   dr/dt = v + w . e_r - (w . e_t / r) dr/dbearing
///
/// about a fixed origin (e_r, e_t: radial and tangential unit vectors): every boundary
/// point moves with v e_r + w. r and v are periodic splines, so the state is w (2), then
/// the coefficients of r and those of v. The wind's product with the slope is linearised
/// about the mean; what the linearisation leaves out becomes noise.
class BoundaryFilter {
 public:
  BoundaryFilter(const PerimeterPrior& prior, const BoundaryHypothesis& hypothesis,
                 int knots, int aircraft);

  void predict(double dt);

  /// Probability of a reading that is not false, before it is taken in.
  double probability(const PolarReading& reading) const;

  /// Learns from a reading of aircraft `slot`.
  /// @param false_rate  probability that a reading is wrong.
  /// @returns the probability of the reading given all before it; of a bound that another
  ///          bound of the same aircraft at the same place implies: 1.
  double observe(int slot, const PolarReading& reading, double false_rate);

  /// Makes room for the bounds of so many aircraft.
  void reserve_aircraft(int count) { sites_.resize(static_cast<std::size_t>(count)); }

  /// Forgets precision near `bearing` until a boundary at `distance` is only `surprise`
  /// standard deviations away.
  void widen(double bearing, double distance, double surprise);

  struct Local {
    double radius = 0, slope = 0, growth = 0;  ///< mean of r, dr/dbearing and dr/dt
    double variance = 0;                       ///< of r, texture included
    double spline_variance = 0;                ///< of r, without
    double covariance = 0;                     ///< of r and dr/dt
    double growth_variance = 0;                ///< of dr/dt
  };
  Local at(double bearing) const;

  /// Whether the numbers still mean something: all finite, no radius nor its deviation
  /// beyond 1,000 km. A fire that is nothing like the hypothesis can drive them out.
  bool sound();

  /// Brings covariance() up to now; it may lag a few seconds behind otherwise.
  void settle();
  const Eigen::VectorXd& mean() const { return x_; }
  /// Only the lower triangle, and the rates' block in full, are kept.
  const Eigen::MatrixXd& covariance() const { return P_; }
  Vec2 wind() const { return x_.head<2>(); }

 private:
  // No radius is known better than to 10 cm: below that the covariance holds nothing but
  // rounding, which may even be negative.
  static constexpr double kMinVariance = 0.01;

  // A linear function of the state with at most ten terms.
  struct Functional {
    std::array<int, 10> index{};
    std::array<double, 10> weight{};
    int size = 0;
    void add(int i, double w) {
      index[static_cast<std::size_t>(size)] = i;
      weight[static_cast<std::size_t>(size++)] = w;
    }
  };
  // The newest bound of one aircraft, as the Gaussian factor that stands for it, so that
  // a tighter bound at the same place replaces it instead of adding to it.
  struct Site {
    bool open = false, inside = false;
    int count = 0;  // readings that agree on it
    double bearing = 0, bound = 0, age = 0;
    double precision = 0, shift = 0;         // factor exp(-precision z^2/2 + shift z)
    double evidence = 1, free_variance = 0;  // of the reading, of z without the factor
  };
  // A reading as limits on the radius at its bearing now.
  struct Limits {
    double low = 0, high = 0, noise = 0;
  };

  struct Ground {
    double share = 0, noise = 0;  // of the bearings; variance of the texture there [m^2]
  };

  std::array<Ground, 2> grounds() const;
  StepMoments condition_on_texture(double m, double s, double noise,
                                   const StepLikelihood& step) const;
  int r(int knot) const { return 2 + knot; }
  int v(int knot) const { return 2 + n_ + knot; }
  Limits limits(const PolarReading& reading, const Local& local) const;
  Functional radius_at(const PeriodicSpline::Tap& tap) const;
  Functional aged_radius_at(double bearing, double age) const;
  static Vec2 wind_effect(double bearing, double slope_over_radius);
  void inflate(const PolarReading& reading, const Local& local, const Limits& l);
  void inflate_covariance(double bearing, double extra);
  double slope_variance(const PeriodicSpline::Tap& tap) const;
  double apply(const Functional& h, Eigen::VectorXd& Ph) const;
  static double dot(const Functional& h, const Eigen::VectorXd& x);
  void add_circulant(int from, const Eigen::VectorXd& row, double gain);
  void growth(const Eigen::Ref<const Eigen::VectorXd>& c, double moved);
  void move_mean(double dt);
  void advect_covariance();
  double product_noise() const;
  bool drop_site(Site& site, const Functional& h, double& s, double& m, double& gain);

  int n_;
  PeriodicSpline spline_;
  BoundaryHypothesis hypothesis_;
  double age_ = 0;        // since the start [s]
  double lag_ = 0;        // by which P_ is behind x_ [s]
  double noise_due_ = 0;  // time whose noise is not in P_ yet [s]
  bool changed_ = true;   // since sound() looked
  Eigen::VectorXd x_;
  Eigen::MatrixXd P_;
  Eigen::VectorXd radius_row_,
      rate_row_;  // prior covariance against knot distance, unit sd
  std::vector<Site> sites_;
  std::vector<Vec2> e_r_;
  // Scratch, so that nothing is allocated after construction.
  Eigen::VectorXd Ph_, Ph_site_, drift_, trial_, padded_, advect_;
  Eigen::MatrixXd G_, B_;
};

}  // namespace skein::perimeter
