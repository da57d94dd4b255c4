// SPDX-License-Identifier: Apache-2.0
#include "skein/link/router/frame_router.h"

#include <algorithm>

#include "skein/link/mavlink/messages.h"
#include "skein/link/mavlink/payload.h"

namespace skein::router {
namespace {

using mavlink::kFacts;

// More senders than this are not remembered: what is for them goes nowhere.
constexpr std::size_t kMaxSenders = 8192;
// Frames may overtake each other by so much before it means that a clock went back [ms].
constexpr std::uint32_t kOvertaking = 1000;

}  // namespace

bool carries_key(const mavlink::Frame& frame) {
  return frame.message && frame.id() == kFacts<mavlink::SetupSigning>.id;
}

void FrameRouter::close(Channel channel) {
  channels_.erase(channel);
  for (auto it = heard_.begin(); it != heard_.end();) {
    it->second.erase(channel);
    it = it->second.empty() ? heard_.erase(it) : std::next(it);
  }
}

void FrameRouter::learn(Channel from, const mavlink::Frame& frame) {
  const std::uint8_t system = frame.system();
  if (system == 0) return;
  if (frame.message && frame.id() == kFacts<mavlink::SystemTime>.id) {
    const std::uint32_t now =
        mavlink::unpack<mavlink::SystemTime>(frame.payload()).time_boot_ms;
    const auto [clock, first] = clocks_.try_emplace(system, now);
    if (!first && now < clock->second && clock->second - now > kOvertaking)
      heard_.erase(heard_.lower_bound({system, 0}), heard_.upper_bound({system, 255}));
    clock->second = now;
  }
  const Component sender{system, frame.component()};
  if (heard_.size() < kMaxSenders || heard_.contains(sender)) heard_[sender].insert(from);
}

void FrameRouter::route(Channel from, const mavlink::Frame& frame,
                        std::vector<Channel>& out) {
  out.clear();
  learn(from, frame);
  if (carries_key(frame)) return;
  const std::uint8_t system = frame.target_system(), component = frame.target_component();
  if (system == 0) {
    out.assign(channels_.begin(), channels_.end());
  } else {
    const std::uint8_t last = component == 0 ? std::uint8_t{255} : component;
    const auto end = heard_.upper_bound({system, last});
    for (auto it = heard_.lower_bound({system, component}); it != end; ++it)
      out.insert(out.end(), it->second.begin(), it->second.end());
    std::ranges::sort(out);
    out.erase(std::unique(out.begin(), out.end()), out.end());
  }
  std::erase(out, from);
}

std::vector<std::uint8_t> FrameRouter::systems_of(Channel channel) const {
  std::vector<std::uint8_t> systems;
  for (const auto& [sender, channels] : heard_)
    if (channels.contains(channel) &&
        (systems.empty() || systems.back() != sender.system))
      systems.push_back(sender.system);
  return systems;
}

}  // namespace skein::router
