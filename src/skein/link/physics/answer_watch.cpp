// SPDX-License-Identifier: Apache-2.0
#include "skein/link/physics/answer_watch.h"

#include <fmt/format.h>

#include <algorithm>

namespace skein::physics {

std::chrono::nanoseconds AnswerWatch::allowed(double dt, Clock::time_point now) {
  if (contact_) return patience_.contact;
  if (state_ == State::kAnswers) return patience_.answer;
  using Seconds = std::chrono::duration<double>;
  pace_ = std::max(pace_ + std::chrono::duration_cast<Clock::duration>(Seconds(dt)), now);
  return pace_ - now;
}

void AnswerWatch::answered(std::vector<OutsideEvent>& events) {
  contact_ = false;
  if (state_ == State::kAnswers) return;
  const bool first = state_ == State::kNew;
  state_ = State::kAnswers;
  if (first)
    events.push_back({EventKind::kAutopilotHeard, where_});
  else
    events.push_back(
        {EventKind::kAutopilotBack, fmt::format("it answers again: {}", where_)});
}

void AnswerWatch::missed(std::vector<OutsideEvent>& events, const std::string& why) {
  if (!contact_ && state_ == State::kSilent) return;
  const auto waited = contact_ ? patience_.contact : patience_.answer;
  contact_ = false;
  state_ = State::kSilent;
  events.push_back(
      {EventKind::kAutopilotSilent,
       why.empty() ? fmt::format("no answer within {:.3g} s: {}",
                                 std::chrono::duration<double>(waited).count(), where_)
                   : why});
}

void AnswerWatch::renew() {
  contact_ = true;
  if (state_ == State::kAnswers) state_ = State::kSilent;
}

}  // namespace skein::physics
