// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/geo/polygon.h"
#include "skein/model/front/crossing.h"
#include "skein/model/front/wavelet.h"

namespace skein::model {

struct FrontOptions {
  double spacing = 10;       ///< between neighbouring markers [m]
  double courant = 0.25;     ///< distance of the fastest marker in one step, in spacings
  double max_step = 10;      ///< longest step [s]
  int max_markers = 200000;  ///< above this the spacing doubles, see Front::spacing()
};

/// Fails: kBadInput when a value is outside its range.
Result<void> check(const FrontOptions& options);

/// The boundary of a growing burnt region, carried by markers.
///
/// Every marker moves with the velocity of its wavelet's envelope (spread_velocity), that
/// is along its ray, in explicit steps that obey the Courant limit. After each step
/// markers are added and removed, folds are cut off, and fronts that have run into each
/// other are merged: what two fronts have burnt is burnt once, and unburnt islands stay
/// as holes that burn inwards. Islands below half a squared spacing vanish.
///
/// Accuracy: first order in the spacing. A barrier narrower than the spacing may leak.
/// Nothing burns further than 10,000 km from the origin along an axis.
/// Outer rings shorter than 24 spacings have their own, finer spacing (down to a tenth).
///
/// Reference: [Richards90] for the equation of motion; [Vatti92] for merging.
class Front {
 public:
  /// Starts with what is burnt at `time` [s]; rings may overlap (positive fill rule).
  /// Fails: Bug when the options do not pass check().
  Front(const geo::Region& burnt, const FrontOptions& options, double time = 0);

  double time() const { return time_; }
  const geo::Region& region() const { return rings_; }

  /// End of the step that step() would take [s]. Cost: one evaluation of the field, which
  /// step() does not repeat.
  double next_time(const WaveletField& field);
  /// Takes that step.
  void step(const WaveletField& field);
  /// Takes as many steps as lead exactly to `time` [s].
  void advance(const WaveletField& field, double time);

  /// Adds what something else has lit, now.
  void ignite(const geo::Region& burnt);

  int markers() const;
  /// The present spacing [m]: the one asked for, or a doubled one when the markers would
  /// have become too many.
  double spacing() const { return spacing_; }
  /// How often crossing rings had to be merged so far.
  int merges() const { return merges_; }

 private:
  double ring_spacing(const geo::Ring& ring) const;
  void evaluate(const WaveletField& field);
  void move(double dt);
  void tidy();
  void limit_markers();

  FrontOptions options_;
  double spacing_;
  double time_;
  geo::Region rings_;
  int merges_ = 0;

  std::vector<Wavelet> wavelets_;  // of one ring at a time
  std::vector<Vec2> velocities_;   // of all rings, in order; valid while evaluated_
  bool evaluated_ = false;
  double step_ = 0;  // allowed by the velocities [s]
  CrossingSearch search_;
  geo::Ring scratch_;
};

}  // namespace skein::model
