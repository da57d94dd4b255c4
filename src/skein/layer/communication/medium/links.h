// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "skein/geo/rotation.h"
#include "skein/layer/communication/medium/frame.h"
#include "skein/layer/communication/medium/radio_profile.h"
#include "skein/role/antenna.h"
#include "skein/role/propagation.h"

namespace skein::communication {

/// From a node to one that its signals reach.
struct Link {
  NodeIndex to = 0;
  Time delay;        ///< from place to place at the speed of light
  double power = 0;  ///< that arrives [W]
};

/// Where a node is [m] in N.
using NodePlace = std::function<Vec3(NodeIndex, Time)>;

/// Antennas that send and receive better in some directions than in others.
struct NodeAntennas {
  /// Of each node, null: alike in all directions; empty: all are.
  std::vector<std::shared_ptr<const Antenna>> of;
  /// R_NB of the body that carries it; none: all are level, forward to the north.
  std::function<Mat3(NodeIndex, Time)> attitude;
};

/// Who is reached by whose signals, and how strongly.
class Links {
 public:
  struct Nodes {
    NodePlace place;
    std::vector<double> transmit_power_dbm;  ///< of each node
    bool move = true;  ///< false: they stay where they are at the beginning
    NodeAntennas antennas = {};
    std::size_t outsiders = 0;  ///< the last ones, which share slots with others
    /// Whether a node is there and its radio on; none: all are.
    std::function<bool(NodeIndex)> is_on = {};
  };

  /// @param propagation  outlives this
  Links(const PhyProfile& phy, const Propagation& propagation, Nodes nodes);

  std::size_t size() const { return tables_.size(); }
  /// Those that are no outsiders.
  std::size_t members() const { return tables_.size() - nodes_.outsiders; }

  /// That a node sends with when nothing lowers it [W].
  double full_power(NodeIndex node) const { return full_power_[node]; }

  /// Those that a signal of `from` reaches with at least the interference floor, nearest
  /// first. Cost: of nodes that move, N log N each time.
  const std::vector<Link>& of(NodeIndex from, Time now);

  /// The longest delay of all links so far.
  Time longest_delay() const { return longest_delay_; }

  /// All is looked at anew when it is asked for next.
  void renew();

 private:
  struct Table {
    Time made;
    bool there = false;
    std::vector<Link> links;
  };

  void look(Time now);
  void make(NodeIndex from, Time now, Table& table);
  double gains(NodeIndex a, NodeIndex b) const;
  double gain(NodeIndex node, const Vec3& direction_N) const;

  const Propagation& propagation_;
  Nodes nodes_;
  std::vector<double> full_power_;  // of each node [W]
  double floor_;                    // [W]
  double antennas_;                 // product of both nominal gains
  std::vector<Table> tables_;
  std::vector<Vec3> places_;     // of all nodes at places_at_
  std::vector<Mat3> attitudes_;  // the same; empty: none is needed
  Time places_at_;
  bool places_known_ = false;
  Time longest_delay_;
};

/// Watts of a level in dBm.
double watts(double dbm);

/// dBm of a power above 0 [W].
double dbm(double watts);

/// Of a receiver: k T B times its noise figure [W].
double noise_power(const PhyProfile& phy);

}  // namespace skein::communication
