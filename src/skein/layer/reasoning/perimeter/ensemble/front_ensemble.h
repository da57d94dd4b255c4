// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include <vector>

#include "skein/data/perimeter/fire.h"
#include "skein/layer/reasoning/perimeter/ensemble/ensemble_options.h"
#include "skein/layer/reasoning/perimeter/ensemble/member.h"
#include "skein/layer/reasoning/perimeter/ensemble/parts.h"

namespace skein::perimeter {

/// What the members say about one number.
struct MemberValues {
  Eigen::VectorXd deviation;  ///< of each member from the mean
  double mean = 0;
  double variance = 0;  ///< unbiased
};

/// Tens of fronts, each with its own signed distance, rate field and drift, that together
/// are a belief about a fire: the members' distances at a point are samples of how far
/// the boundary is from there.
class FrontEnsemble {
 public:
  FrontEnsemble(const PerimeterPrior& prior, const EnsembleOptions& options);

  /// Carries all members on by `dt` [s].
  void predict(double dt);

  /// Prepares for looking far ahead: fewer members, longer steps, and no noise of the
  /// boundary, which makes fronts run ahead when no observation holds them.
  void look_ahead();

  /// Signed distance of the boundary from `p` [m], negative inside.
  MemberValues distance(const Vec2& p) const;
  /// The same where the speed at `p` is known already.
  MemberValues distance(const Vec2& p, const MemberValues& speed) const;
  /// Speed of the boundary at `p` along its normal [m/s].
  MemberValues speed(const Vec2& p) const;
  /// Gradient of the mean distance; its length is below 1 where members disagree.
  Vec2 gradient(const Vec2& p) const;

  /// Moves what is near `p` as linear regression on the distance at `p` says: that
  /// distance's mean changes by `shift` and its deviations are multiplied by `scale`.
  ///
  /// The weight falls with distance by [Gaspari99] (4.10), and with the angle between the
  /// normals, so that the other side of a narrow finger stays where it is.
  /// Reference: [Anderson03] for the two steps.
  void regress(const Vec2& p, const MemberValues& at_p, double shift, double scale);

  /// Moves the boundary near `p` without asking the members' correlations: each distance
  /// at `p` changes by its entry of `change`.
  void displace(const Vec2& p, const Eigen::VectorXd& change);

  /// Makes a disc around `p` part of the inside (or of the outside), in each member with
  /// its own radius [m]. The grid grows if `p` is outside.
  void stamp(const Vec2& p, bool inside, const Eigen::VectorXd& radius);

  /// Remembers that somebody was at `p`: parts and holes of the belief that nobody has
  /// been to are given up once the edge that was seen cuts them off.
  void remember(const Vec2& p, bool inside) { evidence_.add(p, inside); }

  /// Factor on the variance of all process noise.
  double noise_factor() const { return noise_factor_; }
  void set_noise_factor(double factor) { noise_factor_ = factor; }
  /// Growth of the distance's variance that the rates do not explain [m^2/s].
  double diffusion() const;

  /// Independent standard normal numbers, one per member.
  Eigen::VectorXd draw();

  int size() const { return static_cast<int>(members_.size()); }
  const model::Grid& grid() const { return grid_; }
  /// Mean of the members' distances at the nodes, `lag()` [s] ago.
  const std::vector<double>& mean() const { return mean_; }
  double lag() const { return lag_; }
  double reach() const { return options_.reach_cells * grid_.cell; }

 private:
  static constexpr int kMarginCells = 8;  // between what is known and the grid's end
  struct Window;

  void initialise(const PerimeterPrior& prior);
  void move(double dt);
  double step_length() const;
  void add_noise(double dt);
  void keep_common_spread();
  void teach_common(const MemberValues& at_p, const Eigen::VectorXd& change);
  void tidy();
  void grow(const Vec2& low, const Vec2& high);
  Growth growth_to(const Vec2& low, const Vec2& high) const;
  void coarsen();
  void update_mean();
  Window window(const Vec2& p) const;
  MemberValues summary(Eigen::VectorXd values) const;

  EnsembleOptions options_;
  double rate_sd_;
  Eigen::Vector3d common_sd_;  // of the common parts at the start [m/s]
  model::Grid grid_;
  std::vector<Member> members_;
  std::vector<double> mean_;
  Evidence evidence_;
  double lag_ = 0;
  double since_noise_ = 0;
  double noise_factor_ = 1;
  double longest_untidy_ = 45;  // between redistancings [s]
};

}  // namespace skein::perimeter
