// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "skein/base/id.h"
#include "skein/base/time.h"

namespace skein {

/// A message that goes from radio to radio.
struct RoutedMessage {
  EntityId origin;         ///< who said it
  EntityId to;             ///< for whom; kEveryone: for all
  std::uint32_t hops = 0;  ///< radios that have passed it on
};

/// Whether a radio has heard another lately.
using HeardLately = std::function<bool(EntityId node, EntityId other)>;

/// Who passes on what was for others, and to whom: the routing protocol of all radios of
/// a run, each of which knows only what it has heard itself.
///
/// The radio sees to it that nobody passes a message on twice, or one that was for him.
class Routing {
 public:
  virtual ~Routing() = default;

  /// What it adds to each message on the air [byte].
  virtual std::uint32_t head_bytes() const = 0;

  /// `node` has got a message that `sender` sent, its own or another's.
  virtual void learn(EntityId node, EntityId sender, const RoutedMessage& message,
                     Time now) = 0;

  /// `node` has heard that `sender` sends a message to another, `receiver`.
  virtual void overhear(EntityId /*node*/, EntityId /*sender*/, EntityId /*receiver*/,
                        const RoutedMessage& /*message*/, Time /*now*/) {}

  /// Whom `node`, which has the message, sends it to: its receiver, a radio that it
  /// hears, kEveryone for all who hear it; none: nobody.
  virtual std::optional<EntityId> next(EntityId node, const RoutedMessage& message,
                                       const HeardLately& hears, Time now) = 0;

  /// `next` has acknowledged nothing of what `node` sent to it.
  /// @returns  whether `node` sends it to all who hear it now, once.
  virtual bool failed(EntityId node, EntityId next) = 0;

  /// How long `node` waits before it passes a message on [s]: all who hear one get it at
  /// the same moment.
  virtual double delay(EntityId node) = 0;
};

}  // namespace skein
