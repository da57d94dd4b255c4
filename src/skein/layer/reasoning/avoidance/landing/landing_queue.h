// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "skein/data/radio/message.h"

namespace skein::reasoning {

/// What an aircraft that wants to land knows at one step.
struct LandingStep {
  Time now;
  Vec2 place = Vec2::Zero();  ///< where [m]
  double ground_msl = 0;      ///< there [m]
  Vec3 p_N = Vec3::Zero();    ///< where the aircraft believes to be [m]
  Vec2 wind = Vec2::Zero();   ///< as it believes [m/s]
  double endurance = 86400;   ///< flight time left [s]
  double lasts = 0;           ///< until it would stand, with the turn from now on [s]
  double loss = 0;            ///< share of what others send that does not arrive
  double delay = 0;           ///< of what others send [s]
  bool emergency = false;     ///< it lands now, whoever else does
  bool committed = false;     ///< so low that it breaks off no more
};

/// What the queue lets an aircraft do.
struct LandingTurn {
  bool lands = false;       ///< it has its turn; else it waits
  double course = 0;        ///< of the approach [rad]
  double altitude_msl = 0;  ///< at which it waits [m]
};

/// Aircraft that come home to one place land one after the other: each has a queue, and
/// by what all say once a second (LandingReport) they agree on whose turn it is.
///
/// *Order.* Who has given back the fewest turns, then who has the least flight time left
/// (by tens of seconds), then the lower id. An emergency lands at once.
///
/// *Turns.* While nobody lands or claims who goes before, the first of those that wait
/// claims the turn; when nobody has objected for as long as it takes to hear of everyone
/// for nearly certain, it lands. Of two that claim, or land since they could not hear
/// each other, the one that goes later waits again, unless it is so low that it breaks
/// off no more.
///
/// *Nobody waits for ever.* Who waits counts while it is heard; who lands and is silent,
/// half as long again as it said that it needs; a turn lasts ten minutes at most, and is
/// given back then. When nobody lands for two minutes, whoever waits claims the turn.
///
/// *Heights.* Each waits at a height of its own, the nearest that is free; of two at one
/// the one that has come later takes another.
///
/// *Course.* Approaches are flown on the course that the lowest id of them says: into the
/// wind as it was when it came, another one when nobody lands and the wind has turned.
class LandingQueue {
 public:
  /// @param level_step  between the heights of two that wait [m].
  LandingQueue(EntityId self, double level_step) : self_(self), level_step_(level_step) {}

  /// Takes in what was received. At each step, whether it wants to land or not.
  void listen(Time now, std::span<const Message> inbox);

  /// At each step in which it wants to land.
  LandingTurn step(const LandingStep& step, std::vector<Message>& out);

  /// It does not want to land there any more. Nothing is said if it has not wanted to.
  void leave(std::vector<Message>& out);

  /// At each step on the ground, having flown: says so for some time.
  void stand(Time now, const Vec3& p_N, double loss, double delay,
             std::vector<Message>& out);

  /// It flies: what stand() has said is over.
  void fly() { landed_at_.reset(); }

  LandingPhase phase() const { return phase_; }

 private:
  struct Other {
    LandingReport report;
    Time sent, heard;
    std::optional<Time> lands_since;  // as first heard of
  };
  bool is_there(const Other& other) const;
  bool waits(const Other& other) const;
  bool lands(const Other& other) const;
  bool goes_before(EntityId id, const LandingReport& other) const;
  template <class Those>
  bool before(const Those& those) const;
  void forget();
  void choose_course();
  void choose_level();
  bool is_taken(double altitude_msl, bool by_earlier_only) const;
  void take_turns();
  void set(LandingPhase phase);
  void say(std::vector<Message>& out);

  EntityId self_;
  double level_step_;
  std::map<EntityId, Other> others_;
  LandingStep step_;     // the last one
  LandingReport own_;    // as said last
  bool in_ = false;      // it wants to land
  double patience_ = 0;  // until it is nearly certain that one would be heard [s]
  LandingPhase phase_ = LandingPhase::kLeaves;
  Time since_;       // of the phase
  Time idle_since_;  // nobody lands
  std::optional<Time> said_, landed_at_;
};

}  // namespace skein::reasoning
