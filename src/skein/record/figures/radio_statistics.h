// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "skein/base/id.h"
#include "skein/data/event/record.h"

namespace skein::record {

/// What has become of a message at one of its receivers.
struct ReceivedMessage {
  EntityId from;
  std::string_view kind;               ///< what it says (kind_of_message())
  bool copy = false;                   ///< a further receiver's of a message to all
  LossCause cause = LossCause::kNone;  ///< kNone: it arrived
  std::uint32_t hops = 0;              ///< radios that have passed it on
  bool forged = false;                 ///< an attacker sent it in the name of another
};

/// What a message says, in one word: of those of a team's protocol the column `said`.
std::string_view kind_of_message(const MessageRecord& record);

/// Messages of a run, and how full the air was: the part of its key figures that is
/// about them.
class RadioStatistics {
 public:
  void message(const ReceivedMessage& message);
  /// In the order of time; at a time once for each radio.
  void radio(const RadioUseRecord& record);

  /// Adds `messages_sent`, one to all counted once, and of each kind that there was
  /// `messages_sent_<kind>`; `message_copies`, one for each receiver, and of these
  /// `messages_lost`, of each cause that there was
  /// `messages_lost_<cause>`, `messages_pending` if any were still on their way in the
  /// end, `messages_relayed` if any arrived by way of other radios, where there were
  /// forged ones `messages_forged` and of these `messages_forged_accepted`, and where
  /// there is a medium `radio_load_mean` and `radio_load_max`: the share of the time in
  /// which a radio sent or heard others, of all radios and times, and the highest of a
  /// radio between two records; `radio_sending_max`: the same of sending alone.
  void add_figures(std::map<std::string, double>& figures) const;

  /// Messages that a sender has sent, one to all counted once.
  std::uint64_t sent_by(EntityId sender) const;

 private:
  std::array<std::uint64_t, names_of(static_cast<const LossCause*>(nullptr)).size()>
      copies_ = {};
  std::map<std::string, std::uint64_t, std::less<>> sent_;  // by kind
  std::map<EntityId, std::uint64_t> sent_by_;
  std::uint64_t forged_ = 0, accepted_ = 0;
  std::uint64_t relayed_ = 0;
  Time time_;                              // of the last record
  double span_ = 0;                        // that it covers [s]
  double load_seconds_ = 0, seconds_ = 0;  // of all radios
  double load_max_ = 0, sending_max_ = 0;
};

}  // namespace skein::record
