#include "skein/record/radio_statistics.h"

#include <algorithm>
#include <numeric>

namespace skein::record {

void RadioStatistics::message(LossCause cause, std::uint32_t hops, bool forged) {
  ++messages_[static_cast<std::size_t>(cause)];
  if (cause == LossCause::kNone && hops > 0) ++relayed_;
  if (!forged) return;
  ++forged_;
  if (cause == LossCause::kNone) ++accepted_;
}

void RadioStatistics::radio(const RadioUse& use) {
  const double load = std::min(1.0, use.sending_share + use.busy_share);
  load_ += load;
  load_max_ = std::max(load_max_, load);
  sending_max_ = std::max(sending_max_, use.sending_share);
  ++rows_;
}

void RadioStatistics::add_figures(std::map<std::string, double>& figures) const {
  const std::uint64_t all =
      std::accumulate(messages_.begin(), messages_.end(), std::uint64_t{0});
  figures["messages_sent"] = static_cast<double>(all);
  figures["messages_lost"] = static_cast<double>(all - messages_[0]);
  constexpr auto kNames = names_of(static_cast<const LossCause*>(nullptr));
  for (std::size_t cause = 1; cause < kNames.size(); ++cause) {
    if (messages_[cause] == 0) continue;
    std::string name = "messages_lost_" + std::string(kNames[cause]);
    std::replace(name.begin(), name.end(), '-', '_');
    figures[name] = static_cast<double>(messages_[cause]);
  }
  if (relayed_ > 0) figures["messages_relayed"] = static_cast<double>(relayed_);
  if (forged_ > 0) {
    figures["messages_forged"] = static_cast<double>(forged_);
    figures["messages_forged_accepted"] = static_cast<double>(accepted_);
  }
  if (rows_ == 0) return;
  figures["radio_load_mean"] = load_ / static_cast<double>(rows_);
  figures["radio_load_max"] = load_max_;
  figures["radio_sending_max"] = sending_max_;
}

}  // namespace skein::record
