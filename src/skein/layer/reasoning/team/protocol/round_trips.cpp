// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/protocol/round_trips.h"

#include <algorithm>
#include <cstddef>

namespace skein::reasoning {
namespace {

constexpr std::size_t kMaxQueries = 64;  // that may still be answered
constexpr double kNewWeight = 0.3;       // of a new measurement

}  // namespace

void RoundTrips::sent(std::uint32_t query, double now) {
  sent_[query] = now;
  while (sent_.size() > kMaxQueries) sent_.erase(sent_.begin());
}

std::optional<double> RoundTrips::answered(EntityId from, std::uint32_t query,
                                           double held, double now) {
  const auto sent = sent_.find(query);
  if (sent == sent_.end()) return std::nullopt;
  const double measured = now - sent->second - held;
  if (measured < 0) return std::nullopt;
  const auto [place, is_new] = measured_.try_emplace(from, measured);
  if (!is_new) place->second += kNewWeight * (measured - place->second);
  double longest = 0;
  for (const auto& [id, time] : measured_) longest = std::max(longest, time);
  return longest;
}

}  // namespace skein::reasoning
