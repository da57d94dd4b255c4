// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>

#include "skein/data/event/record.h"

namespace skein::record {

/// Messages of a run, and how full the air was: the part of its key figures that is
/// about them.
class RadioStatistics {
 public:
  /// A message that arrived (kNone) or was lost; how many radios have passed it on, and
  /// whether an attacker sent it in the name of another.
  void message(LossCause cause, std::uint32_t hops, bool forged);
  /// In the order of time; at a time once for each radio.
  void radio(const RadioUseRecord& record);

  /// Adds `messages_sent`, `messages_lost`, of each cause that there was
  /// `messages_lost_<cause>`, `messages_pending` if any were still on their way in the
  /// end, `messages_relayed` if any arrived by way of other radios, where there were
  /// forged ones `messages_forged` and of these `messages_forged_accepted`, and where
  /// there is a medium `radio_load_mean` and `radio_load_max`: the share of the time in
  /// which a radio sent or heard others, of all radios and times, and the highest of a
  /// radio between two records; `radio_sending_max`: the same of sending alone.
  void add_figures(std::map<std::string, double>& figures) const;

 private:
  std::array<std::uint64_t, names_of(static_cast<const LossCause*>(nullptr)).size()>
      messages_ = {};
  std::uint64_t forged_ = 0, accepted_ = 0;
  std::uint64_t relayed_ = 0;
  Time time_;                              // of the last record
  double span_ = 0;                        // that it covers [s]
  double load_seconds_ = 0, seconds_ = 0;  // of all radios
  double load_max_ = 0, sending_max_ = 0;
};

}  // namespace skein::record
