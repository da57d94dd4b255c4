// SPDX-License-Identifier: Apache-2.0
#include "skein/mixed/recorded_drive.h"

#include <algorithm>

namespace skein::mixed {

const ActuatorOutputs* RecordedDrive::outputs() {
  for (; next_ < reports_.size(); ++next_, row_ = 0)
    if (const auto* outputs = std::get_if<ActuatorOutputs>(&reports_[next_].report))
      if (row_ < outputs->steps.size()) return outputs;
  return nullptr;
}

bool RecordedDrive::exchange(const SensedMotion&, std::span<float> channels) {
  const ActuatorOutputs* now = outputs();
  if (!now || now->channels != channels.size() ||
      now->values.size() < (row_ + 1) * channels.size())
    return false;
  std::copy_n(now->values.begin() + static_cast<std::ptrdiff_t>(row_ * channels.size()),
              channels.size(), channels.begin());
  if (++held_ >= now->steps[row_]) {
    held_ = 0;
    ++row_;
  }
  return true;
}

void RecordedDrive::take_events(Time now, std::vector<OutsideEvent>& out) {
  for (; next_event_ < reports_.size() && reports_[next_event_].time <= now;
       ++next_event_)
    if (const auto* event = std::get_if<OutsideEvent>(&reports_[next_event_].report))
      out.push_back(*event);
}

}  // namespace skein::mixed
