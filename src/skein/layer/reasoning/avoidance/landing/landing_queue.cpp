// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/landing/landing_queue.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "skein/base/math.h"
#include "skein/geo/vec.h"

namespace skein::reasoning {
namespace {

constexpr double kPeriod = 1;       // of reports [s]
constexpr double kNotHeard = 1e-4;  // chance that one is not heard of at all
constexpr double kLossMin = 0.05, kLossMax = 0.9;
constexpr int kReportsMin = 4;          // that may be lost before one is lost
constexpr double kStepTime = 1;         // agents answer so late at most [s]
constexpr double kOnePlace = 1000;      // nearer places are one [m]
constexpr double kEnduranceStep = 10;   // [s]
constexpr double kIdle = 120;           // nobody lands: whoever waits claims [s]
constexpr double kTurnMax = 600;        // [s]
constexpr double kSilentShare = 1.5;    // of what it needs, for who lands unheard
constexpr double kSilentMore = 30;      // [s]
constexpr double kForgetStanding = 60;  // [s]
constexpr double kSayStanding = 10;     // at least [s]
constexpr double kApproachHeight = 40;  // of approaches, above the ground [m]
constexpr int kLevels = 20;
constexpr double kCalm = 1;        // wind that gives no course [m/s]
constexpr double kTailWind = 1.5;  // that asks for another course [m/s]

// As long as it takes to hear of somebody with certainty but for kNotHeard.
double certain_after(double loss, double delay) {
  const double lost = std::clamp(loss, kLossMin, kLossMax);
  const double reports = std::ceil(math::log(kNotHeard) / math::log(lost));
  return kPeriod * std::max<double>(kReportsMin, reports) + 2 * delay + kStepTime;
}

bool makes_sense(const LandingReport& report) {
  return std::isfinite(report.north) && std::isfinite(report.east) &&
         std::isfinite(report.course) && std::isfinite(report.altitude_msl) &&
         std::isfinite(report.since) && std::isfinite(report.endurance) &&
         report.lasts >= 0 && report.lasts <= static_cast<float>(kTurnMax);
}

}  // namespace

void LandingQueue::listen(Time now, std::span<const Message> inbox) {
  for (const Message& message : inbox) {
    const auto* report = std::get_if<LandingReport>(&message.content);
    if (!report || message.from == self_ || message.sent > now || !makes_sense(*report))
      continue;
    const auto [at, first] = others_.try_emplace(message.from);
    Other& other = at->second;
    if (!first && message.sent <= other.sent) continue;
    const bool landed_before = !first && other.report.phase == LandingPhase::kLands;
    other.report = *report;
    other.sent = message.sent;
    other.heard = now;
    if (report->phase != LandingPhase::kLands)
      other.lands_since.reset();
    else if (!landed_before)
      other.lands_since = now;
  }
}

bool LandingQueue::is_there(const Other& other) const {
  const Vec2 place(other.report.north, other.report.east);
  return (place - step_.place).norm() < kOnePlace &&
         other.report.phase != LandingPhase::kLanded &&
         other.report.phase != LandingPhase::kLeaves;
}

bool LandingQueue::waits(const Other& other) const {
  return is_there(other) && other.report.phase != LandingPhase::kLands;
}

bool LandingQueue::lands(const Other& other) const {
  return is_there(other) && other.report.phase == LandingPhase::kLands &&
         (step_.now - *other.lands_since).seconds() < kTurnMax;
}

// By what both have said: so each of the two finds the same.
bool LandingQueue::goes_before(EntityId id, const LandingReport& other) const {
  const auto rank = [](EntityId who, const LandingReport& report) {
    return std::tuple(!report.committed, !report.emergency, report.attempts,
                      std::floor(report.endurance / kEnduranceStep), who.value);
  };
  return rank(id, other) < rank(self_, own_);
}

template <class Those>
bool LandingQueue::before(const Those& those) const {
  return std::ranges::any_of(others_, [&](const auto& each) {
    return those(each.second) && goes_before(each.first, each.second.report);
  });
}

// Who is silent for too long.
void LandingQueue::forget() {
  std::erase_if(others_, [this](const auto& each) {
    const Other& other = each.second;
    const double silent = (step_.now - other.heard).seconds();
    switch (other.report.phase) {
      case LandingPhase::kLands:
        return silent > std::max<double>(patience_,
                                         kSilentShare * other.report.lasts + kSilentMore);
      case LandingPhase::kLanded:
      case LandingPhase::kLeaves:
        return silent > kForgetStanding;
      case LandingPhase::kWaits:
      case LandingPhase::kClaims:
        break;
    }
    return silent > patience_;
  });
}

void LandingQueue::choose_course() {
  const auto leader = std::ranges::find_if(
      others_, [this](const auto& each) { return is_there(each.second); });
  const bool leads = leader == others_.end() || self_ < leader->first;
  const bool blows = step_.wind.norm() > kCalm;
  if (!leads) {
    own_.course = leader->second.report.course;
  } else if (!in_) {
    const Vec2 leg = step_.place - geo::horizontal(step_.p_N);
    own_.course = static_cast<float>(blows || leg.norm() < 1 ? geo::bearing(-step_.wind)
                                                             : geo::bearing(leg));
  } else if (step_.wind.dot(geo::unit(own_.course)) > kTailWind &&
             std::ranges::none_of(
                 others_, [this](const auto& each) { return lands(each.second); })) {
    own_.course = static_cast<float>(geo::bearing(-step_.wind));
  }
}

bool LandingQueue::is_taken(double altitude_msl, bool by_earlier_only) const {
  return std::ranges::any_of(others_, [&](const auto& each) {
    const LandingReport& report = each.second.report;
    const bool earlier =
        std::tuple(report.since, each.first.value) < std::tuple(own_.since, self_.value);
    return is_there(each.second) && (earlier || !by_earlier_only) &&
           std::abs(report.altitude_msl - altitude_msl) < level_step_ / 2;
  });
}

void LandingQueue::choose_level() {
  const double lowest = step_.ground_msl + kApproachHeight + level_step_;
  if (in_ && !is_taken(own_.altitude_msl, true)) return;
  const double from = in_ ? own_.altitude_msl : -step_.p_N.z();
  std::optional<double> nearest;
  for (int k = 0; k < kLevels; ++k) {
    const double level = lowest + k * level_step_;
    if (!is_taken(level, false) &&
        (!nearest || std::abs(level - from) < std::abs(*nearest - from)))
      nearest = level;
  }
  own_.altitude_msl =
      static_cast<float>(nearest.value_or(lowest + kLevels * level_step_));
}

void LandingQueue::set(LandingPhase phase) {
  if (phase_ == LandingPhase::kLands && phase == LandingPhase::kWaits)
    idle_since_ = step_.now;
  phase_ = phase;
  since_ = step_.now;
  said_.reset();
}

void LandingQueue::take_turns() {
  const double lasts = (step_.now - since_).seconds();
  const auto claims = [this](const Other& other) {
    return is_there(other) && other.report.phase == LandingPhase::kClaims;
  };
  const bool occupied = std::ranges::any_of(
      others_, [this](const auto& each) { return lands(each.second); });
  if (occupied) idle_since_ = step_.now;
  if (step_.emergency) {
    if (phase_ != LandingPhase::kLands) set(LandingPhase::kLands);
    return;
  }
  const bool patient = (step_.now - idle_since_).seconds() < kIdle;
  const bool later =
      occupied || before(claims) ||
      (patient && before([this](const Other& other) { return waits(other); }));
  switch (phase_) {
    case LandingPhase::kLands:
      if (step_.committed) return;
      if (before([this](const Other& other) { return lands(other); })) {
        set(LandingPhase::kWaits);
      } else if (lasts > kTurnMax) {
        ++own_.attempts;
        set(LandingPhase::kWaits);
      }
      return;
    case LandingPhase::kClaims:
      if (later)
        set(LandingPhase::kWaits);
      else if (lasts > patience_)
        set(LandingPhase::kLands);
      return;
    case LandingPhase::kWaits:
    case LandingPhase::kLanded:
    case LandingPhase::kLeaves:
      if (!later) set(LandingPhase::kClaims);
      return;
  }
}

void LandingQueue::say(std::vector<Message>& out) {
  if (said_ && (step_.now - *said_).seconds() < kPeriod) return;
  said_ = step_.now;
  own_.phase = phase_;
  out.push_back({self_, kEveryone, 0, Time(), own_});
}

LandingTurn LandingQueue::step(const LandingStep& step, std::vector<Message>& out) {
  step_ = step;
  patience_ = certain_after(step.loss, step.delay);
  forget();
  if (!in_) {
    own_ = {};
    own_.since = static_cast<float>(step.now.seconds());
    idle_since_ = step.now;
  }
  choose_course();
  if (phase_ != LandingPhase::kLands || !in_) choose_level();
  own_.north = static_cast<float>(step.place.x());
  own_.east = static_cast<float>(step.place.y());
  own_.emergency = step.emergency;
  own_.committed = step.committed;
  own_.lasts = static_cast<float>(std::clamp(step.lasts, 0.0, kTurnMax));
  // What orders them is what was said last.
  if (!in_ || !said_ || (step.now - *said_).seconds() >= kPeriod)
    own_.endurance = static_cast<float>(std::max(0.0, step.endurance));
  if (!in_) {
    in_ = true;
    set(LandingPhase::kWaits);
  }
  take_turns();
  say(out);
  return {phase_ == LandingPhase::kLands, own_.course, own_.altitude_msl};
}

void LandingQueue::leave(std::vector<Message>& out) {
  if (!in_) return;
  in_ = false;
  set(LandingPhase::kLeaves);
  say(out);
}

void LandingQueue::stand(Time now, const Vec3& p_N, double loss, double delay,
                         std::vector<Message>& out) {
  step_.now = now;
  if (!landed_at_) {
    landed_at_ = now;
    own_.north = static_cast<float>(p_N.x());
    own_.east = static_cast<float>(p_N.y());
    own_.lasts = 0;
    in_ = false;
    set(LandingPhase::kLanded);
  }
  if ((now - *landed_at_).seconds() < kSayStanding + 2 * certain_after(loss, delay))
    say(out);
}

}  // namespace skein::reasoning
