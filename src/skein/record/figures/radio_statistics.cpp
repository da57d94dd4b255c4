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

// A word as it stands in the name of a figure.
std::string in_name(std::string_view word) {
  std::string name(word);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

}  // namespace

std::string_view kind_of_message(const MessageRecord& record) {
  return record.said.empty() ? kind_of(record.message.content) : record.said;
}

void RadioStatistics::message(const ReceivedMessage& message) {
  const LossCause cause = message.cause;
  if (message.forged) {
    ++forged_;
    if (cause == LossCause::kNone) ++accepted_;
    return;
  }
  ++copies_[place_of(cause)];
  if (cause == LossCause::kNone && message.hops > 0) ++relayed_;
  if (message.copy) return;
  ++sent_by_[message.from];
  const auto known = sent_.find(message.kind);
  if (known != sent_.end())
    ++known->second;
  else
    sent_.emplace(message.kind, 1);
}

std::uint64_t RadioStatistics::sent_by(EntityId sender) const {
  const auto found = sent_by_.find(sender);
  return found == sent_by_.end() ? 0 : found->second;
}

void RadioStatistics::radio(const RadioUseRecord& record) {
  if (record.time != time_)
    span_ = (record.time - std::exchange(time_, record.time)).seconds();
  const double load = record.value.load();
  load_seconds_ += load * span_;
  seconds_ += span_;
  load_max_ = std::max(load_max_, load);
  sending_max_ = std::max(sending_max_, record.value.sending_share);
}

void RadioStatistics::add_figures(std::map<std::string, double>& figures) const {
  std::uint64_t sent = 0;
  for (const auto& [kind, count] : sent_) {
    figures["messages_sent_" + in_name(kind)] = static_cast<double>(count);
    sent += count;
  }
  const std::uint64_t all =
      std::accumulate(copies_.begin(), copies_.end(), std::uint64_t{0});
  const std::uint64_t pending = copies_[place_of(LossCause::kPending)];
  figures["messages_sent"] = static_cast<double>(sent);
  figures["message_copies"] = static_cast<double>(all);
  figures["messages_lost"] = static_cast<double>(all - copies_[0] - pending);
  if (pending > 0) figures["messages_pending"] = static_cast<double>(pending);
  constexpr auto kNames = names_of(static_cast<const LossCause*>(nullptr));
  for (std::size_t cause = 1; cause < kNames.size(); ++cause) {
    if (copies_[cause] == 0 || cause == place_of(LossCause::kPending)) continue;
    figures["messages_lost_" + in_name(kNames[cause])] =
        static_cast<double>(copies_[cause]);
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
