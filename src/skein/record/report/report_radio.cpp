// SPDX-License-Identifier: Apache-2.0
#include "skein/record/report/report_radio.h"

#include <cmath>
#include <utility>
#include <vector>

#include "skein/data/describe/json.h"
#include "skein/record/report/page.h"

namespace skein::record {
namespace {

using Json = nlohmann::ordered_json;

Json rounded(const std::optional<double>& value, double steps) {
  if (!value || !std::isfinite(*value)) return nullptr;
  return std::round(*value * steps) / steps;
}

}  // namespace

Json radio_json(const StoredRun& run) {
  if (run.loads.empty()) return nullptr;
  std::vector<float> times, means, mosts;
  for (const StoredLoad& load : run.loads) {
    times.push_back(static_cast<float>(load.time));
    means.push_back(static_cast<float>(load.mean));
    mosts.push_back(static_cast<float>(load.most));
  }
  Json radios = Json::array(), links = Json::array();
  for (const StoredRadio& radio : run.radios)
    radios.push_back({{"entity", radio.id.value},
                      {"frames", radio.use.frames},
                      {"sending", rounded(radio.use.sending_share, 1e5)},
                      {"busy", rounded(radio.use.busy_share, 1e5)},
                      {"waiting", radio.use.waiting},
                      {"queue_full", radio.use.queue_full},
                      {"retry_limit", radio.use.retry_limit},
                      {"expired", radio.use.expired},
                      {"received", radio.use.received}});
  for (const LinkUse& link : run.links)
    links.push_back({{"from", link.from.value},
                     {"to", link.to.value},
                     {"arrived", link.arrived},
                     {"lost", link.lost},
                     {"rssi_dbm", rounded(link.rssi_dbm, 10)},
                     {"sinr_db", rounded(link.sinr_db, 10)},
                     {"delay_s", rounded(link.delay, 1e5)}});
  return {{"time_s", packed(times)},
          {"load_mean", packed(means)},
          {"load_max", packed(mosts)},
          {"radios", std::move(radios)},
          {"links", std::move(links)}};
}

}  // namespace skein::record
