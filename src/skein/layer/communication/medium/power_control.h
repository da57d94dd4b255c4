// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/layer/communication/medium/links.h"
#include "skein/layer/communication/medium/radio_profile.h"

namespace skein::communication {

/// With how much of its power a node sends to each other one.
///
/// Frames say with what power they were sent, and a link takes the same in both
/// directions: by what it hears of a node, another knows what it needs to reach it with
/// `power_margin_db` above the decode threshold. Each failure adds `power_step_db` to
/// that, each success takes a tenth of it back; whoever was never heard is sent to with
/// full power.
class PowerControl {
 public:
  /// @param links  has the full power of nodes; outlives this
  PowerControl(const RadioProfile& profile, const Links& links);

  /// A frame of `from` was understood.
  /// @param power  that arrived [W]
  /// @param share  of the full power of `from` with which it was sent
  void heard(NodeIndex node, NodeIndex from, double power, double share);

  /// The share of its full power with which `node` sends to `to`, above 0, at most 1.
  double share(NodeIndex node, NodeIndex to) const;

  /// What was sent with it to `to` was acknowledged, or not.
  void succeeded(NodeIndex node, NodeIndex to);
  void failed(NodeIndex node, NodeIndex to);

 private:
  struct Neighbour {
    NodeIndex node = 0;
    double needed = 0;  // share of full power
    double raise = 1;   // factor for failures
  };
  std::vector<Neighbour>::iterator place(NodeIndex node, NodeIndex other);
  const Neighbour* find(NodeIndex node, NodeIndex other) const;

  const Links& links_;
  double target_;                                   // power that shall arrive [W]
  double least_;                                    // power of a node [W]
  double up_, down_;                                // factors of a failure and a success
  std::vector<std::vector<Neighbour>> neighbours_;  // of each node, by number
};

}  // namespace skein::communication
