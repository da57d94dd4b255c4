// SPDX-License-Identifier: Apache-2.0
#include "skein/record/figures/radio_sums.h"

#include <algorithm>

namespace skein::record {

void RadioSums::add(const RadioUseRecord& record) {
  const RadioUse& use = record.value;
  const double time = record.time.seconds();
  if (loads_.empty() || loads_.back().time < time) {
    span_ = time - (loads_.empty() ? 0 : loads_.back().time);
    loads_.push_back({time, 0, 0});
    radios_ = 0;
  }
  const double load = use.load();
  StoredLoad& all = loads_.back();
  all.mean += (load - all.mean) / ++radios_;
  all.most = std::max(all.most, load);

  Use& own = uses_[record.id];
  RadioUse& sums = own.sums;
  own.seconds += span_;
  sums.frames += use.frames;
  const double share = own.seconds > 0 ? span_ / own.seconds : 0;
  sums.sending_share += (use.sending_share - sums.sending_share) * share;
  sums.busy_share += (use.busy_share - sums.busy_share) * share;
  sums.waiting = std::max(sums.waiting, use.waiting);
  sums.queue_full += use.queue_full;
  sums.retry_limit += use.retry_limit;
  sums.expired += use.expired;
  sums.received += use.received;
}

void RadioSums::add(const LinkUse& use) {
  Link& link = links_[{use.from, use.to}];
  link.arrived += use.arrived;
  link.lost += use.lost;
  if (use.delay) link.delay += *use.delay * use.arrived;
  if (!use.rssi_dbm || !use.sinr_db) return;
  const double weight = std::max(1u, use.arrived);
  link.rssi += weight * *use.rssi_dbm;
  link.sinr += weight * *use.sinr_db;
  link.heard += weight;
}

void RadioSums::finish(StoredRun& run) const {
  run.loads = loads_;
  for (const auto& [id, use] : uses_) run.radios.push_back({id, use.sums});
  for (const auto& [pair, link] : links_) {
    LinkUse use;
    use.from = pair.first;
    use.to = pair.second;
    use.arrived = static_cast<std::uint32_t>(link.arrived);
    use.lost = static_cast<std::uint32_t>(link.lost);
    if (link.arrived > 0) use.delay = link.delay / static_cast<double>(link.arrived);
    if (link.heard > 0) {
      use.rssi_dbm = link.rssi / link.heard;
      use.sinr_db = link.sinr / link.heard;
    }
    run.links.push_back(use);
  }
}

}  // namespace skein::record
