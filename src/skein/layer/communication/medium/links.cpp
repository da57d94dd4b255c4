#include "skein/layer/communication/medium/links.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "skein/base/check.h"
#include "skein/base/math.h"

namespace skein::communication {
namespace {

constexpr double kSpeedOfLight = 299'792'458;  // [m/s]
constexpr double kBoltzmann = 1.380649e-23;    // [J/K]

}  // namespace

double watts(double dbm) {
  return 1e-3 * math::pow(10, dbm / 10);
}

double dbm(double watts) {
  return 10 * math::log10(watts) + 30;
}

double noise_power(const PhyProfile& phy) {
  return kBoltzmann * phy.noise_temperature * phy.noise_bandwidth *
         math::pow(10, phy.noise_figure_db / 10);
}

Links::Links(const PhyProfile& phy, const Propagation& propagation, Nodes nodes)
    : propagation_(propagation),
      nodes_(std::move(nodes)),
      floor_(watts(phy.interference_floor_dbm)),
      antennas_(math::pow(10, (phy.transmit_gain_db + phy.receive_gain_db) / 10)),
      tables_(nodes_.transmit_power_dbm.size()) {
  SKEIN_CHECK(nodes_.place);
}

const std::vector<Link>& Links::of(NodeIndex from, Time now) {
  Table& table = tables_[from];
  if (!table.there || (nodes_.move && table.made != now)) make(from, now, table);
  return table.links;
}

void Links::renew() {
  places_known_ = false;
  for (Table& table : tables_) table.there = false;
}

void Links::make(NodeIndex from, Time now, Table& table) {
  if (!places_known_ || (nodes_.move && places_at_ != now)) {
    places_.resize(tables_.size());
    for (NodeIndex node = 0; node < places_.size(); ++node)
      places_[node] = nodes_.place(node, now);
    places_at_ = now;
    places_known_ = true;
  }
  table.made = places_at_;
  table.there = true;
  table.links.clear();
  const double radiated = watts(nodes_.transmit_power_dbm[from]) * antennas_;
  const Vec3& here = places_[from];
  for (NodeIndex node = 0; node < places_.size(); ++node) {
    if (node == from) continue;
    const double power = propagation_.received(radiated, here, places_[node]);
    if (power < floor_) continue;
    const double distance = (places_[node] - here).norm();
    table.links.push_back({node, Time::from_seconds(distance / kSpeedOfLight), power});
  }
  std::stable_sort(table.links.begin(), table.links.end(),
                   [](const Link& a, const Link& b) { return a.delay < b.delay; });
}

}  // namespace skein::communication
