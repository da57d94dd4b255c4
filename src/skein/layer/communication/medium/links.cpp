// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/communication/medium/links.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "skein/base/check.h"
#include "skein/base/math.h"

namespace skein::communication {
namespace {

constexpr double kBoltzmann = 1.380649e-23;  // [J/K]

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
  for (const double dbm : nodes_.transmit_power_dbm) full_power_.push_back(watts(dbm));
  SKEIN_CHECK(nodes_.antennas.of.empty() || nodes_.antennas.of.size() == tables_.size());
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

// Where all nodes are, and how they are turned.
void Links::look(Time now) {
  if (places_known_ && (!nodes_.move || places_at_ == now)) return;
  places_.resize(tables_.size());
  for (NodeIndex node = 0; node < places_.size(); ++node)
    places_[node] = nodes_.place(node, now);
  if (nodes_.antennas.attitude) {
    attitudes_.resize(nodes_.antennas.of.size());
    for (NodeIndex node = 0; node < attitudes_.size(); ++node)
      if (nodes_.antennas.of[node])
        attitudes_[node] = nodes_.antennas.attitude(node, now);
  }
  places_at_ = now;
  places_known_ = true;
}

// Of both antennas, besides the nominal ones.
double Links::gains(NodeIndex a, NodeIndex b) const {
  const Vec3 way = places_[b] - places_[a];
  const double distance = way.norm();
  if (distance == 0) return 1;
  const Vec3 direction_N = way / distance;
  return gain(a, direction_N) * gain(b, -direction_N);
}

double Links::gain(NodeIndex node, const Vec3& direction_N) const {
  const Antenna* antenna = nodes_.antennas.of[node].get();
  if (!antenna) return 1;
  return antenna->gain(attitudes_.empty()
                           ? direction_N
                           : Vec3(attitudes_[node].transpose() * direction_N));
}

void Links::make(NodeIndex from, Time now, Table& table) {
  look(now);
  table.made = places_at_;
  table.there = true;
  table.links.clear();
  const auto is_off = [this](NodeIndex node) {
    return nodes_.is_on && !nodes_.is_on(node);
  };
  if (is_off(from)) return;
  const double radiated = full_power_[from] * antennas_;
  const Vec3& here = places_[from];
  for (NodeIndex node = 0; node < places_.size(); ++node) {
    if (node == from || is_off(node)) continue;
    double power = radiated;
    if (!nodes_.antennas.of.empty()) power *= gains(from, node);
    power = propagation_.received(power, here, places_[node]);
    if (power < floor_) continue;
    const double distance = (places_[node] - here).norm();
    table.links.push_back({node, Time::from_seconds(distance / kSpeedOfLight), power});
  }
  std::stable_sort(table.links.begin(), table.links.end(),
                   [](const Link& a, const Link& b) { return a.delay < b.delay; });
  if (!table.links.empty())
    longest_delay_ = std::max(longest_delay_, table.links.back().delay);
}

}  // namespace skein::communication
