// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "skein/base/result.h"
#include "skein/data/radio/network_case.h"

namespace skein::exchange {

/// Reads where the nodes of a network are.
///
/// Columns node, time_s, x_m, y_m, z_m (up) and, if wanted, power_dbm, the same in all
/// rows of a node. Rows of a node are in order of time; at most 100,000 nodes.
/// Fails: kBadInput with the line and what is allowed.
Result<void> read_network_nodes(std::string_view text, const std::string& place,
                                NetworkCase& network);

/// The same of an ns-2 movement file, as its `setdest` writes them: `$node_(N) set X_ m`
/// (Y_, Z_), `$ns_ at T "$node_(N) setdest X Y SPEED"`, and `$ns_ at T "$node_(N) set X_
/// m"`, which is a jump at T. Comments (#), blank lines and those of `$god_` are skipped,
/// others refused.
Result<void> read_ns2_movement(std::string_view text, const std::string& place,
                               NetworkCase& network);

/// Reads what is sent, once the nodes are known. Columns message, time_s, from, to (a
/// node or *), bytes, in order of time. Fails: kBadInput with the line: an unknown node,
/// one that sends to itself, a size above
///        65,000 bytes, a message that is there twice or does not wait for its time.
Result<void> read_network_traffic(std::string_view text, const std::string& place,
                                  NetworkCase& network);

/// A flow as `FROM,TO,BYTES,DEPTH[,START_S]`, once the nodes are known.
Result<SaturatedFlow> parse_saturated_flow(std::string_view text,
                                           const NetworkCase& network);

}  // namespace skein::exchange
