// SPDX-License-Identifier: Apache-2.0
#include "skein/record/report/report_alerts.h"

#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "skein/data/describe/json.h"

namespace skein::record {
namespace {

using Json = nlohmann::ordered_json;

// A tenth of a unit is more than a display can show.
Json rounded(double value) {
  if (!std::isfinite(value)) return nullptr;
  return std::round(10 * value) / 10;
}

Json band_row(const StoredBands& bands) {
  Json row = Json::array({rounded(bands.time), bands.level});
  for (const double value : {bands.track_advised_deg, bands.speed_advised,
                             bands.vertical_speed_advised, bands.recovery})
    row.push_back(rounded(value));
  for (const auto* pieces :
       {&bands.tracks, &bands.speeds, &bands.vertical_speeds, &bands.altitudes}) {
    Json list = Json::array();
    for (const StoredBand& piece : *pieces) {
      list.push_back(rounded(piece.from));
      list.push_back(rounded(piece.to));
      list.push_back(static_cast<int>(piece.region));
    }
    row.push_back(std::move(list));
  }
  return row;
}

}  // namespace

Json alerts_json(const StoredRun& run) {
  Json alerts = Json::array(), recommendations = Json::array();
  for (const AlertRecord& record : run.alerts) alerts.push_back(json::to_json(record));
  for (const StoredRecommendation& each : run.recommendations) {
    Json one = json::to_json(each.record);
    Json path = Json::parse(each.path_json, nullptr, false);
    one["path"] = path.is_array() ? std::move(path) : Json::array();
    recommendations.push_back(std::move(one));
  }
  std::map<std::uint32_t, Json> rows;
  for (const StoredBands& bands : run.bands)
    rows.try_emplace(bands.id.value, Json::array())
        .first->second.push_back(band_row(bands));
  Json bands = Json::array();
  for (auto& [id, list] : rows)
    bands.push_back({{"entity", id}, {"rows", std::move(list)}});
  return {{"alerts", std::move(alerts)},
          {"bands", std::move(bands)},
          {"recommendations", std::move(recommendations)}};
}

}  // namespace skein::record
