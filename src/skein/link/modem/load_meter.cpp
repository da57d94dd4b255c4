// SPDX-License-Identifier: Apache-2.0
#include "skein/link/modem/load_meter.h"

#include <algorithm>

namespace skein::modem {
namespace {

constexpr std::int64_t kTenth = 100'000'000;  // [ns]

std::int64_t tenth_of(Time time) {
  return std::max<std::int64_t>(time.ns(), 0) / kTenth;
}

}  // namespace

void LoadMeter::add(std::size_t bytes, Time now) {
  const std::int64_t number = tenth_of(now);
  Tenth& tenth = tenths_[static_cast<std::size_t>(number) % tenths_.size()];
  if (tenth.number != number) tenth = {number, 0};
  tenth.bits += 8 * static_cast<double>(bytes);
}

double LoadMeter::load(Time now) const {
  if (rate_ <= 0) return 0;
  const std::int64_t present = tenth_of(now);
  double bits = 0;
  for (const Tenth& tenth : tenths_)
    if (tenth.number >= present - 10 && tenth.number < present) bits += tenth.bits;
  return std::min(1.0, bits / rate_);
}

}  // namespace skein::modem
