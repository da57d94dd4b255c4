// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "skein/base/id.h"
#include "skein/base/time.h"
#include "skein/geo/vec.h"

namespace skein::communication {

/// Transmits noise that nobody can decode, for a share of each period.
struct Jammer {
  double duty = 1;  ///< above 0, at most 1
  Time period = Time::from_ns(1'000'000'000);
};

/// Sends packets without a meaning by the rules of the medium.
struct Flooder {
  std::uint32_t bytes = 1000;
  double rate = 20;            ///< [1/s]
  std::optional<EntityId> to;  ///< who acknowledges them; none: all
};

/// What a spoofer says.
enum class FalseContent : std::uint8_t {
  kReport,        ///< an AircraftReport of the victim, displaced
  kTeamPosition,  ///< a TeamPosition of the victim, displaced
  kReturnHome,    ///< an order to fly home, higher than all numbers of orders in use
};

/// Sends messages in the name of another.
struct Spoofer {
  EntityId as, to;
  FalseContent content = FalseContent::kReport;
  Vec3 offset = Vec3::Zero();  ///< of a false place from the true one, in N [m]
  Time period = Time::from_ns(1'000'000'000);
};

/// Sends messages that it has heard again. Of those in parts it hears none.
struct Replayer {
  Time delay = Time::from_ns(10'000'000'000);
  std::optional<EntityId> of;  ///< whose messages; none: everybody's
};

/// A radio that belongs to nobody of the run, and what it does.
struct Attack {
  std::string name;           ///< in events
  Vec3 place = Vec3::Zero();  ///< in N [m]
  double power_dbm = 20;      ///< to its antenna
  Time from;
  std::optional<Time> until;  ///< none: to the end
  std::variant<Jammer, Flooder, Spoofer, Replayer> what;
};

}  // namespace skein::communication
