// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

namespace skein::communication {

/// Packets of a node that wait: the most urgent first, else in the order in which they
/// came. The first one stays first once it is in service.
class PacketQueue {
 public:
  std::size_t size() const { return waiting_.size(); }
  bool empty() const { return waiting_.empty(); }
  std::uint32_t front() const { return waiting_.front().packet; }

  void push(std::uint32_t packet, std::uint8_t urgency) {
    auto place = waiting_.end();
    const auto first = waiting_.begin() + (in_service_ ? 1 : 0);
    while (place != first && std::prev(place)->urgency < urgency) --place;
    waiting_.insert(place, {packet, urgency});
  }

  /// From now on the first one is in service.
  void serve_front() { in_service_ = true; }

  void pop_front() {
    waiting_.pop_front();
    in_service_ = false;
  }

  /// Takes out the one that came last of those that are less urgent and not in service.
  std::optional<std::uint32_t> take_less_urgent(std::uint8_t urgency) {
    if (waiting_.size() <= (in_service_ ? 1u : 0u)) return std::nullopt;
    const Waiting last = waiting_.back();
    if (last.urgency >= urgency) return std::nullopt;
    waiting_.pop_back();
    return last.packet;
  }

  /// Moves those that are not in service and of which `is_old` is true to `out`.
  template <class IsOld>
  void take_old(IsOld is_old, std::vector<std::uint32_t>& out) {
    const auto first = waiting_.begin() + (in_service_ ? 1 : 0);
    const auto rest = std::stable_partition(
        first, waiting_.end(), [&](const Waiting& each) { return !is_old(each.packet); });
    for (auto each = rest; each != waiting_.end(); ++each) out.push_back(each->packet);
    waiting_.erase(rest, waiting_.end());
  }

  /// Calls `look` with each that is not in service.
  template <class Look>
  void look_at_waiting(Look look) const {
    for (std::size_t k = in_service_ ? 1 : 0; k < waiting_.size(); ++k)
      look(waiting_[k].packet);
  }

 private:
  struct Waiting {
    std::uint32_t packet;
    std::uint8_t urgency;
  };
  std::deque<Waiting> waiting_;
  bool in_service_ = false;
};

}  // namespace skein::communication
