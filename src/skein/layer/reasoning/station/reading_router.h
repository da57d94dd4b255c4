// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "skein/data/perimeter/fire.h"
#include "skein/geo/vec.h"

namespace skein::reasoning {

/// Which of several perimeters a fire reading belongs to: the sensor only says that
/// something burns.
///
/// It is the one whose mission is flown nearest to the reading, where the distance to
/// that of the reading aircraft's own mission counts half. Missions about the same
/// perimeter share its readings.
class ReadingRouter {
 public:
  /// A mission about a perimeter.
  struct Watch {
    std::size_t mission = 0;
    std::uint32_t phenomenon = 0;
    Vec2 place = Vec2::Zero();  ///< where it is flown [m]
  };

  /// The missions that run now.
  void set(std::vector<Watch> watches) { watches_ = std::move(watches); }

  /// Whether there is anything to divide: several missions about perimeters.
  bool divides() const { return watches_.size() > 1; }

  /// Whether a mission that runs is given a reading.
  /// @param owner  the mission that has the reading aircraft; none: none.
  bool belongs(const FireReading& reading, std::optional<std::size_t> owner,
               std::size_t mission) const;

 private:
  std::vector<Watch> watches_;
};

}  // namespace skein::reasoning
