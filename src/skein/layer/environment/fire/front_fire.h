// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "skein/base/result.h"
#include "skein/layer/environment/fire/fuel.h"
#include "skein/layer/environment/fire/region_lookup.h"
#include "skein/model/front/front.h"
#include "skein/role/phenomenon.h"
#include "skein/role/terrain.h"
#include "skein/role/wind_field.h"

namespace skein::environment {

/// A place where the fire starts.
struct Ignition {
  Vec2 point = Vec2::Zero();  ///< [m]
  double radius = 20;         ///< that burns at once [m]
  double delay = 0;           ///< after the fire's beginning, `age` before the run's [s]
};

struct FrontFireOptions {
  std::vector<Ignition> ignitions = {Ignition{}};
  geo::Region start;        ///< burnt from the beginning, besides the ignitions
  double age = 0;           ///< of the fire at the run's start [s]
  double wind_height = 10;  ///< above ground, where the wind is asked for [m]
  model::SpreadLaw spread;  ///< rate, and its response to wind and slope
  model::FrontOptions front;
};

/// Fails: kBadInput when a value is not finite or outside its range, or nothing ever
///        burns.
Result<void> check(const FrontFireOptions& options);

/// A fire that spreads by the local fuel, wind and slope (model/front): fronts merge, and
/// islands of unburnt ground stay behind and burn inwards.
///
/// The boundary is that of the front's last own step, so it lags by less than a quarter
/// (`front.courant`) of the marker spacing; steps do not depend on how often advance() is
/// called. Before the run's start (`age`) the wind is that of the start.
class FrontFire : public Phenomenon {
 public:
  /// @param terrain, wind  outlive the fire.
  /// @param fuel           may be null: factor 1 everywhere.
  /// Fails: Bug when the options do not pass check().
  FrontFire(const FrontFireOptions& options, const Terrain& terrain,
            const WindField& wind, std::shared_ptr<const FuelField> fuel);

  void advance(Time time) override;
  bool inside(const Vec2& p) const override { return lookup_.inside(front_.region(), p); }
  const geo::Region& region() const override { return front_.region(); }

  /// For reports: markers, merges and the present spacing.
  const model::Front& front() const { return front_; }

 private:
  class Field : public model::WaveletField {
   public:
    Field(const FrontFireOptions& options, const Terrain& terrain, const WindField& wind,
          std::shared_ptr<const FuelField> fuel);
    void wavelets(std::span<const Vec2> points, double time,
                  std::span<model::Wavelet> out) const override;

   private:
    model::SpreadLaw law_;
    double wind_height_;
    const Terrain& terrain_;
    const WindField& wind_;
    std::shared_ptr<const FuelField> fuel_;
  };

  double age_;
  std::vector<Ignition> waiting_;  // latest first
  Field field_;
  model::Front front_;
  RegionLookup lookup_;
};

}  // namespace skein::environment
