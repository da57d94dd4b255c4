// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "skein/base/id.h"
#include "skein/base/time.h"

namespace skein::modem {

/// What may be wrong with a modem, or on its air.
enum class AlertKind : std::uint8_t {
  kSameAddress,  ///< another modem says who is reached through it, with this address
  kRefused,      ///< a datagram without a valid seal was refused
  kDoubted,      ///< a datagram without a valid seal counts all the same
  kNoLine,       ///< no line to the modem is open
  kLineOpen      ///< one is open again, or at last
};

/// Something is wrong with a modem, or on its air.
struct Alert {
  AlertKind kind = AlertKind::kSameAddress;
  std::vector<EntityId> identities;  ///< that the datagram says; it may lie
  std::uint64_t count = 1;           ///< of these since the last alert of the kind
};

/// Alerts, of each kind the first at once and then one a minute at most.
class AlertLog {
 public:
  /// Counts one.
  /// @returns  whether it is to be said: then say() who is named.
  bool note(AlertKind kind, Time now);
  void say(AlertKind kind, std::vector<EntityId> identities, Time now);

  /// What is due since the last call.
  std::vector<Alert> take();

 private:
  struct OfKind {
    std::uint64_t count = 0;  // since the last one
    std::optional<Time> next;
  };

  std::array<OfKind, 3> kinds_;  // up to kDoubted
  std::vector<Alert> due_;
};

/// Whether lines are open: kNoLine at once and then one a minute at most, kLineOpen after
/// each of these.
class LineAlerts {
 public:
  std::optional<AlertKind> look(bool open, Time now);

 private:
  bool known_open_ = true;
  std::optional<Time> next_;
};

}  // namespace skein::modem
