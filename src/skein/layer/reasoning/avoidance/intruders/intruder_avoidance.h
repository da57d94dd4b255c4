// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "skein/layer/reasoning/avoidance/intruders/intruder.h"
#include "skein/layer/reasoning/avoidance/intruders/intruder_view.h"
#include "skein/model/well_clear/band_advisor.h"

namespace skein::reasoning {

/// Keeps an aircraft out of the way of those who say nothing of their plans.
///
/// Where its plan comes into the room of an intruder (predicted_intersection), it flies
/// the cheapest way around that stays clear of all (flight_around), or another plan
/// around all of these rooms, which move. Where there is neither, it flies by bands: the
/// track nearest to where it wants to go that leads into no well-clear conflict, or out
/// of one soonest, until there is a plan again or the way to its goal is free. Where no
/// track is left it turns away from all and climbs or sinks (escape_from()).
/// Reference: spec/team.md sections 3 and 8.
class IntruderAvoidance {
 public:
  /// @param reaction  own action begins so long after a decision [s].
  /// @param well_clear  of alerts and bands, copied; null: skein_suas.
  explicit IntruderAvoidance(double reaction,
                             const model::WellClearConfiguration* well_clear = nullptr);

  enum class Action {
    kNone,   ///< the plan is free
    kPlan,   ///< flight() instead, from begin() on
    kTrack,  ///< track() for now, no plan
  };
  Action step(const IntruderView& view);

  const FlightPlan& flight() const { return flight_; }
  double begin() const { return begin_; }  ///< [s]
  double track() const { return track_; }  ///< over ground [rad]
  /// How much higher to fly meanwhile; negative: lower [m].
  double climb() const { return climb_; }
  /// The intruder that was nearest in time at the last action, and when.
  std::uint32_t intruder() const { return intruder_; }
  const PredictedIntersection& encounter() const { return encounter_; }
  int alert() const { return alert_; }  ///< well clear, of the last step

 private:
  bool plan_around(const IntruderView& view);
  bool must_turn(const IntruderView& view);
  void escape(const IntruderView& view);
  std::optional<PredictedIntersection> first_of(const IntruderView& view, double sigmas);
  Action turn_on(const IntruderView& view, bool turn);

  double reaction_;
  model::BandAdvisor advisor_;
  std::vector<model::TrackedIntruder> intruders_;
  FlightPlan flight_;
  double begin_ = 0, track_ = 0, climb_ = 0, clear_since_ = 0, plan_again_ = 0;
  std::optional<bool> escapes_up_;         // while it escapes
  bool turning_ = false, around_ = false;  // the plan is another because of an intruder
  std::uint32_t intruder_ = 0;
  PredictedIntersection encounter_;
  int alert_ = 0;
};

}  // namespace skein::reasoning
