// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "skein/base/id.h"
#include "skein/base/result.h"

namespace skein::record {

/// Bytes that an XBee modem's frame adds to what it sends: start, length, type, number,
/// address of 64 and of 16 bits, radius, options and checksum of a transmit request.
inline constexpr std::uint32_t kFrameBytes = 18;

/// A message as its sender has sent it: once, however many receive it.
struct SentMessage {
  double time = 0;  ///< [s]
  EntityId from;
  std::string kind;         ///< of its content; of a team's message what it says
  std::uint32_t bytes = 0;  ///< in the wire form
};

/// What a run has kept of its messages.
struct SentMessages {
  struct Sender {
    std::string name;
    bool is_aircraft = true;
  };
  std::map<EntityId, Sender> senders;  ///< all entities, those that say nothing too
  double duration = 0;                 ///< of the run [s]
  std::vector<SentMessage> messages;   ///< in order of time
};

/// Reads them from the run in `directory`, also of one that was cut off.
/// Fails: kNotFound without a database; kBadInput when it is damaged, of another version,
///        or has kept no messages.
Result<SentMessages> read_sent_messages(const std::filesystem::path& directory);

/// A part of a run.
struct LoadPhase {
  std::string name;
  double from = 0, until = 0;  ///< [s]; the end is not part of it
};

/// The phases that begin at `starts`, each until the next, the last until `end`. What is
/// before the first is a phase of the name "before", unless that begins at 0.
/// @param starts  names and times [s], from 0 on.
/// Fails: kBadInput unless times ascend and lie before `end`.
Result<std::vector<LoadPhase>> load_phases(
    const std::vector<std::pair<std::string, double>>& starts, double end);

/// How much each entity says, by kind of message, in each phase of a run.
class MessageLoad {
 public:
  struct Sum {
    std::uint64_t messages = 0, bytes = 0;
  };
  using Key = std::tuple<std::size_t, EntityId, std::string>;  ///< phase, sender, kind

  /// @param header  bytes that each message has besides its wire form.
  MessageLoad(std::vector<LoadPhase> phases, std::uint32_t header)
      : phases_(std::move(phases)), header_(header) {}

  /// Messages of no phase are left out.
  void add(const SentMessage& message);

  const std::vector<LoadPhase>& phases() const { return phases_; }
  const std::map<Key, Sum>& sums() const { return sums_; }
  /// Of a sum, in bytes per second of its phase, headers included.
  double rate(std::size_t phase, const Sum& sum) const;

 private:
  std::vector<LoadPhase> phases_;
  std::uint32_t header_;
  std::map<Key, Sum> sums_;  // bytes with headers
};

/// CSV of all sums: phase, from_s, until_s, entity, kind, messages, bytes, bytes_per_s.
std::string message_load_csv(const MessageLoad& load, const SentMessages& run);

/// Lines for people: bytes/s by kind, of an aircraft in the mean, in each phase; of all
/// of them, of ground stations, and what is sent together in kbit/s.
std::string message_load_text(const MessageLoad& load, const SentMessages& run);

}  // namespace skein::record
