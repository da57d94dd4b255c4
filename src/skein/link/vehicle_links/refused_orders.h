// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "skein/base/time.h"

namespace skein::vehicle_links {

/// An order of a ground station that was refused at the border.
struct RefusedOrder {
  /// The aircraft that it was for: a simulated one by its number among those that are
  /// shown, else a real one by its name; neither: of another number, or all.
  std::optional<std::size_t> shown = {};
  std::string vehicle = {};
  std::string text = {};  ///< who gave it and why it was refused, for people
};

/// Orders that were refused because they are not signed: counted all, reported once a
/// minute for each aircraft, so that a flood of them fills neither log nor records.
///
/// add() is the links' thread's, take() the simulation's.
class RefusedOrders {
 public:
  /// @param peer   who gave it.
  /// @param order  whom it was for; its text is made here.
  void add(const std::string& peer, RefusedOrder order, Time now);

  /// Those to be reported since the last call.
  std::vector<RefusedOrder> take();

 private:
  std::uint64_t count_ = 0;
  std::map<std::pair<std::optional<std::size_t>, std::string>, Time> due_;
  std::mutex mutex_;
  std::vector<RefusedOrder> reported_;
};

}  // namespace skein::vehicle_links
