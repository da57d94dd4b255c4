// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "skein/base/id.h"
#include "skein/base/replay_window.h"
#include "skein/base/time.h"
#include "skein/data/event/event.h"
#include "skein/layer/communication/security/seal.h"

namespace skein::communication {

struct AuthenticationOptions {
  TeamKey key{};
  bool required = true;  ///< what is not authentic is refused; else it is reported only
};

/// What a receiver finds of a message.
enum class Verdict : std::uint8_t {
  kAuthentic,
  kNoTag,     ///< it has no tag, or not one that the key makes of it
  kRepeated,  ///< its counter was used before, or is too old to tell
};

/// What the radios of a team know, to tell their messages from those of others: the key,
/// the counter of each sender, and what each receiver has seen of it.
class Authenticity {
 public:
  /// @param entities  how many there are; all have the key
  Authenticity(const AuthenticationOptions& options, std::size_t entities);

  bool is_required() const { return required_; }

  /// Seals the wire form of a message of `sender`, which is the next one that it sends.
  void seal(EntityId sender, std::vector<std::byte>& message);

  /// What `receiver` finds of `sealed`, which says that it is of `sender`. A counter is
  /// used up only where the tag is right.
  Verdict judge(EntityId receiver, EntityId sender, std::span<const std::byte> sealed);

 private:
  Seal seal_;
  bool required_;
  std::vector<std::uint64_t> counters_;                   // last one of each sender
  std::unordered_map<std::uint64_t, ReplayWindow> seen_;  // by receiver and sender
};

/// Says of refused messages what an operator should know: at once when a receiver begins
/// to refuse a sender for a reason, and at most once a minute how often it went on.
class RefusalLog {
 public:
  /// @param refused  else accepted, since authentication is not required
  /// @returns        an event "message-refused" or "message-doubted", or nothing
  std::optional<Event> note(Time now, EntityId receiver, EntityId sender, Verdict verdict,
                            bool refused, std::string_view sender_name);

 private:
  struct Row {
    Time said;
    std::uint64_t since = 0;  // how many were not said
  };
  std::map<std::pair<std::uint64_t, Verdict>, Row> rows_;
};

}  // namespace skein::communication
