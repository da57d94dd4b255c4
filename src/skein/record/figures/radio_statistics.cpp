// SPDX-License-Identifier: Apache-2.0
#include "skein/record/figures/radio_statistics.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace skein::record {
namespace {

std::size_t place_of(LossCause cause) {
  return static_cast<std::size_t>(cause);
}

}  // namespace

void RadioStatistics::message(LossCause cause, std::uint32_t hops, bool forged) {
  if (forged) {
    ++forged_;
    if (cause == LossCause::kNone) ++accepted_;
    return;
  }
  ++messages_[place_of(cause)];
  if (cause == LossCause::kNone && hops > 0) ++relayed_;
}

void RadioStatistics::radio(const RadioUseRecord& record) {
  if (record.time != time_)
    span_ = (record.time - std::exchange(time_, record.time)).seconds();
  const double load = record.use.load();
  load_seconds_ += load * span_;
  seconds_ += span_;
  load_max_ = std::max(load_max_, load);
  sending_max_ = std::max(sending_max_, record.use.sending_share);
}

void RadioStatistics::add_figures(std::map<std::string, double>& figures) const {
  const std::uint64_t all =
      std::accumulate(messages_.begin(), messages_.end(), std::uint64_t{0});
  const std::uint64_t pending = messages_[place_of(LossCause::kPending)];
  figures["messages_sent"] = static_cast<double>(all);
  figures["messages_lost"] = static_cast<double>(all - messages_[0] - pending);
  if (pending > 0) figures["messages_pending"] = static_cast<double>(pending);
  constexpr auto kNames = names_of(static_cast<const LossCause*>(nullptr));
  for (std::size_t cause = 1; cause < kNames.size(); ++cause) {
    if (messages_[cause] == 0 || cause == place_of(LossCause::kPending)) continue;
    std::string name = "messages_lost_" + std::string(kNames[cause]);
    std::replace(name.begin(), name.end(), '-', '_');
    figures[name] = static_cast<double>(messages_[cause]);
  }
  if (relayed_ > 0) figures["messages_relayed"] = static_cast<double>(relayed_);
  if (forged_ > 0) {
    figures["messages_forged"] = static_cast<double>(forged_);
    figures["messages_forged_accepted"] = static_cast<double>(accepted_);
  }
  if (seconds_ == 0) return;
  figures["radio_load_mean"] = load_seconds_ / seconds_;
  figures["radio_load_max"] = load_max_;
  figures["radio_sending_max"] = sending_max_;
}

}  // namespace skein::record
