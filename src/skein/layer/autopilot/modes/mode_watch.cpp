// SPDX-License-Identifier: Apache-2.0
// How ModeLogic finds out what has changed: the digest of its input, who flies, and which
// failsafes are raised.

#include <algorithm>

#include "skein/layer/autopilot/modes/mode_digest.h"
#include "skein/layer/autopilot/modes/mode_logic.h"

namespace skein::autopilot {

using namespace mode_bits;

// Written so that a charge that is not a number counts as a bad one.
std::uint32_t ModeLogic::digest(const ModeInput& in) const {
  const ModeRules& rules = *rules_;
  const Time link_delay = rules.rules_[place(Failsafe::kLink)].delay;
  const Time gnss_delay = rules.rules_[place(Failsafe::kGnss)].delay;
  std::uint32_t bits = bit(true, kTaken);
  bits |= bit(in.now - in.link_heard > link_delay, place(Failsafe::kLink));
  bits |= bit(in.now - in.gnss_fix > gnss_delay, place(Failsafe::kGnss));
  bits |= bit(!(in.charge - in.charge_home >= rules.battery_reserve_),
              place(Failsafe::kBatteryLow));
  bits |=
      bit(!(in.charge >= rules.battery_critical_at_), place(Failsafe::kBatteryCritical));
  bits |= bit(in.outside_fence, place(Failsafe::kGeofence));
  bits |= bit(in.motor_failed, place(Failsafe::kMotor));
  bits |= bit(in.imu_lost, place(Failsafe::kImu));
  bits |= bit(!in.estimator_healthy, kUnhealthy);
  bits |= bit(!(in.charge >= in.charge_home), kHomeOutOfReach);
  bits |= bit(in.on_ground, kOnGround) | bit(in.done, kDone);
  bits |= bit(in.landed, kLanded) | bit(in.committed, kCommitted);
  if (in.pilot) {
    const Time silence = in.now - in.pilot->time;
    bits |= bit(silence <= rules.pilot_silence_, kPilotHeard);
    bits |= bit(silence > link_delay, kPilotLongSilent);
    bits |= bit(in.pilot->takes_over, kPilotTakesOver);
    bits |= bit(in.pilot->mode == FlightMode::kManual, kPilotManual);
  }
  return bits;
}

void ModeLogic::wake_by(Time time, Time now) {
  if (time > now) wake_ = std::min(wake_, time);
}

void ModeLogic::hear_pilot() {
  handed_back_ = false;
  if (has(digest_, kPilotHeard)) {
    const bool takes_over = has(digest_, kPilotTakesOver);
    if (takes_over && !pilot_flies_) decision_.events.insert(ModeEvent::kPilotTookOver);
    if (!takes_over && (pilot_flies_ || pilot_lost_)) {
      handed_back_ = true;
      decision_.events.insert(ModeEvent::kPilotHandedBack);
    }
    pilot_flies_ = takes_over;
    pilot_lost_ = false;
  } else if (pilot_flies_) {
    pilot_flies_ = false;
    pilot_lost_ = true;
    decision_.events.insert(ModeEvent::kPilotLost);
  }
}

void ModeLogic::feel_ground(const ModeInput& in) {
  if (!in.on_ground) {
    touches_ = grounded_ = false;
    return;
  }
  if (!touches_) {
    touches_ = true;
    touched_ = in.now;
  }
  if (grounded_) return;
  grounded_ = in.now - touched_ >= rules_->ground_time_;
  wake_by(touched_ + rules_->ground_time_, in.now);
}

bool ModeLogic::may_clear(Failsafe failsafe, bool released) const {
  if (lasts(failsafe)) return false;
  if (standing_) return true;
  const std::size_t i = place(failsafe);
  return clears_[i] < rules_->max_clears_ && (released || rules_->rules_[i].resumes);
}

void ModeLogic::watch(Time now, Failsafe failsafe, bool released) {
  const std::size_t i = place(failsafe);
  const ModeRules::Rule& rule = rules_->rules_[i];
  // Silence has lasted its delay when it is in the digest; other conditions wait here.
  bool silent = false;
  bool wrong = has(digest_, place(failsafe));
  if (failsafe == Failsafe::kLink) {
    silent = wrong || (pilot_lost_ && has(digest_, kPilotLongSilent));
    wrong = false;
  } else if (failsafe == Failsafe::kGnss) {
    silent = wrong;
    wrong = has(digest_, kUnhealthy);
  }
  const bool bad = silent || wrong;
  const auto mask = static_cast<std::uint8_t>(1u << i);
  if (bad != ((bad_ & mask) != 0)) {
    bad_ ^= mask;
    edge_[i] = now;
  }
  if (!decision_.raised.has(failsafe)) {
    if (silent || (wrong && now - edge_[i] >= rule.delay)) {
      decision_.raised.insert(failsafe);
      decision_.raised_now.insert(failsafe);
      decision_.events.insert(ModeEvent::kFailsafeRaised);
      raised_at_[i] = now;
    } else if (wrong) {
      wake_by(edge_[i] + rule.delay, now);
    }
  } else if (!bad) {
    if (now - edge_[i] < rules_->recovery_) {
      wake_by(edge_[i] + rules_->recovery_, now);
    } else if (may_clear(failsafe, released)) {
      decision_.raised.erase(failsafe);
      decision_.cleared_now.insert(failsafe);
      decision_.events.insert(ModeEvent::kFailsafeCleared);
      if (!standing_) ++clears_[i];
    }
  }
  if (decision_.raised.has(failsafe)) wake_by(raised_at_[i] + rule.escalates_after, now);
}

}  // namespace skein::autopilot
