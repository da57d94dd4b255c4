// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "skein/data/vehicle/vehicle_report.h"

namespace skein::physics {

/// How long a plant waits for its outside autopilot.
struct Patience {
  std::chrono::milliseconds contact{30'000};  ///< for its first sign
  std::chrono::milliseconds answer{1000};     ///< for each answer after that
};

/// Whether an outside autopilot answers: how long the next step waits, and what is said
/// about it. Silence is an event, and so is its end; in between the world goes on in real
/// time, so that it has not flown far when the autopilot is back.
class AnswerWatch {
 public:
  using Clock = std::chrono::steady_clock;
  enum class State : std::uint8_t { kNew, kAnswers, kSilent };

  /// @param where  it is met, for people.
  AnswerWatch(Patience patience, std::string where)
      : patience_(patience), where_(std::move(where)) {}

  State state() const { return state_; }

  /// How long a step of `dt` [s] may wait for it.
  std::chrono::nanoseconds allowed(double dt, Clock::time_point now);

  void answered(std::vector<OutsideEvent>& events);
  /// @param why  if more is known than that it is silent.
  void missed(std::vector<OutsideEvent>& events, const std::string& why = {});

  /// Another program is to come: it has the time of a first contact.
  void renew();

 private:
  Patience patience_;
  std::string where_;
  State state_ = State::kNew;
  bool contact_ = true;     // is waited for
  Clock::time_point pace_;  // when the next step is due that nobody answers
};

}  // namespace skein::physics
